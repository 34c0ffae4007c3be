"""Writes what the documentation comments of public declarations in headers say, as a table for C++.

Its rows are {"Type::member", "text for Python"}.

The comments are the one place where structs, their members and enumerators are described. Their words become Python's
by the rules of for_python(). The headers are formatted by clang-format, so a scan without a grammar suffices.

Usage: header_texts.py TABLE HEADER..."""

import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

TOKEN = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|#[^\n]*|[{};]|[^/"\'#{};]+|.')
SCOPE = re.compile(r"\s*(?:template <.*> *)?(namespace|enum class|enum|struct|class|union)\b ?([\w:]*)([^;()=]*)$")
TYPES = ("struct", "class", "enum", "enum class")
# The shapes of the arrays that these types are in Python.
SHAPES = {
    "Configuration": "(n,)",
    "std::vector<Configuration>": "(N, n)",
    "Pose": "(4, 4)",
    "std::vector<Pose>": "(N, 4, 4)",
    "Vector3": "(3,)",
    "Twist": "(6,)",
}
SHAPE = re.compile(r"\((?:[nNmS3-6]|\.\.\.)(?:,| - 1,)[^()]*\)")
# A first word that is not a word of a sentence: a unit, a formula, code.
SYMBOL = re.compile(r"(?:rad|m|s|kg|dq)\b|[a-z]?[^a-z]|[a-z]+[\d_/^*(\[]")
PYTHON = [
    (r"\bstd::nullopt\b", "None"),
    (r"\btrue\b(?=[:;,.)]|$)", "True"),
    (r"\bfalse\b(?=[:;,.)]|$)", "False"),
    (r"\bthrown\b", "raised"),
    (r"\bThrows\b", "Raises"),
    (r" \([\w/]+\.h\)| in [\w/]+\.h\b", ""),
    (r" \(check_\w+\(\)(?:, check_\w+\(\))*\)", ""),  # functions of C++ alone
    (r"\bforms of PoseForm\b", "forms of `pose_form`"),
    (r"ReachGrid::cartesian_axes\(\)", "the Cartesian grid of the same spacing"),
    (r"\bdof\b", "n"),
    (r"\bmiddle_configuration\(\)", "arm.middle"),
    (r"\|([^|]+)\|", r"abs(\1)"),
    (r"\boptions\.(\w+)", r"`\1`"),
    (r"\bBudget::(\w+)", r"`\1`"),
    # Enumerators are names, and options are keywords.
    (r"\b(?:\w+Options|ReasonCode|Redundancy|Frame|TrackerStatus|Profile|DhConvention|Synchronise)::(\w+)", r"`\1`"),
    (r"\bCartesianMethod::inverse_kinematics\b", "`inverse-kinematics`"),
    (r"(?<=[A-Za-z])::(?=\w)", "."),
    (r"\bbuilt_in\(\)", "Arm.load()"),
    (r"(`a|offset) \* (b|exp)", r"\1 @ \2"),  # products of poses
]


@dataclass
class Entry:
    """A name that a header declares: a struct, a member with its type, an enumerator, or a function, without a type."""

    name: str
    scope: str  # `struct`, `enum class`, ... that has the member; `namespace`
    type: str
    text: str  # of the comment; may be empty
    place: str


def declared(statement: str) -> tuple[str, list[str]]:
    """The type and the names that a declaration declares: more than one as in `double a = 0, b = 0`."""
    bare = " ".join(statement.split())
    bare = re.sub(r"\b(alignas\(\w+\)|static|constexpr|inline|mutable|explicit|virtual)\s*", "", bare)
    bare = re.sub(r"^(template <[^;]*?> |\[\[\w+\]\] )*", "", bare)
    if re.search(r"\boperator\b(?! bool)", bare):
        return "", []
    flat = bare
    while re.search(r"<[^<>]*>", flat):
        flat = re.sub(r"<[^<>]*>", lambda found: "\0" * len(found[0]), flat)
    function = re.match(r"[^(=]*?([\w~]+) ?\(", flat)
    if function:
        return "", [function[1]]
    first = re.match(r"(.*?)[ &*](\w+)(?:\[\w+\])?(?= ?[={,;]| ?$)", flat)
    if not first:
        return "", []
    names = [first[2]] + re.findall(r", (\w+)(?=[ ,={]|$)", re.sub(r"\{[^}]*\}", "", flat[first.end() :]))
    return bare[: first.end(1)], names


def joined(lines: list[str]) -> str:
    """The lines of a comment as paragraphs, lists and formulas, which keep their lines."""
    blocks: list[tuple[str, str]] = []
    for line in lines:
        kind = "text" if line else ""
        if line.startswith("- ") or (line.startswith("  ") and blocks and blocks[-1][0] == "list"):
            kind = "list"
        elif line.startswith("  "):
            kind = "formula"
        if kind and blocks and blocks[-1][0] == kind:
            blocks[-1] = (kind, blocks[-1][1] + (" " if kind == "text" else "\n") + line)
        else:
            blocks.append((kind, "::\n\n" + line if kind == "formula" else line))
    return "\n\n".join(text for kind, text in blocks if kind)


class Scan:
    """Reads the tokens of a header, with the scopes around them, the statement so far and the comment above it."""

    def __init__(self, path: Path):
        self.path, self.line, self.depth = path, 1, 0  # depth of braces in a body or an initialiser
        self.found: list[Entry] = []
        self.last: list[Entry] = []  # what a comment behind them describes
        self.scopes: list[tuple[str, str]] = [("namespace", "")]
        self.hidden = [False]  # of each scope: whether what follows is not public
        self.start_statement()

    def start_statement(self) -> None:
        self.statement = ""
        self.above: list[str] = []

    def add(self, name: str, scope: str, type: str) -> Entry:
        entry = Entry(name, scope, type, joined(self.above), f"{self.path}:{self.line}")
        if not self.hidden[-1]:
            self.found.append(entry)
        return entry

    def end_statement(self) -> None:
        kind, scope = self.scopes[-1]
        text = " ".join(self.statement.split())
        specialised = kind != "namespace" and not scope
        if text and not specialised and not text.startswith(("using", "friend", "static_assert", "template")):
            type, names = ("", re.findall(r"^\w+", text)) if kind.startswith("enum") else declared(text)
            self.last = [self.add(scope + "::" * bool(scope) + name, kind, type) for name in names]
        self.start_statement()

    def open(self) -> None:
        scope = SCOPE.match(" ".join(self.statement.split()))
        if not scope:
            self.depth = 1
            return
        kind = scope[1]
        name = "" if kind == "namespace" or scope[3].startswith("<") else scope[2].split("::")[-1]
        if name:
            self.add(name, "namespace", kind)
        self.scopes.append((kind, name))
        self.hidden.append(self.hidden[-1] or kind == "class")
        self.start_statement()
        self.last = []

    def in_braces(self, token: str) -> None:
        self.depth += (token == "{") - (token == "}")
        if self.depth:
            return
        head = self.statement
        self.statement += "{}"
        if re.search(r"\)[^=]*$", head) and "=" not in head.split("(")[0]:
            self.end_statement()  # a function

    def close(self) -> None:
        if self.scopes[-1][0].startswith("enum"):
            self.end_statement()
        self.scopes.pop()
        self.hidden.pop()
        self.start_statement()
        self.last = []

    def take(self, token: str) -> None:
        if token.startswith("///<"):
            if self.statement.strip():  # inside a declaration, or of the last enumerator
                self.end_statement()
            for entry in self.last:
                entry.text = (entry.text + " " + token[4:].strip()).strip()
        elif token.startswith("///"):
            self.above.append(token[3:].removeprefix(" ").rstrip())
        elif token.startswith(("//", "#")):
            pass
        elif self.depth:
            self.in_braces(token)
        elif token == "{":
            self.open()
        elif token == "}":
            self.close()
        elif token == ";":
            self.end_statement()
        elif self.scopes[-1][0].startswith("enum"):
            *ended, rest = token.split(",")
            for part in ended:
                self.statement += part
                self.end_statement()
            self.statement += rest
        else:
            access = re.match(r"\s*(public|private|protected): ?", token) if not self.statement.strip() else None
            if access:
                self.hidden[-1] = access[1] != "public"
                self.line += token[: access.end()].count("\n")
                token = token[access.end() :]
            self.statement += token
            if not self.statement.strip() and "\n\n" in token:
                self.above = []
        self.line += token.count("\n")


def entries(path: Path) -> list[Entry]:
    """All names that a header declares, and what their comments say."""
    scan = Scan(path)
    for token in TOKEN.findall(path.read_text()):
        scan.take(token)
    return scan.found


def for_python(entry: Entry) -> str:
    """The comment as a docstring: sentences, Python's words, the shape of an array. An enumerator's is a clause."""
    text = entry.text
    for pattern, replacement in PYTHON:
        text = re.sub(pattern, replacement, text)
    if entry.scope.startswith("enum"):
        return text.rstrip(".")
    if entry.type == "Reason":  # a str
        text = re.sub(r"\bnone\b", "empty", text)
    if re.match(r"a ", text) or not SYMBOL.match(text):
        text = text[0].upper() + text[1:]
    if not text.endswith("."):
        text += "."
    shape = SHAPES.get(re.sub(r"^std::optional<(.*)>$", r"\1", entry.type))
    if not shape or SHAPE.search(text):
        return text
    return f"{text} Shape {shape}." if re.search(r"[.;:] ", text) else f"{text[:-1]}, {shape}."


def table(paths: list[Path]) -> dict[str, str]:
    """The docstring of each declaration that has a comment."""
    texts: dict[str, tuple[str, str]] = {}
    for entry in (entry for path in paths for entry in entries(path)):
        if not entry.text:
            continue
        text, place = texts.setdefault(entry.name, (for_python(entry), entry.place))
        member = entry.type and entry.scope != "namespace"
        if (member or entry.type in TYPES) and text != for_python(entry):  # of overloads, the first one counts
                sys.exit(f"{entry.place}: {place} describes {entry.name} by other words")
    return {name: text for name, (text, _) in sorted(texts.items())}


def main(output: Path, headers: list[Path]) -> None:
    quoted = [[json.dumps(text, ensure_ascii=False) for text in row] for row in table(headers).items()]
    text = "".join(f"{{{name}, {docstring}}},\n" for name, docstring in quoted)
    if not output.exists() or output.read_text() != text:
        output.write_text(text)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), [Path(path) for path in sys.argv[2:]])
