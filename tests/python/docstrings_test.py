"""Docstrings of structs are the comments of the headers, and stand nowhere else."""

import builtins
import inspect
import re
import sys
from pathlib import Path

import pytest

import beeline

ROOT = Path(__file__).resolve().parents[2]
SOURCES = sorted((ROOT / "python" / "src").glob("*.*"))
sys.path.insert(0, str(ROOT / "python"))

import header_texts  # noqa: E402

CLASSES = [value for name in beeline._core.__all__ if inspect.isclass(value := getattr(beeline, name))]
EXCEPTION = (BaseException,)


def public_headers():
    internal = re.compile(r"/internal/|-inl\.h$|beeline/math/|inverse/(analytic|numerical)/")
    return [path for path in sorted((ROOT / "beeline").rglob("*.h")) if not internal.search(path.as_posix())]


def entries_of(tmp_path, text):
    header = tmp_path / "header.h"
    header.write_text(text)
    return {entry.name: entry for entry in header_texts.entries(header)}


@pytest.mark.parametrize("described", CLASSES, ids=lambda described: described.__name__)
def test_every_class_and_each_of_its_attributes_has_a_docstring(described):
    assert described.__doc__
    if issubclass(described, EXCEPTION):
        return
    attributes = {name: value for name, value in vars(described).items() if not name.startswith("_")}
    undocumented = [name for name, value in attributes.items() if not (inspect.getdoc(value) or "").strip(" .")]
    assert undocumented == []


def test_every_parameter_has_a_sentence():
    counted = 0
    functions = [value for name in beeline._core.__all__ if callable(value := getattr(beeline, name))]
    functions += [value for described in CLASSES for value in vars(described).values() if callable(value)]
    for function in functions:
        _, heading, rest = (function.__doc__ or "").partition("Parameters\n----------\n")
        lines = re.split(r"\n\n\w+\n---", rest)[0].rstrip().split("\n") if heading else []
        names = [i for i, line in enumerate(lines) if re.match(r"\w+ : ", line)]
        for i in names:
            assert i + 1 < len(lines) and re.fullmatch(r"    \S.*[.:]|    \S.*", lines[i + 1]), (function, lines[i])
            counted += 1
    assert counted > 400


def test_every_member_of_python_is_described_in_its_header():
    texts = header_texts.table(public_headers() + [path for path in SOURCES if path.suffix == ".h"])
    enumerations = {name.split("::")[0] for name in texts if "::" in name}
    members = re.findall(r"&(\w+(?:::\w+)+)", "".join(re.findall(r": Members<(.*?)>", sources(), re.DOTALL)))
    assert len(members) > 500
    without = {"::".join(member.split("::")[-2:]) for member in members} - set(texts)
    # Their words are of their enumeration, of the keywords of a budget, or of the structs of which these are the arrays.
    assert {name for name in without if name.split("::")[1] not in ("kind", "status", "method", "budget")} == {
        "ServoMotion::scale", "ServoMotion::limit", "ServoMotion::joint", "ServoMotion::bodies", "ServoMotion::proved",
        "SliceArray::arm", "SliceArray::measure", "SliceArray::at", "SliceArray::grid", "SliceArray::values",
        "CellArrays::branches", "CellArrays::manipulability", "CellArrays::margin", "CellArrays::ending",
        "PositionArrays::directions", "PositionArrays::branches", "PositionArrays::manipulability",
        "PositionArrays::margin"}
    assert "Profile" in enumerations


def docstrings():
    """The docstrings of the module, each without the line of its signature."""
    for name in beeline._core.__all__:
        value = getattr(beeline, name)
        yield name, inspect.getdoc(value) or ""
        for member, described in (vars(value).items() if inspect.isclass(value) else ()):
            yield f"{name}.{member}", (inspect.getdoc(described) or "") if member != "__dict__" else ""


def test_docstrings_name_things_that_python_has():
    """Classes with their attributes, and functions with an empty list of arguments."""
    attributes = {member for described in CLASSES for member in dir(described)}
    programs = {"servoj"}  # a function of robots
    counted, unknown = 0, set()
    for place, text in docstrings():
        text = re.sub(r"^[^\n]*->[^\n]*\n", "", text)
        for described, member in re.findall(r"\b([A-Z][a-z]\w*)\.([a-z]\w*)", text):
            counted += 1
            if not hasattr(getattr(beeline, described, None), member):
                unknown.add((place, f"{described}.{member}"))
        for function in re.findall(r"(?<![\w.])([a-z]\w+)\(\)", text):
            counted += 1
            if not (hasattr(beeline, function) or function in attributes | programs | set(dir(builtins))):
                unknown.add((place, function + "()"))
        unknown.update((place, name) for name in re.findall(r"\w+::\w+", text))
    assert counted > 100 and unknown == set()


def test_functions_that_return_arrays_say_which():
    for function in (beeline.pose_of, beeline.parse_pose, beeline.read_poses, beeline.pose_numbers):
        assert "\nReturns\n-------\n" in function.__doc__, function


def sources():
    return "".join(re.sub(r'"\s*\n\s*"', "", path.read_text()) for path in SOURCES)


def test_no_sentence_of_a_member_is_repeated():
    texts = header_texts.table(public_headers())
    members = {text: name for name, text in texts.items() if "::" in name and len(text) > 40}
    literals = [text for text in re.findall(r'"((?:[^"\\]|\\.)*)"', sources()) if len(text) > 40]
    repeated = {(members[text], literal) for literal in literals for text in members if text in literal}
    assert len(members) > 400
    assert repeated == set()


def test_members_have_the_words_of_the_header():
    assert beeline.TimeScaling.speed.__doc__ == "ds/dt, (N,)."
    assert beeline.Line.from_.__doc__ == "Pose at s = 0, (4, 4)."
    assert "`s-curve`: " in beeline.retime.__doc__
    assert "J q̇ = α v" in beeline.Servo.__doc__
    assert beeline.Retimed.__bool__.__doc__.endswith("Whether there is a motion and it is the best one.")
    assert "Deviation | tuple[float, float], default (0.0001, 0.001)" in beeline.Tracker.__init__.__doc__


def test_comments_belong_to_the_declarations(tmp_path):
    text = """
#pragma once
namespace beeline {
/// A thing: it has
/// two lines.
struct Thing {
  double a = 0;  ///< of the first, m
  /// Above it; std::nullopt: none.
  std::optional<double> b = std::nullopt;
  std::vector<std::pair<int, std::string>> c = {{1, "x; y"}}, d;  ///< a pair
                                                                  ///< of lines
  int none = 0;
  enum class Kind { one, two };
  /// Whether it is so.
  explicit operator bool() const { return a > 0; }  // no matter; {
  double sum() const { return a + 1; }
  Pose pose = Pose::Identity();  ///< where it is
};
enum class Colour {
  red,   ///< the first
  /// The second; or not.
  green,
  blue  ///< the last
};
class Kept {
 public:
  int shown() const { return hidden_; }  ///< what it shows

 private:
  struct Part {
    int size = 0;  ///< not for users
  };
  int hidden_ = 0;  ///< not for users
 public:
  int open = 0;  ///< for users
};
Thing made(const Thing& thing, double x = 1);  ///< makes one
/// Throws Error for a sign, |x| < 1.
///
/// - item
///   and its rest
void refuse(Thing thing);
}
"""
    found = entries_of(tmp_path, text)
    docstrings = {name: header_texts.for_python(entry) for name, entry in found.items() if entry.text}
    assert docstrings == {
        "Thing": "A thing: it has two lines.",
        "Thing::a": "Of the first, m.",
        "Thing::b": "Above it; None: none.",
        "Thing::c": "A pair of lines.",
        "Thing::d": "A pair of lines.",
        "Thing::bool": "Whether it is so.",
        "Thing::pose": "Where it is, (4, 4).",
        "Colour::red": "the first",
        "Colour::green": "The second; or not",
        "Colour::blue": "the last",
        "Kept::shown": "What it shows.",
        "Kept::open": "For users.",
        "made": "Makes one.",
        "refuse": "Raises Error for a sign, abs(x) < 1.\n\n- item\n  and its rest.",
    }
    assert found["Thing::none"].text == ""
    assert found["Thing::c"].type == "std::vector<std::pair<int, std::string>>"


@pytest.mark.parametrize(
    "comment, type, docstring",
    [
        ("rad or m", "Configuration", "rad or m, (n,)."),
        ("none when reached", "Reason", "Empty when reached."),
        ("none: planar", "std::optional<Form>", "None: planar."),
        ("a bound on it", "double", "A bound on it."),
        ("q of B = gain * q of A", "double", "q of B = gain * q of A."),
        ("sqrt(det(J J^T))", "double", "sqrt(det(J J^T))."),
        ("m/s; empty where not known", "std::vector<Configuration>", "m/s; empty where not known. Shape (N, n)."),
        ("J dq, one for each row, (m,)", "Configuration", "J dq, one for each row, (m,)."),
        ("from 0 to dof - 1, with options.all", "int", "From 0 to n - 1, with `all`."),
        ("Redundancy::nearest or Arm::reach()", "int", "`nearest` or Arm.reach()."),
        ("see MatchOptions::angle_unit and DhConvention::standard", "int", "See `angle_unit` and `standard`."),
    ],
)
def test_words_become_pythons(comment, type, docstring):
    assert header_texts.for_python(header_texts.Entry("A::b", "struct", type, comment, "")) == docstring


def test_a_struct_is_described_once(tmp_path):
    header = tmp_path / "twice.h"
    header.write_text("/// One.\nstruct A { int b; };\n/// Two.\nstruct A { int b; };\n")
    with pytest.raises(SystemExit, match="describes A by other words"):
        header_texts.table([header])
