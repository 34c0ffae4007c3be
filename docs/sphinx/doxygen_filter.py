#!/usr/bin/env python3
"""Prints a header as Doxygen is to read it.

Usage: doxygen_filter.py HEADER

One namespace holds all declarations; without it each header has its own declarations. Indented lines of a
comment, which are formulas and tables, are printed as they are."""

import re
import sys
from pathlib import Path

DESIGNATED = re.compile(r" = \{\.[^}]*\};")  # a default that Sphinx cannot parse; the comment states it
COMMENT = re.compile(r"^( *///)( *)(.*)$")


def as_sphinx_reads(line):
    return "" if line in ("namespace beeline {", "}  // namespace beeline") else DESIGNATED.sub(";", line)


def with_code_blocks(lines):
    """Makes code blocks of Markdown of the indented lines of comments, except lines of lists."""
    in_list = in_code = False
    for line in lines:
        comment = COMMENT.match(line)
        in_list = bool(comment) and (comment[3].startswith("- ") or (in_list and len(comment[2]) >= 2))
        indented = bool(comment) and len(comment[2]) >= 3 and bool(comment[3]) and not in_list
        if comment and indented != in_code:
            yield comment[1]  # a blank line before and after
        in_code = indented
        yield f"{comment[1]}    {comment[2]}{comment[3]}" if indented else line


if __name__ == "__main__":
    text = Path(sys.argv[1]).read_text().splitlines()
    print("\n".join(with_code_blocks(map(as_sphinx_reads, text))))
