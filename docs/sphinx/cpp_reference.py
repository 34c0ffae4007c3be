#!/usr/bin/env python3
"""Writes a page for each folder of beeline/ with its public headers, for Breathe.

Usage: cpp_reference.py ROOT DOXYGEN_XML FOLDER

The folders stand in the order of layers.txt; the table in CONTRIBUTING.md says what they hold."""

import re
import sys
from pathlib import Path
from xml.etree import ElementTree

from index_page import write_index

INTRODUCTION = """`#include <beeline/beeline.h>` brings all of it; each header stands alone. Link with `beeline::beeline`, or with
`beeline::core`, which depends on Eigen and Highway only. Everything is in `namespace beeline`. Bad input throws
`beeline::Error`; a negative answer is a result with a status and a reason."""

HEADER = """## {name}

`#include <beeline/{name}>`

```{{doxygenfile}} beeline/{name}
:project: beeline
```
"""


def public_headers(root):
    """The headers that are installed, by folder, in the order of the layers."""
    sys.path.insert(0, str(root / "tests"))
    from layers import is_public, read_layers

    library = root / "beeline"
    folders = {folder: [] for folder in [".", *read_layers(root / "layers.txt")]}
    for path in sorted(library.rglob("*.h")):
        name = path.relative_to(library)
        if is_public(name) and name.as_posix() != "beeline.h":
            folders[name.parent.as_posix()].append(name.as_posix())
    return {folder: headers for folder, headers in folders.items() if headers}


def contents(root):
    """folder -> what it holds, from the table in CONTRIBUTING.md."""
    table = re.findall(r"^\| `beeline/([\w/]+)/` \| (.*) \|$", (root / "CONTRIBUTING.md").read_text(), re.M)
    return {**dict(table), ".": "errors, and what a search may spend"}


def name_files_by_path(xml):
    """Breathe finds a file by its name in index.xml, which Doxygen writes without folders."""
    index = ElementTree.parse(xml / "index.xml")
    for compound in index.iterfind("compound[@kind='file']"):
        file = ElementTree.parse(xml / f"{compound.get('refid')}.xml")
        compound.find("name").text = file.find("compounddef/location").get("file")
    index.write(xml / "index.xml", encoding="utf-8", xml_declaration=True)


def remove_private_parts(xml):
    """Removes private members, and the includes, which the pages' headings name."""
    for path in [*xml.glob("class*.xml"), *xml.glob("struct*.xml")]:
        file = ElementTree.parse(path)
        for compound in file.iterfind("compounddef"):
            for part in [*compound.iterfind("includes"), *compound.iterfind("sectiondef")]:
                if part.tag == "includes" or part.get("kind").startswith("private"):
                    compound.remove(part)
        file.write(path, encoding="utf-8", xml_declaration=True)


def main(root, xml, output):
    name_files_by_path(xml)
    remove_private_parts(xml)
    output.mkdir(parents=True, exist_ok=True)
    meaning, rows = contents(root), []
    for folder, headers in public_headers(root).items():
        page = "beeline" if folder == "." else folder.replace("/", "_")
        title = "beeline/" if folder == "." else f"beeline/{folder}/"
        text = [f"# {title}\n\n{meaning[folder][0].upper() + meaning[folder][1:]}.\n"]
        text += [HEADER.format(name=name) for name in headers]
        (output / f"{page}.md").write_text("\n".join(text))
        rows.append((page, f"`{title}`", meaning[folder]))
    write_index(output, "C++ reference", INTRODUCTION, ("folder", "contents"), rows)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3]))
