"""The documents name headers and sources that there are."""

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
