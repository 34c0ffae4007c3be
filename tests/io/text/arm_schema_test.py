"""docs/arm.schema.json says what the reader takes: an arm passes both or neither."""

import json
import subprocess

import jsonschema
import pytest


@pytest.fixture(scope="module")
def validator(root):
    schema = json.loads((root / "docs" / "arm.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def beeline(build, *arguments):
    return subprocess.run([build / "beeline", *arguments], capture_output=True, text=True)


def joint(**keys):
    return {"name": "a", "joints": [{"name": "j", **keys}]}


def dh(convention, *rows):
    return {"name": "a", "dh": {"convention": convention, "rows": list(rows)}}


POSE = {"xyz": [1, 2, 3], "rpy": [0.1, 0.2, 0.3]}
TURN = {"qw": 1, "qx": 0, "qy": 0, "qz": 0}
MATRIX = [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]

TURNING = {"w": [0, 0, 1], "v": [0, 0, 0]}


def screws(*rows, **keys):
    return {"name": "a", "screws": {"frame": "body", "home": POSE, "rows": list(rows)}, **keys}


GOOD = [
    screws(TURNING, {"name": "s", "w": [0, 0, 0], "v": [1, 0, 0], "limits": {"lower": 0}}),
    screws({"w": [0, 1, 0], "point": [1, 2, 3]}, {"w": [0, 1, 0], "point": [1, 2, 3], "pitch": 0.1}),
    {"name": "a", "joint_string": "RRP:1,0.5@90,0"},
    {"name": "a", "joint_string": "RHS", "base": POSE, "tool": {"matrix": MATRIX}},
    {"name": "a", "joint_string": "RR", "base": POSE, "controller_base": POSE, "flange": {"xyz": [0, 0, 0.1]}},
    {"name": "a", "joint_string": "RR", "controller_base": {}},
    dh("standard", {"a": 1, "alpha": 0.5}, {"type": "prismatic", "name": "q"}),
    dh("modified", {"d": 1, "limits": {"lower": -1, "upper": 1, "jerk": 3}}),
    {"name": "a", "dh": {"convention": "standard", "degrees": True, "rows": [{"alpha": 90}]}},
    {"name": "a", "maker": "M", "model": "1", "source": "manual", "note": "", "joint_string": "R"},
    {"name": "a", "joint_names": [["x"], ["y"]], "joint_string": "R"},
    {"name": "a", "joint_names": [], "joint_string": "R"},
    joint(type="revolute"),
    joint(type="revolute", axis=[0, 1, 0], point=[1, 0, 0], origin={"quaternion": TURN}),
    joint(type="prismatic", axis=[0, 1, 0], limits={}, link="l"),
    joint(type="helical", pitch=0.01),
    joint(type="helical", screw=[0, 0, 0.1, 0, 0, 1]),
    joint(type="spherical", origin=POSE, link="hand"),
    {
        "name": "a",
        "joints": [
            {"name": "j", "type": "universal"},
            {"name": "k", "type": "revolute", "mimic": {"joint": "j_z", "multiplier": 2}},
        ],
    },
]

BAD = [
    screws(),
    screws({"w": [0, 0, 1]}),
    screws({"v": [0, 0, 1]}),
    screws({**TURNING, "point": [0, 0, 0]}),
    screws({**TURNING, "pitch": 1}),
    screws({"w": [0, 0], "v": [0, 0, 0]}),
    screws(TURNING, tool=POSE),
    screws(TURNING, base=POSE),
    screws(TURNING, joints=[]),
    {"name": "a", "screws": {"home": POSE, "rows": [TURNING]}},
    {"name": "a", "screws": {"frame": "body", "rows": [TURNING]}},
    {"name": "a", "screws": {"frame": "tool", "home": POSE, "rows": [TURNING]}},
    [],
    {"joint_string": "RR"},
    {"name": "", "joint_string": "RR"},
    {"name": "a\nb", "joint_string": "RR"},
    {"name": "a"},
    {"name": "a", "joint_string": "rr"},
    {"name": "a", "joint_string": "RR", "joints": []},
    {"name": "a", "joints": []},
    {"name": "a", "joint_string": "RR", "speed": 1},
    {"name": "a", "joint_string": "RR", "base": {"xyz": [1, 2]}},
    {"name": "a", "joint_string": "RR", "controller_base": [0, 0, 1]},
    {"name": "a", "joint_string": "RR", "flange": {"rpy": [0, 0]}},
    {"name": "a", "joint_string": "RR", "base": {"matrix": MATRIX, "xyz": [1, 2, 3]}},
    {"name": "a", "joint_string": "RR", "base": {"matrix": MATRIX[:3]}},
    {"name": "a", "joint_string": "RR", "tool": {"rpy": [0, 0, 0], "quaternion": TURN}},
    {"name": "a", "joint_string": "RR", "tool": {"quaternion": [1, 0, 0, 0]}},
    {"name": "a", "dh": {"rows": [{}]}},
    {"name": "a", "dh": {"convention": "standard", "degrees": "yes", "rows": [{"alpha": 90}]}},
    {"name": "a", "maker": 1, "joint_string": "R"},
    {"name": "a", "joint_names": ["x"], "joint_string": "R"},
    {"name": "a", "joint_names": [[]], "joint_string": "R"},
    {"name": "a", "joint_names": [[""]], "joint_string": "R"},
    {"name": "a", "joint_names": [["x"], [1]], "joint_string": "R"},
    dh("craig", {}),
    dh("standard"),
    dh("standard", {"b": 1}),
    dh("standard", {"type": "helical"}),
    joint(),
    joint(type="turning"),
    joint(type="revolute", axis="z"),
    joint(type="revolute", pitch=1),
    joint(type="helical"),
    joint(type="prismatic", point=[0, 0, 0]),
    joint(type="revolute", screw=[0, 0, 0, 0, 0, 1], axis=[0, 0, 1]),
    joint(type="revolute", limits={"min": 1}),
    joint(type="revolute", limits={"velocity": 0}),
    joint(type="revolute", mimic={"multiplier": 2}),
    joint(type="spherical", limits={}),
    joint(type="revolute", link=""),
]


@pytest.mark.parametrize("arm", GOOD + BAD, ids=json.dumps)
def test_schema_and_reader_agree(arm, validator, build, tmp_path):
    path = tmp_path / "arm.json"
    path.write_text(json.dumps(arm))
    answer = beeline(build, "show", path)
    assert (answer.returncode == 0) == (arm in GOOD), answer.stderr
    assert validator.is_valid(arm) == (arm in GOOD)


def test_written_arms_fit_the_schema(validator, build, tmp_path):
    path = tmp_path / "arm.json"
    names = [arm["name"] for arm in json.loads(beeline(build, "arms", "--json").stdout)["arms"]]
    assert len(names) >= 10
    for name in [*names, "RSR:1,2,3", "H:1@30p0.1", "CUEP"]:
        answer = beeline(build, "show", name, "--out", path)
        assert answer.returncode == 0, answer.stderr
        validator.validate(json.loads(path.read_text()))
