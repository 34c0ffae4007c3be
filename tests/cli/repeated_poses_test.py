"""A pose of a file may repeat the one before it, for every --path."""

import pytest

POSES = ["0.5,-0.2,0.5,180,0,0", "0.5,0,0.45,180,0,10", "0.5,0,0.45,180,0,10", "0.45,0.2,0.5,180,0,20"]


@pytest.fixture
def poses(written):
    return written("poses.csv", "x,y,z,roll,pitch,yaw\n" + "\n".join(POSES) + "\n")


@pytest.mark.parametrize("kind", ["line", "screw", "spline"])
def test_a_repeated_pose_is_passed(beeline, poses, kind):
    answer = beeline("line", "panda", "--degrees", "--through", poses, "--path", kind, "--out", "motion.csv", "--json")
    assert answer.code == 0, answer.err
    checked = beeline("check", "panda", "motion.csv", "--degrees", "--through", poses, "--path", kind)
    assert checked.code == 0, checked.out


def test_names_of_a_spline_have_the_numbers_of_the_file(beeline, written):
    away = written("away.csv", "x,y,z,roll,pitch,yaw\n" + "\n".join(POSES) + "\n3,0,0.5,180,0,0\n")
    answer = beeline("line", "panda", "--degrees", "--through", away, "--path", "spline", "--json")
    assert answer.code == 1
    assert answer.json["fields"]["segment_name"] == "segment 3 of 3 (waypoint 4 to 5)"
