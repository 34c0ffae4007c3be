"""Each Python session of docs/ prints what the page shows; the sessions of a page share their names and its files."""

import doctest
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
sys.path.insert(0, str(DOCS / "sphinx"))

from sessions import blocks, difference, named_file  # noqa: E402

PAGES = [page for page in sorted(DOCS.rglob("*.md")) if "\n```pycon\n" in page.read_text()]


class NearlyEqual(doctest.OutputChecker):
    """The last digits of numbers may differ; `...` stands for any lines."""

    def check_output(self, want, got, optionflags):
        return difference(want.splitlines(), got.splitlines()) == ""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(DOCS).as_posix())
def test_sessions_print_what_the_page_shows(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names, parser = {}, doctest.DocTestParser()
    for language, options, body in blocks(page):
        file = named_file(page, language, options, body)
        if file:
            Path(file[0]).write_text(file[1])
        if language != "pycon":
            continue
        runner = doctest.DocTestRunner(NearlyEqual())
        test = parser.get_doctest(body + "\n", names, page.name, str(page), 0)
        test.globs = names  # not a copy
        result = runner.run(test, clear_globs=False)
        assert result.failed == 0, capsys.readouterr().out


def test_pages_have_python_sessions():
    assert len(PAGES) >= 6
