"""The first page of a reference: an introduction, a table with a row for each page, and the menu's list of pages."""

INDEX = """# {title}

{introduction}

| {first} | {second} |
|---|---|
{rows}

```{{toctree}}
:hidden:

{pages}
```
"""


def write_index(folder, title, introduction, columns, rows):
    """Writes folder/index.md; a row: the page's name, its title, what stands beside it."""
    lines = [f"| [{text}]({page}.md) | {meaning} |" for page, text, meaning in rows]
    (folder / "index.md").write_text(INDEX.format(
        title=title, introduction=introduction, first=columns[0], second=columns[1], rows="\n".join(lines),
        pages="\n".join(page for page, _, _ in rows)))
