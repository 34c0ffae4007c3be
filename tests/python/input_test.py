"""Input whose meaning is not clear: three numbers, other units, planar arms, names of other programs."""

import re
import warnings

import numpy as np
import pytest

import beeline

PANDA, RRR = beeline.arms.panda(), beeline.arms.rrr()
TURNING = beeline.Arm.load("RRR:0.4,0.3,0.2")


def test_three_numbers_are_the_position_of_a_frame():
    for name in ("with_tool", "with_tcp", "with_mount"):
        for position in ([0, 0, 0.1034], (0.1, 0.2, 0.3), np.array([0.5, 0, 0])):
            placed, expected = (getattr(PANDA, name)(pose) for pose in (position, beeline.make_pose(list(position))))
            assert placed == expected
    assert TURNING.with_tcp([0.1, 0, 0.5]) == TURNING.with_tcp(beeline.Pose2(x=0.1, y=0, theta=0.5))


def test_three_numbers_need_their_meaning(tmp_path):
    (tmp_path / "p.csv").write_text("0,0,0.1034\n")
    cure = '3 numbers, x,y,theta or x,y,z; give triple="planar" or triple="position"'
    for call in (lambda **meaning: beeline.pose_of([0, 0, 0.1034], **meaning),
                 lambda **meaning: beeline.parse_pose("0,0,0.1034", **meaning),
                 lambda **meaning: beeline.read_poses(tmp_path / "p.csv", **meaning).poses[0]):
        with pytest.raises(beeline.Error) as error:
            call()
        assert str(error.value).endswith(cure)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", beeline.InputWarning)  # the file has no header
            assert call(triple="position")[2, 3] == 0.1034 and call(triple="planar")[2, 3] == 0
    with pytest.raises(beeline.Error, match=r"make_pose\(\[x, y, z\]\) makes of a position"):
        beeline.inverse_kinematics(PANDA, [0.5, 0, 0.5])


def test_arguments_of_xacro(tmp_path, monkeypatch):
    program = tmp_path / "xacrodoc"
    shape = "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
    program.write_text(f"#!/bin/sh\n/bin/cat <<END\n<robot name='$2 $3'><link name='a'/><link name='b'>{shape}</link>"
                       "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>\nEND\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    path = tmp_path / "r.xacro"
    path.write_text("<robot name='$(arg len)'/>")
    for read in (beeline.Arm.load, beeline.Arm.from_urdf):
        assert read(path, xacro={"len": 0.5, "sim": True}).name == "len:=0.5 sim:=True"
    assert len(beeline.read_arm_shapes(path, xacro={"len": 1}).links) == 1
    assert len(beeline.read_scene(path, xacro={"len": 1}).obstacles) == 1
    with pytest.raises(beeline.Error, match='"a b" is no name of an argument of xacro'):
        beeline.Arm.load(path, xacro={"a b": 1})
    with pytest.raises(TypeError, match="xacro"):
        beeline.Arm.load(path, xacro=["len:=0.5"])


def test_a_planar_arm_refuses_height_and_tilt():
    q = TURNING.middle
    pose = beeline.forward_kinematics(TURNING, q)
    tilted = pose @ beeline.pose_of([0, 0, 0, 1, 0, 0])
    lifted = pose.copy()
    lifted[2, 3] -= 0.1
    for outside in (lifted, tilted):
        for call in (lambda **task: beeline.inverse_kinematics(TURNING, outside, **task),
                     lambda **task: beeline.inverse_kinematics(TURNING, outside, out=np.empty(TURNING.dof), **task),
                     lambda **task: beeline.batch_inverse(TURNING, [pose, outside], **task),
                     lambda **task: beeline.move_in_lines(TURNING, q, [outside], **task),
                     lambda **task: beeline.verify(TURNING, beeline.at_rest(TURNING, q), [outside], **task)):
            with pytest.raises(beeline.Error, match="outside the plane z = 0 m of arm .*give x,y,theta, or task planar"):
                call()
            call(task="planar")


def test_a_refused_motion_proves_nothing(tmp_path):
    motion = beeline.move_in_lines(RRR, [0, np.pi / 2, 0], [[20, 0, 0]])
    assert not motion and not motion.deviation.bound.position < 1e-4
    assert motion.deviation.bound == beeline.Deviation(np.inf, np.inf)
    with pytest.raises(beeline.Error, match="the trajectory is empty, as after a motion that was refused: see its status"):
        motion.trajectory.save(tmp_path / "m.csv")


def test_names_of_other_programs_lead_to_a_function():
    for name, call in [("fk", "; in Python it is beeline.forward_kinematics"), ("ik", "; in Python it is beeline.inverse_kinematics"),
                       ("forward_kinematic", "; did you mean beeline.forward_kinematics?"), ("show", "; in Python it is print(arm)"),
                       ("qqqq", "")]:
        with pytest.raises(AttributeError) as error:
            getattr(beeline, name)
        assert str(error.value) == f"module 'beeline' has no attribute '{name}'{call}"
    for known in beeline._OTHER_NAMES.values():
        if known.startswith("beeline."):
            eval(re.split(r"[(,;]", known)[0])


def test_an_arm_of_a_name_is_loaded():
    with pytest.raises(TypeError, match=r"Arm\.load\('panda'\) reads a built-in arm"):
        beeline.Arm("panda")
    with pytest.raises(TypeError, match=r'Arm\.load\("panda"\)'):
        beeline.Arm(7)


def test_limits_may_be_dicts():
    name = PANDA.joint_names[0]
    expected = PANDA.with_limits({name: beeline.LimitOverrides(lower=-1, upper=1)})
    assert PANDA.with_limits({name: {"lower": -1, "upper": 1}}) == expected != PANDA
    with pytest.raises(TypeError, match='unknown option "low".*lower'):
        PANDA.with_limits({name: {"low": 1}})


def test_a_scene_takes_obstacles_by_position():
    box = beeline.Obstacle("box", [beeline.Shape(beeline.Box([0.1, 0.1, 0.1]))])
    assert beeline.Scene([box]) == beeline.Scene(obstacles=[box])
    assert beeline.Scene([box], [("box", "link1")]).allowed_pairs == [("box", "link1")]


def test_planar_poses_of_many():
    rows = np.random.default_rng(1).uniform(-1, 1, (5, 3))
    poses = beeline.forward_kinematics(RRR, rows)
    assert beeline.to_plane(poses) == [beeline.to_plane(pose) for pose in poses]


def test_proofs_are_printed_in_one_line():
    wall = beeline.Obstacle("wall", [beeline.Shape(beeline.Box([0.1, 1, 1]), pose=beeline.make_pose([2, 0, 0]))])
    link = beeline.LinkShapes("tip", 3, [beeline.Shape(beeline.Sphere(0.05))])
    motion = beeline.move_joints(TURNING, [0.1, 0.2, 0.3], [0.4, 0.2, 0.3])
    for gap, text in ((2, "clear, the pair that counts keeps at least "), (0.68, "collides: ")):
        shape = beeline.Shape(beeline.Box([0.1, 2, 2]), pose=beeline.make_pose([gap, 0, 0]))
        model = beeline.CollisionModel(TURNING, [link], beeline.Scene([beeline.Obstacle("wall", [shape])]))
        proof = beeline.prove_clearance(model, motion.trajectory)
        assert str(proof).startswith(text) and "\n" not in str(proof)
        assert bool(proof) == (proof.least_distance > -np.inf)
    far = beeline.Obstacle("far", [beeline.Shape(beeline.Box([100, 100, 100]), pose=beeline.make_pose([500, 0, 0]))])
    with pytest.warns(beeline.InputWarning, match="probably in millimetres: far$"):
        beeline.CollisionModel(TURNING, [link], beeline.Scene([wall, far]))


def test_assumed_limits_are_printed():
    motion = beeline.move_in_lines(TURNING, [0.1, 0.5, 0.3], [beeline.forward_kinematics(TURNING, [0.2, 0.6, 0.3])])
    assert str(motion).endswith(" assumed") and ", limits of " in str(motion)


def test_units_that_numbers_suggest(tmp_path):
    (tmp_path / "p.csv").write_text("x,y,z,roll,pitch,yaw\n0.4,0,0.3,180,0,0\n")
    (tmp_path / "bare.csv").write_text("0.4,0,0.3,1,0,0,0\n")
    revolution = 'an angle of 180 rad is more than a revolution; angle_unit="degrees" reads degrees$'
    for call in (lambda **unit: beeline.read_poses(tmp_path / "p.csv", **unit),
                 lambda **unit: beeline.parse_pose("0.4,0,0.3,180,0,0", **unit),
                 lambda **unit: beeline.pose_of([0.4, 0, 0.3, 180, 0, 0], **unit)):
        with pytest.warns(beeline.InputWarning, match=revolution) as issued:
            call()
        assert issued[0].filename == __file__
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            call(angle_unit="degrees")
    with pytest.warns(beeline.InputWarning, match="bare.csv has no header; its columns are read as x, y, z, qw, qx, qy, qz$"):
        beeline.read_poses(tmp_path / "bare.csv")
    with pytest.warns(beeline.InputWarning, match="an angle of 90 rad"):
        beeline.Arm.from_dh([[0.4, 90, 0, 0]], convention="standard")
    far = beeline.inverse_kinematics(PANDA, beeline.pose_of([500, 0, 500, 3.1, 0, 0]))
    assert far.reason.fields["in_millimetres"] and far.reason.endswith("probably in millimetres")
    (outside,) = PANDA.limit_violations([90, 0, 0, -2, 0, 1, 0])
    assert outside.fields["in_degrees"] and outside.endswith("probably in degrees")
