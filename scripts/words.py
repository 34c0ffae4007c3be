#!/usr/bin/env python3
"""Refuses phrases that are no terms of the field, with what to write instead (docs/notation.md).

Usage: words.py

In CHANGELOG.md an old name may stand between backquotes, and its older entries keep their sentences."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACES = ("beeline", "cli", "tests", "bench", "examples", "docs", "cmake", "mpi", "packaging", "python", "scripts",
          "web/core", "web/src", "web/npm", "web/tests", "web/index.html", "README.md",
          "CHANGELOG.md", "CONTRIBUTING.md", "CMakeLists.txt", "Makefile", "layers.txt")
ENDINGS = {".h", ".cpp", ".py", ".sh", ".md", ".txt", ".cmake", ".in", ".ts", ".css", ".html", ""}
INSTEAD = {
    "law of time": "time scaling",
    "laws of time": "time scalings",
    "give the way": "retime",
    "the way is gone": "the path is traversed",
    "joint to spare": "redundant joint",
    "joints to spare": "redundant joints",
    "spare joint": "redundant joint",
    "drawn taut": "smoothed in the null space",
    "most samples": "max samples",
    "most steps": "max steps",
    "most restarts": "max restarts",
    "most turn away": "max orientation error",
    "deck of starts": "seed table",
    "start deck": "seed table",
    "limits the wrong way round": "lower limit exceeds upper limit",
    "that is no number": "NaN",
    "that are no numbers": "NaN",
    "of other make": "another implementation",
    "hands back": "returns",
    "hand back": "return",
    "handed back": "returned",
    "what becomes of": "outcome",
    "against what stays": "violation of an invariant",
    "answer at once": "fast path",
    "clock barrier": "barrier method",
    # Constructions that are read twice: name the noun, or begin a sentence with the subject.
    "that of": "the noun again: the limit of joint 2",
    "those of": "the noun again: the limits of joint 2",
    "what of": "which part of",
    "of a no": "of a negative answer",
    "than which": "a sentence of its own: so that ... is never worse than",
    "on which": "where, or a sentence of its own",
    "but for": "except",
    "is gone": "is removed",
    "hands on": "passes on",
    "is told": "is reported",
    "the way of": "how",
}
# Words may be parted by a line's end (and the comment's slashes), by _ or by -.
GAP = r"(?:[ \t]+|[_-]|[ \t]*\n[ \t]*(?://+|#|\*)?[ \t]*)"
PATTERN = re.compile(
    "|".join(rf"(?<![a-z]){GAP.join(map(re.escape, phrase.split()))}(?![a-z])"
             for phrase in INSTEAD), re.IGNORECASE)


def sources():
    for place in PLACES:
        path = ROOT / place
        found = [path] if path.is_file() else sorted(path.rglob("*"))
        yield from (file for file in found if file.is_file() and file.suffix in ENDINGS
                    and not {"__pycache__", "corpus"} & set(file.parts) and file != Path(__file__).resolve())


def quoted(text, match):
    """Whether the match stands between backquotes of its line."""
    line = text.rfind("\n", 0, match.start()) + 1
    return text.count("`", line, match.start()) % 2 == 1


def main():
    found = []
    for path in sources():
        text = path.read_text()
        for match in PATTERN.finditer(text):
            if path.name == "CHANGELOG.md" and quoted(text, match):
                continue
            phrase = " ".join(re.split(r"[\s_/#*-]+", match[0])).lower()
            line = text.count("\n", 0, match.start()) + 1
            found.append(f"{path.relative_to(ROOT)}:{line}: '{phrase}': {INSTEAD[phrase]}")
    print("\n".join(found), end="\n" if found else "")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
