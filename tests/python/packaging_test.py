"""What an installed module must have: no newer glibc than stated, no other files, no network."""

import platform
import re
import subprocess
import sys
from pathlib import Path

import beeline
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs" / "sphinx"))
from sessions import difference  # noqa: E402


def test_the_version_is_the_projects(root):
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


BLOCK = re.compile(r"```(python|cpp)\n(.*?)```(?:\n```text\n(.*?)```)?", re.DOTALL)


@pytest.mark.parametrize("name", ["README.md", "python/README.md"])
def test_the_read_me_runs(root, tmp_path, name):
    for language, code, shown in BLOCK.findall((root / name).read_text()):
        if language == "cpp":
            continue
        (tmp_path / "code.py").write_text(code)
        printed = subprocess.run([sys.executable, "code.py"], check=True, cwd=tmp_path, capture_output=True, text=True)
        assert not shown or difference(shown.splitlines(), printed.stdout.splitlines()) == ""


def test_the_read_me_shows_the_first_example(root, build):
    blocks = BLOCK.findall((root / "README.md").read_text())
    code = next(code for language, code, _ in blocks if language == "cpp")
    shown = next(shown for language, _, shown in blocks if language == "python")  # the same program
    example = (root / "examples" / "00_ten_lines.cpp").read_text()
    assert [line.strip() for line in code.splitlines()] == [
        line.strip() for line in example.partition("int main() {\n")[2].rpartition("}")[0].splitlines()]
    printed = subprocess.run([build / "examples" / "00_ten_lines"], check=True, capture_output=True, text=True)
    assert difference(shown.splitlines(), printed.stdout.splitlines()) == ""


def test_a_citation_names_this_version(root):
    assert f"version: {beeline.__version__}\n" in (root / "CITATION.cff").read_text()
