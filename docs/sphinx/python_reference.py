#!/usr/bin/env python3
"""Writes a page for each folder of beeline/ with the names of the Python module that its headers declare.

Usage: python_reference.py ROOT DOXYGEN_XML FOLDER

The module `beeline` must be importable. Names that no header declares are on the page "Python only"."""

import inspect
import sys
from pathlib import Path
from xml.etree import ElementTree

import beeline

from cpp_reference import contents, public_headers

OWN = "python"  # the page of names that no header declares

INDEX = """# Python reference

```{{py:module}} beeline
```

{introduction}

| part | names |
|---|---|
{rows}

```{{toctree}}
:hidden:

{pages}
```
"""


def folders_of_names(xml):
    """name -> the folder of the header that declares it."""
    found = {}
    for compound in ElementTree.parse(xml / "index.xml").iterfind("compound"):
        location = ElementTree.parse(xml / f"{compound.get('refid')}.xml").find("compounddef/location")
        if compound.get("kind") not in ("struct", "class", "file"):
            continue
        folder = Path(location.get("file")).parent.relative_to("beeline").as_posix()
        names = [compound.find("name").text.split("::")[-1]]
        if compound.get("kind") == "file":
            names = [member.find("name").text for member in compound.iterfind("member")]
        for name in names:
            found.setdefault(name, folder)
    return found


def grouped(names, folder_of, folders):
    """page -> names, in the order of the layers; Python's own last."""
    pages = {folder: [] for folder in [*folders, OWN]}
    for name in names:
        pages[folder_of.get(name, OWN)].append(name)
    return {page: sorted(found, key=str.lower) for page, found in pages.items() if found}


def directive(name):
    """The heading and autodoc's directive for a public name of the module."""
    value = getattr(beeline, name)
    kind, options = "autofunction" if callable(value) else "autodata", ""
    if inspect.ismodule(value):
        kind, options = "automodule", "   :members:\n   :imported-members:\n"
    elif inspect.isclass(value):
        kind, options = "autoclass", "   :members:\n"
    return f"## {name}\n\n```{{eval-rst}}\n.. {kind}:: beeline.{name}\n{options}```\n"


def main(root, xml, output):
    output.mkdir(parents=True, exist_ok=True)
    meaning, rows, pages = {**contents(root), OWN: "what only Python has"}, [], []
    names = [name for name in beeline.__all__ if not name.startswith("_")]
    for part, found in grouped(names, folders_of_names(xml), public_headers(root)).items():
        page = {".": "errors", OWN: "python"}.get(part, part.replace("/", "_"))
        title = meaning[part][0].upper() + meaning[part][1:]
        text = [f"# {title}\n", *map(directive, found)]
        (output / f"{page}.md").write_text("\n".join(text))
        rows.append(f"| [{meaning[part]}]({page}.md) | " + ", ".join(f"`{name}`" for name in found) + " |")
        pages.append(page)
    text = INDEX.format(introduction=inspect.cleandoc(beeline.__doc__), rows="\n".join(rows), pages="\n".join(pages))
    (output / "index.md").write_text(text)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3]))
