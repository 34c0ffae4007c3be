"""The documents name headers and sources that there are, and link to those that they include."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = [page for page in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")] if page.stem.lower() != "changelog"]
FOLDERS = sorted(path.name for path in (ROOT / "beeline").iterdir() if path.is_dir())
NAMED = re.compile(rf"`(?:beeline/)?((?:{'|'.join(FOLDERS)})/[\w/-]+\.(?:h|cpp))`")


def test_every_header_that_a_page_names_exists():
    named = {(page.name, name) for page in PAGES for name in NAMED.findall(page.read_text())}
    assert len(named) > 50
    assert [(page, name) for page, name in sorted(named) if not (ROOT / "beeline" / name).is_file()] == []


def test_an_included_file_has_a_link():
    """Repository pages do not show it: only Sphinx does."""
    counted, without = 0, set()
    for page in PAGES:
        text = page.read_text()
        for target in re.findall(r"^```\{literalinclude\} (\S+)$", text, re.MULTILINE):
            counted += 1
            assert (page.parent / target).is_file(), (page.name, target)
            if f"]({target})" not in text:
                without.add((page.name, target))
    assert counted > 20 and without == set()
