"""A small parser of URScript: blocks that end with `end`, and calls with named arguments. It knows the
statements of an exported motion and refuses any other."""

import re

OPENS = re.compile(r"(def \w+\([\w, ]*\)|if .+|while .+):")
SIMPLE = re.compile(r"halt|return \w+|(local )?\w+ = .+")
CALL = re.compile(r"(\w+)\((.*)\)")
ARGUMENT = re.compile(r"(?:(\w+)=)?(p?\[[^\]]*\]|\"[^\"]*\"|[^,\[\"]+)(?:, |$)")


def arguments(text):
    found, at = {}, 0
    while at < len(text):
        match = ARGUMENT.match(text, at)
        assert match, text[at:]
        found[match[1] or len(found)] = match[2]
        at = match.end()
    return found


def numbers(text):
    """A list of numbers, or a pose p[...]."""
    assert text.removeprefix("p").startswith("[") and text.endswith("]"), text
    return [float(item) for item in text.removeprefix("p")[1:-1].split(",")]


def read(text):
    """(comments, calls outside of inner blocks as (name, arguments), assignments) of one program."""
    depth, comments, calls, values = 0, [], [], {}
    for line in text.splitlines():
        line = line.strip()
        assert all(" " <= c <= "~" for c in line), line
        if line.startswith("#"):
            assert depth == 0
            comments.append(line)
        elif OPENS.fullmatch(line):
            assert depth > 0 or line == "def beeline_motion():"
            depth += 1
        elif line == "end":
            depth -= 1
            assert depth >= 0
        elif SIMPLE.fullmatch(line):
            if depth == 1 and " = " in line:
                name, value = line.split(" = ", 1)
                values[name] = value
        else:
            call = CALL.fullmatch(line)
            assert call and depth > 0, line
            if depth == 1:
                calls.append((call[1], arguments(call[2])))
    assert depth == 0
    return comments, calls, values
