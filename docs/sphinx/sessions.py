#!/usr/bin/env python3
"""The pages of docs/ as what a reader types: files with a name, and sessions with the command.

Usage: sessions.py BEELINE_FOLDER DOCS FOLDER

Runs the sessions of each page, howto/line.md in FOLDER/howto/line, for the pictures that they write. That they
print what the pages show is tested (tests/docs/pages_test.py)."""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

FENCE = re.compile(r"^(?P<ticks>`{3,})(?P<language>[^\n`]*)\n(?P<body>.*?)^(?P=ticks)$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*[A-Za-z_])")


def blocks(page):
    """(language, options, body) of each fenced block; directives have their options taken off the body."""
    for fence in FENCE.finditer(page.read_text()):
        lines, options = fence["body"].splitlines(), {}
        while fence["language"].startswith("{") and lines and lines[0].startswith(":"):
            name, _, value = lines.pop(0)[1:].partition(":")
            options[name] = value.strip()
        yield fence["language"].strip(), options, "\n".join(lines).strip("\n")


def named_file(page, language, options, body):
    """(name, text) of a block that shows a file whose name is its caption; else None."""
    if not re.fullmatch(r"\w+\.\w+", options.get("caption", "")):
        return None
    if language.startswith("{literalinclude}"):
        body = (page.parent / language.split()[1]).read_text()
    return options["caption"], body.rstrip("\n") + "\n"


def commands(session):
    """(command, expected lines) of each prompt of a session."""
    found = []
    for line in session.splitlines():
        if line.startswith("$ "):
            found.append([line[2:], []])
        elif line.startswith("> ") and not found[-1][1]:
            found[-1][0] += "\n" + line[2:]
        else:
            found[-1][1].append(line)
    return found


def run(command, folder, build, last_code):
    """(exit code, lines) of a command in a shell in which `beeline` is the one of the build."""
    environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}"}
    process = subprocess.run(["bash", "-c", f"(exit {last_code})\n{command}"], cwd=folder, env=environment,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return process.returncode, process.stdout.splitlines()


def steps(page, folder, build):
    """Runs a page in a folder. Yields (command, exit code, lines printed, lines shown) of each prompt."""
    code = 0
    for language, options, body in blocks(page):
        file = named_file(page, language, options, body)
        if file:
            (folder / file[0]).write_text(file[1])
        for command, shown in commands(body) if language == "console" else []:
            code, printed = run(command, folder, build, code)
            yield command, code, printed, shown


def same_number(a, b):
    """Rounding errors of other instruction sets: 2 %, and any two below 1e-6 are both zero."""
    return math.isclose(float(a), float(b), rel_tol=0.02, abs_tol=1e-6)


def same_line(shown, printed):
    """Whether two lines differ in blanks and in the last digits of numbers only."""
    words = [" ".join(NUMBER.sub("#", line).split()) for line in (shown, printed)]
    numbers = [NUMBER.findall(line) for line in (shown, printed)]
    return words[0] == words[1] and all(map(same_number, *numbers))


def difference(shown, printed):
    """Why the lines shown are not those printed, or "". A line `...` stands for any lines."""
    at = 0
    gap = False
    for line in shown:
        if line.strip() == "...":
            gap = True
            continue
        if gap:
            at = next((i for i in range(at, len(printed)) if same_line(line, printed[i])), len(printed))
        if at == len(printed):
            return f"not printed: {line!r}"
        if not same_line(line, printed[at]):
            return f"shown {line!r}, printed {printed[at]!r}"
        at, gap = at + 1, False
    if at < len(printed) and not gap:
        return f"printed, but not shown: {printed[at]!r}"
    return ""


def main(build, docs, output):
    for page in sorted(docs.rglob("*.md")):
        folder = output / page.relative_to(docs).with_suffix("")
        folder.mkdir(parents=True, exist_ok=True)
        for command, code, printed, _ in steps(page, folder, build):
            if code > 3:
                sys.exit(f"{page}: {command}: exit code {code}\n" + "\n".join(printed))


if __name__ == "__main__":
    main(*(Path(argument).resolve() for argument in sys.argv[1:]))
