"""docs/scene.schema.json, and the shapes of docs/arm.schema.json, say what the readers take."""

import json
import subprocess

import jsonschema
import pytest

BALL = {"sphere": {"radius": 0.1}}
POSE = {"xyz": [1, 2, 3], "rpy": [0.1, 0.2, 0.3]}

GOOD_SHAPES = [
    BALL,
    {"sphere": {"radius": 0}, "padding": 0.1, "pose": POSE},
    {"capsule": {"radius": 0.1, "length": 0}},
    {"box": {"size": [1, 2, 0]}},
    {"cylinder": {"radius": 0.1, "length": 1}},
    {"convex_hull": {"vertices": [[0, 0, 0], [1, 0, 0]]}},
    {"convex_hull": {"vertices": [[0, 0, 0], [1, 0, 0]]}, "hull_of": "a.stl", "padding": 0.1},
]
BAD_SHAPES = [
    {},
    [],
    {"sphere": {"radius": -1}},
    {"sphere": {"radius": 2e6}},
    {"sphere": {"radius": "1"}},
    {"sphere": {}},
    {"sphere": {"radius": 1, "length": 1}},
    {**BALL, "box": {"size": [1, 1, 1]}},
    {**BALL, "padding": -1},
    {**BALL, "colour": "red"},
    {**BALL, "pose": [0, 0, 0]},
    {"capsule": {"radius": 0.1}},
    {"box": {"size": [1, 2]}},
    {"box": {"size": [1, 2, -1]}},
    {"cylinder": {"length": 1}},
    {"convex_hull": {"vertices": []}},
    {"convex_hull": {"vertices": [[0, 0]]}},
    {"mesh": {"file": "a.stl"}},
    {**BALL, "hull_of": "a.stl"},
    {"convex_hull": {"vertices": [[0, 0, 0]]}, "hull_of": ""},
    {"convex_hull": {"vertices": [[0, 0, 0]]}, "hull_of": 1},
]
GOOD_CLOUDS = [
    {"radius": 0.1, "points": [[0, 0, 0], [1, 0, 0]]},
    {"radius": 0, "points": [[0, 0, 0]], "pose": POSE},
]
BAD_CLOUDS = [
    [],
    {"radius": 0.1},
    {"points": [[0, 0, 0]]},
    {"radius": -1, "points": [[0, 0, 0]]},
    {"radius": 0.1, "points": []},
    {"radius": 0.1, "points": [[0, 0]]},
    {"radius": 0.1, "points": [[0, 0, 2e6]]},
    {"radius": 0.1, "points": [[0, 0, 0]], "file": "a.ply"},
    {"radius": 0.1, "points": [[0, 0, 0]], "colour": "red"},
    {"radius": 0.1, "file": ""},
]
GOOD_SCENES = [
    {"obstacles": []},
    {"obstacles": [{"name": "a", "shapes": [BALL]}], "allowed_pairs": [["a", "joint1"]]},
    {"obstacles": [{"name": "a", "shapes": [{"half_space": {}}], "clearance": 0.1}]},
    *({"obstacles": [{"name": "a", "shapes": [shape]}]} for shape in GOOD_SHAPES),
    *({"obstacles": [{"name": "a", "point_cloud": cloud}]} for cloud in GOOD_CLOUDS),
    {"obstacles": [{"name": "a", "point_cloud": GOOD_CLOUDS[0], "shapes": [BALL]}]},
    {"obstacles": [{"name": "a", "point_cloud": GOOD_CLOUDS[0], "shapes": []}]},
]
BAD_SCENES = [
    [],
    {},
    {"obstacles": {}},
    {"obstacles": [{"name": "a"}]},
    {"obstacles": [{"name": "a", "shapes": []}]},
    {"obstacles": [{"shapes": [BALL]}]},
    {"obstacles": [{"name": "", "shapes": [BALL]}]},
    {"obstacles": [{"name": "a", "shapes": [BALL], "clearance": 0}]},
    {"obstacles": [{"name": "a", "shapes": [BALL], "clearance": 2e6}]},
    {"obstacles": [{"name": "a", "shapes": [BALL], "colour": "red"}]},
    {"obstacles": [], "allowed_pairs": [["a"]]},
    {"obstacles": [], "walls": []},
    *({"obstacles": [{"name": "a", "shapes": [shape]}]} for shape in BAD_SHAPES),
    *({"obstacles": [{"name": "a", "point_cloud": cloud}]} for cloud in BAD_CLOUDS),
]


def arm(*bodies):
    return {"name": "a", "joint_string": "RR", "shapes": [{"shapes": [BALL]}, *bodies]}


GOOD_ARMS = [
    arm(),
    arm({"joint": "joint1", "shapes": []}, {"joint": "joint1", "name": "b", "attached": True, "shapes": [BALL]}),
    *(arm({"joint": "joint2", "shapes": [shape]}) for shape in GOOD_SHAPES),
]
BAD_ARMS = [
    {"name": "a", "joint_string": "RR", "shapes": {}},
    arm({"joint": "joint2"}),
    arm({"joint": 2, "shapes": []}),
    arm({"joint": "joint2", "name": "", "shapes": []}),
    arm({"joint": "joint2", "attached": 1, "shapes": []}),
    arm({"link": "joint2", "shapes": []}),
    *(arm({"joint": "joint2", "shapes": [shape]}) for shape in BAD_SHAPES),
]


@pytest.fixture(scope="module")
def validators(root):
    """The definitions that scene.schema.json takes from arm.schema.json are put into it."""
    arm_schema = json.loads((root / "docs" / "arm.schema.json").read_text())
    text = (root / "docs" / "scene.schema.json").read_text().replace('"arm.schema.json#/', '"#/')
    schemas = {"arm": arm_schema, "scene": {**json.loads(text), "$defs": arm_schema["$defs"]}}
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
    return {name: jsonschema.Draft202012Validator(schema) for name, schema in schemas.items()}


@pytest.fixture
def accepted(build, tmp_path):
    """Whether `check` reads an arm and a scene, whatever it answers."""

    def check(arm, scene):
        for name, value in (("arm.json", arm), ("scene.json", scene)):
            (tmp_path / name).write_text(json.dumps(value))
        (tmp_path / "still.csv").write_text("t,joint1,joint2\n0,0,0\n1,0,0\n")
        answer = subprocess.run([build / "beeline", "check", "arm.json", "still.csv", "--scene", "scene.json"],
                                capture_output=True, text=True, cwd=tmp_path)
        assert answer.returncode in (0, 1, 3), answer.stderr
        return answer.returncode != 3

    return check


@pytest.mark.parametrize("scene", GOOD_SCENES + BAD_SCENES, ids=json.dumps)
def test_schema_and_reader_of_scenes_agree(scene, validators, accepted):
    good = scene in GOOD_SCENES
    two = arm({"joint": "joint1", "shapes": [BALL]}, {"joint": "joint2", "shapes": [BALL]})
    assert accepted(two, scene) == good
    assert validators["scene"].is_valid(scene) == good


@pytest.mark.parametrize("described", GOOD_ARMS + BAD_ARMS, ids=json.dumps)
def test_schema_and_reader_of_shapes_agree(described, validators, accepted):
    good = described in GOOD_ARMS
    assert accepted(described, {"obstacles": []}) == good
    assert validators["arm"].is_valid(described) == good
