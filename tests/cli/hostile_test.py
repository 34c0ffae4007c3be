"""Hostile input: the ranges of numbers and the length of messages. Random invocations: tests/hostile/."""

import json
import subprocess

import pytest


def arm(joint):
    return json.dumps({"name": "a", "joints": [{"name": "j", "type": "revolute", **joint}]})


@pytest.mark.parametrize("joint, says", [
    ({"origin": {"xyz": [1e7, 0, 0]}}, ["joint 1 (j): the offset", "1e+07 m", "-1e+06 to 1e+06 m"]),
    ({"limits": {"lower": 0, "upper": 1e12}}, ["1e+12", "-1e+06 to 1e+06 rad or m"]),
    ({"limits": {"velocity": 1e300}}, ["velocity limit 1e+300", "above 1e+10"])])
def test_numbers_of_an_arm_without_physical_sense(refused, written, joint, says):
    refused(3, "show", written("a.json", arm(joint)), says=["a.json", *says])


def test_limits_of_gazebo_are_none(beeline, written):
    urdf = written("u.urdf", '<robot name="u"><link name="a"/><link name="b"/><joint name="j" type="revolute">'
                             '<parent link="a"/><child link="b"/><axis xyz="0 0 1"/>'
                             '<limit lower="-1e+16" upper="1e+16" velocity="1"/></joint></robot>')
    limits = json.loads(beeline("show", urdf, "--json").out)["joints"][0]["limits"]
    assert limits.get("lower") is None and limits.get("upper") is None


def test_frames_joints_poses_times_and_steps_have_ranges(refused, written):
    refused(2, "fk", "rrr", "--q", "0,0,0", "--mount", "1e7,0,0", says=["the base has the length 1e+07 m"])
    refused(2, "fk", "rrr", "--q", "0,0,0", "--tcp", "1e7,0,0", says=["the tool has the length 1e+07 m"])
    refused(2, "show", "R" * 101, says=["101 letters", "at most 100"])
    poses = written("p.csv", "x,y,theta\n" + "4,3,0\n4,4,0\n" * 10001)
    refused(3, "line", "rrr", "--through", poses, says=["p.csv:20002", "20002 poses", "at most 20000"])
    late = written("t.csv", "t,joint1,joint2,joint3\n0,0,0,0\n1e308,1,1,1\n")
    refused(3, "retime", "rrr", late, says=["t.csv", "time 1e+308 s", "-1e+10 to 1e+10 s"])
    refused(2, "move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "0.1,0.2", "--max-steps", "10000000",
            says=["--max-steps of 2 gains must be at most 5000000"])


@pytest.mark.parametrize("path", [b"\xff\xfe.json", b"a" * 5000, b"\x1b[31m.json"])
def test_messages_are_short_and_utf8(build, tmp_path, path):
    done = subprocess.run([build / "beeline", "show", path], capture_output=True, cwd=tmp_path)
    assert done.returncode in (2, 3)
    assert len(done.stderr) < 1000
    assert done.stderr.decode().isprintable() or done.stderr.decode().strip().isprintable()
