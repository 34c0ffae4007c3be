"""Forms of poses, poses of planar arms as x, y, theta, and joint rates."""

import beeline
import numpy as np
import pytest

RRR = beeline.arms.rrr()
PANDA = beeline.arms.panda()
BENT = np.array([0.3, 0.9, -0.7])
PLANE = (4.0, 3.0, 0.5)


@pytest.mark.parametrize("form", ["rpy", "rotvec", "abc", "quaternion", "matrix"])
def test_numbers_of_a_pose_read_back(form, rng, tmp_path):
    for unit in ("radians", "degrees"):
        for millimetres in (False, True):
            with_units = {"angle_unit": unit, "millimetres": millimetres}
            pose = beeline.make_pose(rng.uniform(-1, 1, 3), rotation_vector=rng.uniform(-1.5, 1.5, 3))
            numbers = beeline.pose_numbers(pose, pose_form=form, **with_units)
            assert beeline.pose_of(numbers, pose_form=form, **with_units) == pytest.approx(pose, abs=1e-14)
            text = ",".join(map(repr, map(float, numbers)))
            typed = beeline.parse_pose(text, pose_form=form, **with_units)
            assert typed == pytest.approx(pose, abs=1e-14)
            names = {"rpy": "x,y,z,roll,pitch,yaw", "rotvec": "x,y,z,rx,ry,rz", "abc": "x,y,z,A,B,C",
                     "quaternion": "x,y,z,qw,qx,qy,qz",
                     "matrix": ",".join(f"m{i}{j}" for i in range(1, 5) for j in range(1, 5))}
            (tmp_path / "p.csv").write_text(f"{names[form]}\n{text}\n")
            read = beeline.read_poses(tmp_path / "p.csv", **with_units)
            assert read.form == form and read.poses[0] == pytest.approx(pose, abs=1e-14)


def test_the_unit_of_angles_has_one_name(tmp_path):
    (tmp_path / "p.csv").write_text("x,y,theta\n1,2,90\n")
    (tmp_path / "m.csv").write_text("motion,x,y,theta\nline,4,3,30\n")
    for call in (lambda **unit: beeline.pose_of([1, 2, 90], triple="planar", **unit),
                 lambda **unit: beeline.parse_pose("1,2,90", triple="planar", **unit),
                 lambda **unit: beeline.read_poses(tmp_path / "p.csv", **unit).poses[0],
                 lambda **unit: beeline.Program.load(tmp_path / "m.csv", RRR, **unit)):
        call(angle_unit="degrees")
        with pytest.raises(TypeError, match="^the keyword unit is called angle_unit$"):
            call(unit="degrees")
    assert beeline.pose_of([1, 2, 90], "degrees", "planar")[:2, :2] == pytest.approx(np.array([[0, -1], [1, 0]]), abs=1e-15)


def test_numbers_of_other_forms_are_refused():
    with pytest.raises(beeline.Error, match="pose_form matrix has m11"):
        beeline.pose_of([0, 0, 0, 0, 0, 0], pose_form="matrix")
    with pytest.raises(beeline.Error, match="the determinant is -1"):
        beeline.pose_of(np.ravel(np.diag([1.0, 1, -1, 1])))
    with pytest.raises(beeline.Error, match="pose_form"):
        beeline.pose_of([0, 0, 0, 0, 0, 0], pose_form="euler")
    with pytest.raises(beeline.Error, match="not finite"):
        beeline.pose_of([0, 0, np.inf, 0, 0, 0])


@pytest.mark.parametrize("convert", [list, tuple, np.array])
def test_planar_arms_take_planar_poses(convert):
    same(convert(PLANE))


def test_planar_arms_take_pose2():
    same(beeline.Pose2(x=4.0, y=3.0, theta=0.5))


def same(pose):
    """Asserts that functions of a planar arm answer as they do to the 4 x 4 matrix."""
    matrix = beeline.to_space(beeline.Pose2(x=4.0, y=3.0, theta=0.5))
    q = beeline.inverse_kinematics(RRR, matrix).q
    assert q is not None
    assert np.array_equal(beeline.inverse_kinematics(RRR, pose).q, q)
    assert np.array_equal(beeline.batch_inverse(RRR, [pose, pose]).q, [q, q])
    into = np.empty(3)
    assert beeline.inverse_kinematics(RRR, pose, seed=q, out=into) == 1 and into == pytest.approx(q, abs=1e-9)
    motion = beeline.move_in_lines(RRR, BENT, [pose])
    assert motion.status == "reached"
    assert beeline.forward_kinematics(RRR, motion.trajectory.positions[-1]) == pytest.approx(matrix, abs=1e-8)
    assert beeline.verify(RRR, motion.trajectory, [pose])
    assert beeline.Tracker(RRR, BENT).step(pose).status == beeline.Tracker(RRR, BENT).step(matrix).status
    assert np.array_equal(beeline.Servo(RRR).step_towards(BENT, pose).velocity,
                          beeline.Servo(RRR).step_towards(BENT, matrix).velocity)
    assert beeline.motion_figure(RRR, motion.trajectory, [pose])
    assert beeline.control_in_lines(RRR, BENT, [pose]).status == "reached"


def test_many_planar_poses_are_rows(rng):
    poses = np.column_stack([rng.uniform(-4, 4, (20, 2)), rng.uniform(-3, 3, 20)])
    matrices = np.array([beeline.to_space(beeline.Pose2(x=x, y=y, theta=t)) for x, y, t in poses])
    assert np.array_equal(beeline.batch_inverse(RRR, poses).q, beeline.batch_inverse(RRR, matrices).q, equal_nan=True)
    assert beeline.batch_inverse(RRR, poses.reshape(4, 5, 3)).q.shape == (4, 5, 3)
    spoilt = poses.copy()
    spoilt[3, 2] = np.nan
    assert np.isnan(beeline.batch_inverse(RRR, spoilt).q[3]).all()


def test_they_lie_in_the_plane_of_the_arm():
    raised = RRR.with_mount(beeline.make_pose([0, 0, 0.4]))
    found = beeline.inverse_kinematics(raised, PLANE)
    assert beeline.forward_kinematics(raised, found.q)[2, 3] == pytest.approx(0.4)
    moved = RRR.with_mount([1.0, 2.0, 0.0])
    assert moved.base[:3, 3] == pytest.approx([1, 2, 0])
    assert RRR.with_tcp(beeline.Pose2(x=0.5, y=0, theta=0)).tool[0, 3] == pytest.approx(RRR.tool[0, 3] + 0.5)


def test_spatial_arms_refuse_them():
    with pytest.raises(beeline.Error, match=r"world_T_tool has the shape \(3,\); expected a pose \(4, 4\)"):
        beeline.inverse_kinematics(PANDA, PLANE)
    with pytest.raises(beeline.Error, match="a Pose2 is for planar arms; a pose of panda is spatial"):
        beeline.inverse_kinematics(PANDA, beeline.Pose2(x=1, y=2, theta=3))
    with pytest.raises(beeline.Error, match="expected"):
        beeline.batch_inverse(PANDA, np.zeros((5, 3)))
    with pytest.raises(beeline.Error, match="shape"):
        beeline.inverse_kinematics(RRR, [1.0, 2.0])
    with pytest.raises(beeline.Error, match="finite"):
        beeline.inverse_kinematics(RRR, [1.0, np.nan, 0.0])


def test_a_planar_arm_has_planar_rows_by_default():
    assert beeline.manipulability(RRR, [0, 1.57, 0]) == pytest.approx(3.5 * 3.5 * np.sin(1.57))
    assert beeline.manipulability_gradient(RRR, BENT).manipulability == pytest.approx(beeline.manipulability(RRR, BENT))
    assert np.array_equal(beeline.task_jacobian(RRR, BENT), beeline.planar_jacobian(RRR, BENT))
    many = beeline.manipulability(RRR, np.tile(BENT, (50, 1)).astype(np.float32))
    assert many == pytest.approx(beeline.manipulability(RRR, BENT), rel=1e-5)
    assert np.array_equal(beeline.task_jacobian(PANDA, PANDA.middle), beeline.jacobian(PANDA, PANDA.middle))
    free = beeline.inverse_kinematics(RRR, PLANE, task="110")
    assert beeline.forward_kinematics(RRR, free.q)[:2, 3] == pytest.approx(PLANE[:2])


def test_joint_rates_give_the_velocity(rng):
    for frame in ("base", "tool", "space"):
        q, twist = rng.uniform(-0.5, 0.5, 7) + PANDA.middle, rng.uniform(-0.1, 0.1, 6)
        found = beeline.joint_rates(PANDA, q, twist, frame=frame)
        assert found and found.status == "solved" and found.residual < 1e-12
        matrix = beeline.jacobian(PANDA, q, frame)
        assert found.rates == pytest.approx(np.linalg.pinv(matrix) @ twist, abs=1e-10)
        damped = beeline.joint_rates(PANDA, q, twist, frame=frame, damping=0.3)
        expected = matrix.T @ np.linalg.solve(matrix @ matrix.T + 0.09 * np.eye(6), twist)
        assert damped.status == "damped" and damped.rates == pytest.approx(expected, abs=1e-12)
    planar = beeline.joint_rates(RRR, BENT, [0.1, 0.2, 0.3])
    assert beeline.planar_jacobian(RRR, BENT) @ planar.rates == pytest.approx([0.1, 0.2, 0.3])
    assert beeline.joint_rates(RRR, BENT, [0.1, 0.2], task="110").tool_velocity == pytest.approx([0.1, 0.2])


def test_joint_rates_name_what_is_lost_and_what_is_exceeded():
    lost = beeline.joint_rates(RRR, [0, 0, 0], [0.1, 0, 0])
    assert not lost and lost.status == "singular" and lost.singular and "along x 1" in lost.reason
    assert np.abs(lost.lost_directions) == pytest.approx(np.array([[1], [0], [0]]), abs=1e-12)
    fast = beeline.joint_rates(PANDA, PANDA.middle, [5, 0, 0, 0, 0, 0])
    assert fast.excesses and fast.scale < 1
    for excess in fast.excesses:
        assert abs(fast.rates[excess.coordinate]) > excess.limit
    with pytest.raises(beeline.Error, match="it needs 3: x, y, theta"):
        beeline.joint_rates(RRR, BENT, np.zeros(6))
    with pytest.raises(beeline.Error, match="damping is -1"):
        beeline.joint_rates(RRR, BENT, np.zeros(3), damping=-1)


def test_rates_without_a_known_limit_are_named():
    puma = beeline.arms.puma560()
    unknown = [k for k, limit in enumerate(puma.velocity) if np.isinf(limit)]
    assert beeline.joint_rates(puma, [0.3, -1, 1, 0.4, 0.5, 0.2], np.ones(6)).without_limit == unknown != []
    assert beeline.joint_rates(PANDA, PANDA.middle, np.ones(6)).without_limit == []
    tool = beeline.joint_rates(PANDA, PANDA.middle, [0, 0, 0.1], task="position:tool")
    assert np.array_equal(tool.rates, beeline.joint_rates(PANDA, PANDA.middle, [0, 0, 0.1], task="position:tool", frame="tool").rates)
    with pytest.raises(beeline.Error, match="the frame must be tool, not base"):
        beeline.joint_rates(PANDA, PANDA.middle, [0, 0, 0.1], task="position:tool", frame="base")
