"""show --as screws: the products of exponentials of the space screws and of the body screws are the tool's pose."""

import json

import numpy as np
import pytest

MIMIC = """<mujoco model="m"><worldbody><body name="a" pos="0 0 1"><joint name="a" pos="0.1 0 0"/><body name="b" pos="0 0.3 0">
<joint name="b" axis="1 0 1" ref="20"/><body name="c" pos="0.2 0 0" euler="10 20 30"><joint name="c" type="slide"/></body></body></body>
</worldbody><equality><joint joint1="b" joint2="a" polycoef="0.2 -2"/></equality></mujoco>"""


def exponential(screw, q):
    """exp([S] q) of a unit screw [v w], by the series of the matrix, which converges quickly for a small part of it."""
    (x, y, z), v = screw[3:], screw[:3]
    step = np.zeros((4, 4))
    step[:3, :3], step[:3, 3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]], v
    step, term, total = step * q / 64, np.eye(4), np.eye(4)
    for k in range(1, 20):
        term = term @ step / k
        total = total + term
    return np.linalg.matrix_power(total, 64)


def values(document, q):
    """The value of each joint: those that follow another one have theirs."""
    found, free = {}, iter(q)
    for joint in document["joints"]:
        mimic = joint.get("mimic")
        found[joint["name"]] = mimic["multiplier"] * found[mimic["joint"]] + mimic["offset"] if mimic else next(free)
    return found


@pytest.mark.parametrize("arm", ["ur5e", "panda", "scara", "RRPRH:1,1,0.1,1,0.1p0.02", "m.xml"])
def test_products_of_exponentials_are_the_pose(beeline, written, arm):
    written("m.xml", MIMIC)
    document = beeline("show", arm, "--as", "screws", "--json").json
    screws = document["screws"]
    assert screws["rows"] == ["vx", "vy", "vz", "wx", "wy", "wz"]
    home = np.array(screws["home"])
    q = np.linspace(-0.9, 1.1, document["dof"])
    pose = beeline("fk", arm, "--q", ",".join(map(str, q)), "--json").json["pose"]["matrix"]
    at = values(document, q)
    space, body = np.eye(4), home
    for joint in screws["joints"]:
        space = space @ exponential(np.array(joint["space"]), at[joint["name"]])
        body = body @ exponential(np.array(joint["body"]), at[joint["name"]])
    np.testing.assert_allclose(space @ home, pose, rtol=0, atol=1e-12)
    np.testing.assert_allclose(body, pose, rtol=0, atol=1e-12)


def test_the_table_has_a_row_for_each_joint(beeline):
    text = beeline("show", "ur5e", "--as", "screws").out
    assert text.count("\n  joint2 ") == 2 and "home pose M" in text
    assert "screws" not in beeline("show", "ur5e").out
    assert "screws" not in json.loads(beeline("show", "ur5e", "--json").out)
