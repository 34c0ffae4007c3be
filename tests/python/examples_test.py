"""The numbered examples run, and mirror the examples in C++."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).resolve().parents[2] / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(example, tmp_path):
    done = subprocess.run([sys.executable, "-B", str(example)], cwd=tmp_path, capture_output=True, text=True,
                          env=os.environ)  # fmt: skip
    assert done.returncode == 0, done.stderr
    pictures = example.read_text().count(".save(")
    assert len(list(tmp_path.glob("*.svg"))) == pictures


def test_each_example_exists_in_both_languages():
    folder = EXAMPLES[0].parent
    assert [path.stem for path in EXAMPLES] == sorted(path.stem for path in folder.glob("*.cpp"))
