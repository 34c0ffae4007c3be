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
from index_page import write_index

OWN = "python"  # the page of names that no header declares

INTRODUCTION = """```{{py:module}} beeline
```

{documentation}

In signatures `ArrayLike` and `NDArray` are numpy's types."""


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
            names = [member.find("name").text for member in compound.iterfind("member") if member.get("kind") != "enumvalue"]
        for name in names:
            found.setdefault(name, folder)
    return found


def grouped(names, folder_of, folders):
    """page -> names, in the order of the layers; Python's own last."""
    pages = {folder: [] for folder in [*folders, OWN]}
    for name in names:
        pages[folder_of.get(name, OWN)].append(name)
    return {page: sorted(found, key=str.lower) for page, found in pages.items() if found}


def static_methods(kind):
    """The names of nanobind's static methods, which autodoc takes for data."""
    return [name for name, value in vars(kind).items()
            if type(value).__name__ == "nb_func" and not name.startswith("_")]


def directive(name):
    """The heading and autodoc's directive for a public name of the module."""
    value = getattr(beeline, name)
    lines = [f".. {'autofunction' if callable(value) else 'autodata'}:: beeline.{name}"]
    if inspect.ismodule(value):
        lines = [f".. automodule:: beeline.{name}", "   :members:", "   :imported-members:"]
    elif inspect.isclass(value):
        static = static_methods(value)
        lines = [f".. autoclass:: beeline.{name}", "   :members:", f"   :exclude-members: {', '.join(static)}", ""]
        made = ["__init__"] if type(vars(value).get("__init__")).__name__ == "nb_method" else []
        lines += [f"   .. automethod:: {method}" for method in made + static]
    return f"## {name}\n\n```{{eval-rst}}\n" + "\n".join(lines) + "\n```\n"


def title_of(page):
    return {"only_python": "Only in Python"}.get(page, page.capitalize())


def main(root, xml, output):
    output.mkdir(parents=True, exist_ok=True)
    meaning, rows = {**contents(root), OWN: "what only the Python module has"}, []
    names = [name for name in beeline.__all__ if not name.startswith("_")]
    for part, found in grouped(names, folders_of_names(xml), public_headers(root)).items():
        page = {".": "errors", OWN: "only_python"}.get(part, part.replace("/", "_"))
        description = meaning[part][0].upper() + meaning[part][1:]
        text = [f"# {title_of(page)}\n\n{description}.\n", *map(directive, found)]
        (output / f"{page}.md").write_text("\n".join(text))
        rows.append((page, title_of(page), ", ".join(f"`{name}`" for name in found)))
    introduction = INTRODUCTION.format(documentation=inspect.cleandoc(beeline.__doc__))
    write_index(output, "Python reference", introduction, ("part", "names"), rows)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3]))
