"""The errata of the chapter: each has its place, what is printed and what is right, and most a session that shows it."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "errata.md").read_text()
ENTRIES = re.findall(r"^### (\d+)\. (.+?)\n(.*?)(?=^#|\Z)", PAGE, re.MULTILINE | re.DOTALL)
WITHOUT_SESSION = {3, 4, 5, 6, 15}  # names, an index, a missing section: nothing to compute


def test_entries_are_numbered():
    assert [int(number) for number, _, _ in ENTRIES] == list(range(1, len(ENTRIES) + 1))
    assert len(ENTRIES) >= 15


@pytest.mark.parametrize("number, place, text", ENTRIES, ids=lambda part: part[:12])
def test_an_entry_has_its_parts(number, place, text):
    assert re.match(r"Sections? 1\.\d", place)
    assert "*Printed" in text
    assert "*Right:*" in text
    assert ("```" in text) == (int(number) not in WITHOUT_SESSION)
