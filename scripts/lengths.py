#!/usr/bin/env python3
"""Refuses files and C++ functions that nobody can take in at once.

Usage: lengths.py"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MAX_FILE, MAX_FUNCTION = 400, 60  # lines
FOLDERS = ("beeline", "cli", "tests", "bench", "examples", "cmake", "mpi", "packaging", "python", "scripts", "web/core",
           "web/src", "web/npm", "web/tests")
CODE = {".h", ".cpp"}
ENDINGS = CODE | {".py", ".sh", ".cmake", ".txt", ".ts", ".css", ".html"}

# What holds no braces of the code: comments, strings (raw ones, too), characters, directives.
SILENT = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\''
    r"|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE)
NOT_FUNCTION = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b[^()]*$|=\s*$")


def blank(match):
    """As many lines, without what they say."""
    return re.sub(r"[^\n]", " ", match[0])


def functions(text):
    """(first line, lines, signature) of each function and member function."""
    code = re.sub(r"(?<=[0-9a-fA-F])'(?=[0-9a-fA-F])", " ", text)
    code = SILENT.sub(blank, code)
    begin, open_functions, stack = 0, 0, []
    for at in re.finditer(r"[{};]", code):
        if at[0] == "{":
            head = code[begin:at.start()]
            inside = open_functions > 0
            is_function = not inside and "(" in head and not NOT_FUNCTION.search(head)
            stack.append((begin + len(head) - len(head.lstrip()), head, is_function))
            open_functions += is_function
        elif at[0] == "}" and stack:
            start, head, was_function = stack.pop()
            if was_function:
                open_functions -= 1
                lines = code.count("\n", start, at.start()) + 1
                yield code.count("\n", 0, start) + 1, lines, " ".join(head.split())
        begin = at.end()


def main():
    found = []
    paths = [ROOT / "CMakeLists.txt", ROOT / "Makefile"]
    for folder in FOLDERS:
        paths += sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in ENDINGS)
    for path in paths:
        text = path.read_text()
        name, lines = path.relative_to(ROOT), text.count("\n")
        if lines > MAX_FILE:
            found.append(f"{name}: {lines} lines; {MAX_FILE} is the most")
        if path.suffix in CODE:
            found += [f"{name}:{line}: {count} lines in {head}; {MAX_FUNCTION} is the most"
                      for line, count, head in functions(text) if count > MAX_FUNCTION]
    print("\n".join(found), end="\n" if found else "")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
