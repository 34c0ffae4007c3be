#!/usr/bin/env python3
"""Writes the notices of the libraries that the page contains, one file each: what their package.json says, and their
licence's text or where Debian has it.

Usage: page_notices.py FOLDER"""

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COMMON = Path("/usr/share/common-licenses")


def text_of(field):
    """A field of package.json as text: people and repositories are objects or strings."""
    if isinstance(field, dict):
        return field.get("name") or field.get("url") or ""
    return str(field or "")


def licence_text(folder, name):
    """The licence's text of the package, or the path of Debian's copy."""
    for path in sorted(folder.iterdir()):
        if path.name.lower().startswith(("license", "licence")):
            return path.read_text()
    if name and (COMMON / name).is_file():
        return f"The text of the licence is in {COMMON / name}.\n"
    sys.exit(f"{folder} has no file of its licence, and {COMMON} has no text of '{name}'")


def main():
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    packages = json.loads((ROOT / "web" / "package.json").read_text())["dependencies"]
    for name in packages:
        folder = ROOT / "web" / "node_modules" / name
        if not folder.is_dir():
            sys.exit(f"{folder} is not there, whose licence the page needs: make web")
        package = json.loads((folder / "package.json").read_text())
        licence = text_of(package.get("license"))
        lines = [f"{name} {package['version']}", text_of(package.get("author")), text_of(package.get("repository")), licence]
        (target / name.replace("/", "_")).write_text(
            "\n".join(line for line in lines if line) + "\n\n" + licence_text(folder, licence))


if __name__ == "__main__":
    main()
