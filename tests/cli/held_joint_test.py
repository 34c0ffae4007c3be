"""A refusal because of a body that a held joint carries names the joint and the option, wherever it is found."""

import json

import pytest
from scene_test import URDF, ball, scene

ENDS = ("--tip", "hand")
CURE = "; finger is carried by joint grip, held at 0.4; the option hold sets another value, grip=VALUE"
HELD = {"held_body": "finger", "held_joint": "grip", "held_value": 0.4}


@pytest.fixture
def refused(beeline, written):
    """Runs a command that is refused with a closed finger, at 0.4, and not with it at 0."""
    arm = written("arm.urdf", URDF)
    written("post.json", scene(ball("post", (1.3, 0.4, 0), 0.05)))
    written("still.csv", "t,j1,j2\n0,0,0\n1,0,0\n")

    def run(verb, *options):
        command = (verb, arm, *options, *ENDS, "--scene", "post.json", "--hold")
        cured = beeline(*command, "grip=0")
        assert cured.code == 0 and "option hold" not in cured.err + cured.out, cured.err
        answer = beeline(*command, "grip=0.4")
        assert answer.code == 1, answer.out
        return answer.err, beeline(*command, "grip=0.4", "--json").json

    return run


def fields_in(report):
    """The fields of each reason in a report."""
    if isinstance(report, dict):
        found = [report["fields"]] if "fields" in report else []
        return found + [fields for value in report.values() for fields in fields_in(value)]
    return [fields for value in report for fields in fields_in(value)] if isinstance(report, list) else []


@pytest.mark.parametrize("command", [
    ("check", "still.csv", "--moving-start", "--moving-end"),
    ("move", "--from", "0,0", "--to", "0.05,0"),
    ("move", "--from", "0,0", "--to", "0.05,0", "--method", "around"),
    ("ik", "--pose", "1,0,0,0,0,0"),
])
def test_the_reason_names_the_joint(refused, command):
    said, report = refused(*command)
    assert CURE in said, said
    assert any(HELD.items() <= fields.items() for fields in fields_in(report)), json.dumps(report)


def test_the_option_to_exempt_the_pair_comes_after_it(refused):
    said, _ = refused("check", "still.csv", "--moving-start", "--moving-end")
    assert said.index(CURE) < said.index("; if this contact is meant, exempt it by --allow finger,post")
