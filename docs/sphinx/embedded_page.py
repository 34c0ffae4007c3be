#!/usr/bin/env python3
"""Writes the page of a Panda, which opens from a disk too, and the text that embeds it in docs/howto/page.md.

Usage: embedded_page.py WEB HTML TEXT: the folder of `make web`, the .html and the .md file to write

Without the built page the text says how to build it. The module `beeline` must be importable."""

import sys
from pathlib import Path

import beeline
from beeline._page_document import document_of

FRAME = """```{{raw}} html
<iframe src="../{page}" title="The page: a Panda to hold" loading="lazy" class="page"></iframe>
<p><a href="../{page}" target="_top">The page alone</a></p>
```
"""
MISSING = "*The page stands here where it is built: `make web`, then `make docs`.*\n"


def main(web, html, text):
    if not (web / "saved.html").is_file():
        text.write_text(MISSING)
        return
    html.parent.mkdir(parents=True, exist_ok=True)
    document = document_of(beeline.arms.panda(), None, None)
    html.write_text(document.replace("<body>", '<body data-docs=".">', 1), encoding="utf-8")  # Help links to the pages
    text.write_text(FRAME.format(page=html.name))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
