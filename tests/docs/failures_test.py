"""The program of docs/howto/failures.md prints what the page shows, and the page has the codes that there are."""

import re
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"
sys.path.insert(0, str(DOCS / "sphinx"))

from sessions import blocks, difference  # noqa: E402

PAGE = DOCS / "howto" / "failures.md"
HEADER = DOCS.parent / "beeline" / "reason.h"


def test_the_program_prints_what_the_page_shows(build):
    [shown] = [body for _, options, body in blocks(PAGE) if options.get("caption") == "output of 14_failure"]
    program = subprocess.run([build / "examples" / "14_failure"], capture_output=True, text=True, check=True)
    assert difference(shown.splitlines(), program.stdout.splitlines()) == ""


def test_codes_and_fields_exist():
    text = PAGE.read_text()
    table = text[text.index("## What to do"):]
    codes = re.findall(r"`(\w+)`", " ".join(re.findall(r"^\| ((?:`\w+`(?:, )?)+) \|", table, re.MULTILINE)))
    assert len(codes) >= 10
    names = re.findall(r"^  (\w+),", HEADER.read_text(), re.MULTILINE)
    assert not set(codes) - set(names)
