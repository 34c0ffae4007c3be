#!/usr/bin/env python3
"""Checks the links of built pages: each file and each place in it must exist, and nothing is loaded from elsewhere.

Usage: links.py FOLDER

Prints the links to other places, which are not visited. Exit code 1 if a link is dead."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("object", "data")}


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.path, self.places, self.links = path, set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places |= {values[name] for name in ("id", "name") if values.get(name)}
        for name in ("href", "src", "data"):
            if values.get(name):
                loaded = (tag, name) in LOADED or (tag == "link" and values.get("rel") in ("stylesheet", "preload"))
                self.links.append((values[name], loaded))


def main(folder):
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    dead, elsewhere, count = [], {}, 0
    for page in pages.values():
        for link, loaded in page.links:
            target = urlsplit(link)
            count += 1
            name = page.path.relative_to(folder)
            if target.scheme in ("http", "https") or target.netloc:
                elsewhere.setdefault(link, name)
                if loaded:
                    dead.append(f"{name}: loads {link}")
            elif target.scheme not in ("data", "mailto"):
                file = (page.path.parent / unquote(target.path)).resolve() if target.path else page.path
                if not file.exists():
                    dead.append(f"{name}: {link}: no such file")
                elif target.fragment and file in pages and unquote(target.fragment) not in pages[file].places:
                    dead.append(f"{name}: {link}: no such place in that page")
    for link, name in sorted(elsewhere.items()):
        print(f"{link}  ({name})")
    print(f"{len(pages)} pages, {count} links, {len(elsewhere)} to other places, {len(dead)} dead", file=sys.stderr)
    print("".join(f"{line}\n" for line in dead), end="", file=sys.stderr)
    return int(bool(dead))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
