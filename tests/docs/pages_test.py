"""Each session of docs/ prints what the page shows; each page runs in a folder of its own."""

import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
sys.path.insert(0, str(DOCS / "sphinx"))

from sessions import blocks, difference, steps  # noqa: E402

ROOT = DOCS.parent
PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_sessions_print_what_the_page_shows(page, build, tmp_path):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    for command, code, printed, shown in steps(page, tmp_path, build):
        assert code in (0, 1, 2, 3), (command, printed)
        assert difference(shown, printed) == "", (command, printed)


def test_pages_have_sessions():
    languages = [language for page in PAGES for language, _, _ in blocks(page)]
    assert languages.count("console") >= 20


@pytest.mark.parametrize("shown, printed, says", [
    (["a 1.000", "b"], ["a 1.001", "b"], ""),
    (["a 1.0"], ["a 1.1"], "shown"),
    (["a"], ["a", "b"], "printed, but not shown"),
    (["a", "..."], ["a", "b"], ""),
    (["...", "c"], ["a", "b", "c"], ""),
    (["...", "d"], ["a", "b", "c"], "not printed"),
    (["joint1 1"], ["joint2 1"], "shown"),
    (["a 3e-9 m"], ["a 1e-8  m"], ""),
])
def test_comparison(shown, printed, says):
    assert difference(shown, printed).startswith(says)
    assert bool(difference(shown, printed)) == bool(says)
