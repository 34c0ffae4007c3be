#!/usr/bin/env python3
"""Writes a page for each verb of the command, from what `beeline VERB --help` prints.

Usage: command_line.py BEELINE FOLDER"""

import re
import subprocess
import sys
from pathlib import Path

from index_page import write_index

ENTRY = re.compile(r"^  (?! )(\S.*?)(?:  +(\S.*))?$")
COLUMN = 26  # of the entries' descriptions
MARKUP = re.compile(r"([\\<$*_\[\]{}|])")
OPTION = re.compile(r"(?<![\w`-])(--[a-z][a-z-]*)")


def help_of(beeline, *verb):
    return subprocess.run([beeline, *verb, "--help"], check=True, capture_output=True, text=True).stdout


def sections(text):
    """(title, lines) of each part of a help text; the first has no title."""
    found = [("", [])]
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][^.]*:", line) and line.startswith(("Arguments", "Options", "Examples", "Verbs")):
            found.append((line[:-1], []))
        else:
            found[-1][1].append(line)
    return found


def entries(lines):
    """(name, description) of each argument, option or verb."""
    found = []
    for line in filter(None, lines):
        entry = ENTRY.match(line)
        if entry:
            found.append((entry[1], [entry[2] or ""]))
        elif line.startswith(" " * COLUMN) and found:
            found[-1][1].append(line.strip())
        else:
            raise ValueError(f"help has a line that is neither an entry nor its description: {line!r}")
    return [(name, " ".join(filter(None, words))) for name, words in found]


def markdown(text):
    """Text in which only `code` and options are markup."""
    parts = text.split("`")
    parts[::2] = [OPTION.sub(r"`\1`", MARKUP.sub(r"\\\1", part)) for part in parts[::2]]
    return "`".join(parts)


def paragraphs(lines):
    """The introduction: its paragraphs, the usage and lists as they are printed."""
    blocks = "\n".join(lines).strip().split("\n\n")
    for block in blocks:
        if block.startswith("Usage: ") or "\n  " in block:
            yield f"```text\n{block.removeprefix('Usage: ')}\n```"
        else:
            yield markdown(" ".join(block.split()))


def examples(lines):
    """The commands below each remark."""
    for part in "\n".join(lines).split("  # ")[1:]:
        remark, *commands = part.strip().splitlines()
        yield f"{markdown(remark)}:\n\n```sh\n" + "\n".join(map(str.strip, commands)) + "\n```\n"


def described(beeline, verb, level):
    """The text of one verb, and of the verbs below it."""
    found, below = [f"{'#' * level} beeline {' '.join(verb)}\n"], []
    for title, lines in sections(help_of(beeline, *verb)):
        if not title:
            found += [f"{text}\n" for text in paragraphs(lines)]
            continue
        found.append(f"{'#' * (level + 1)} {title}\n")
        if title == "Examples":
            found += examples(lines)
            continue
        for name, text in entries(lines):
            found.append(f"`{name}`\n: {markdown(text)}\n")
            if title == "Verbs":
                below.append(described(beeline, [*verb, name], level + 1))
    return "\n".join(found + below)


def main(beeline, output):
    output.mkdir(parents=True, exist_ok=True)
    parts = sections(help_of(beeline))
    verbs = entries(dict(parts)["Verbs"])
    for verb, _ in verbs:
        (output / f"{verb}.md").write_text(described(beeline, [verb], 1))
    options = dict(parts)["Options"]
    after = options[options.index("") + 1:]  # what the overview says after its options
    overview = "\n\n".join([*paragraphs(parts[0][1]), *paragraphs(after)])
    rows = [(verb, f"`{verb}`", markdown(text)) for verb, text in verbs]
    write_index(output, "Command line", overview, ("verb", "does"), rows)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
