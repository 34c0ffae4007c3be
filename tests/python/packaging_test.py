"""What an installed module must have: no newer glibc than stated, no other files, no network."""

import platform
import re
import subprocess
import sys

import beeline
import pytest


def test_the_version_is_that_of_the_project(root):
    text = (root / "CMakeLists.txt").read_text()
    assert beeline.__version__ == re.search(r"project\(beeline VERSION ([0-9.]+)", text)[1]


@pytest.mark.skipif(platform.libc_ver()[1] > "2.36",
                    reason="wheels are built on Debian 12: with a newer glibc programs need newer symbols")
def test_the_extension_needs_glibc_2_34_at_most():
    symbols = subprocess.run(
        ["objdump", "-T", beeline._core.__file__], capture_output=True, text=True, check=True
    ).stdout
    versions = {tuple(map(int, v.split("."))) for v in re.findall(r"GLIBC_([0-9.]+)", symbols)}
    assert (2, 2, 5) in versions
    assert max(versions) <= (2, 34)


def test_the_import_needs_numpy_alone():
    loaded = subprocess.run(
        [sys.executable, "-c", "import sys, numpy; before = set(sys.modules); import beeline;"
         "print(*{name.partition('.')[0] for name in set(sys.modules) - before})"],
        capture_output=True, text=True, check=True,
    ).stdout.split()  # fmt: skip
    foreign = set(loaded) - set(sys.stdlib_module_names) - {"beeline", "nanobind_backend", "numpy"}
    assert not foreign
    assert not {"socket", "ssl", "urllib", "http"} & set(loaded)


def test_the_read_me_runs(root, tmp_path):
    for path in (root / "README.md", root / "python" / "README.md"):
        for number, code in enumerate(re.findall(r"```python\n(.*?)```", path.read_text(), re.DOTALL)):
            script = tmp_path / f"{path.parent.name}_{number}.py"
            script.write_text(code)
            subprocess.run([sys.executable, script], check=True, cwd=tmp_path)
