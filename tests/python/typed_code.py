"""Code that uses much of the module, as a type checker sees it (typing_test.py) and as it runs."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy
from numpy.typing import NDArray

import beeline

Array = NDArray[numpy.float64]


def arms() -> list[beeline.Arm]:
    rows = [beeline.DhRow(a=0.4), beeline.DhRow(a=0.3)]
    arm = beeline.Arm.from_dh(rows, convention="standard", name="two links")
    limits = {"joint1": beeline.LimitOverrides(velocity=1.5)}
    return [
        beeline.arms.panda(),
        beeline.Arm.load("RRR:3.5,3.5,2"),
        arm.with_limits(limits).with_speed_scale(0.5),
        beeline.Arm.from_json(arm.to_json()),
    ]


def tool_position(arm: beeline.Arm, q: Array) -> Array:
    pose: Array = beeline.forward_kinematics(arm, q)
    return pose[:3, 3]


def jacobians_of_both_dtypes(arm: beeline.Arm) -> None:
    q = numpy.zeros((2, arm.dof), numpy.float32)
    single: NDArray[numpy.float32] = beeline.jacobian(arm, q, out=numpy.empty((2, 6, arm.dof), numpy.float32))
    double: Array = beeline.jacobian(arm, arm.middle, out=numpy.empty((6, arm.dof)))
    assert single.dtype == numpy.float32 and double.dtype == numpy.float64


def solutions_of_both_forms(arm: beeline.Arm) -> None:
    pose: Array = beeline.forward_kinematics(arm, arm.middle)
    result: beeline.InverseResult = beeline.inverse_kinematics(arm, pose, seed=arm.middle)
    count: int = arm.inverse_kinematics(pose, out=numpy.empty(arm.dof))
    assert result and count == 1
    many: beeline.BatchInverseResult = beeline.inverse_kinematics(arm, numpy.stack([pose, pose]), threads=1)
    assert many.solved == 2
    flat = [beeline.Pose2(x=4, y=2, theta=1), beeline.Pose2(x=5, y=1, theta=0.5)]
    of_list: beeline.BatchInverseResult = beeline.inverse_kinematics("rrr", flat)
    assert of_list.q.shape == (2, 3)


def calls_by_name() -> None:
    q: Array = beeline.arms.ur5().random(seed=1)
    pose: Array = beeline.forward_kinematics("ur5", q.tolist())
    motion: beeline.ControlledMotion = beeline.move_joints("ur5", q, numpy.zeros(6))
    same: beeline.ControlledMotion = beeline.arms.ur5().move_joints(q, numpy.zeros(6))
    assert pose.shape == (4, 4) and motion == same and motion.duration > 0


def line_down(arm: beeline.Arm, q: Array, depth: float) -> beeline.Trajectory:
    goal = beeline.forward_kinematics(arm, q)
    goal[2, 3] -= depth
    solved = beeline.inverse_kinematics(arm, goal, seed=q)
    if not solved:
        raise RuntimeError(solved.reason)
    solution: Array | None = solved.q
    assert solution is not None
    motion = beeline.move_in_lines(arm, q, [goal], time_limit=60, progress=lambda fraction: None)
    bound: float = motion.deviation.bound.position
    assert motion.status == "reached" and bound < 1e-4
    return motion.trajectory


def retimed(arm: beeline.Arm, trajectory: beeline.Trajectory) -> beeline.Trajectory:
    slower = beeline.slow_down(trajectory, 0.5)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "slow.csv"
        slower.save(path)
        read = beeline.Trajectory.load(path).matched_to(arm)
    result = beeline.retime(arm, read, profile="jerk")
    duration: float = result.trajectory.duration
    assert duration < 1.001 * read.duration
    return result.trajectory


def reach(arm: beeline.Arm) -> beeline.Placement | None:
    map = beeline.reach_map(arm, resolution=0.6, directions=1.5, progress=False)
    branches: NDArray[numpy.uint8] = map.branches
    margin: NDArray[numpy.float32] = map.positions().margin
    assert branches.shape == map.grid.shape and margin.shape == map.grid.shape[:3]
    cell: int | None = map.grid.cell_of(numpy.eye(4))
    assert cell is not None
    drawing: beeline.Picture = beeline.reach_figure(beeline.slice_of(map, "z", 0, "margin"))
    assert drawing.width > 0
    side: beeline.ReachSide = beeline.compare_reach(map, map).sides[1]
    assert side.volume_only_here == 0 and side.volume > 0
    first, second = beeline.slices_of(map, map, "y", 0)
    both: beeline.Picture = beeline.reach_figure([first.with_title("first"), second])
    assert both.width > drawing.width
    found = beeline.find_placements(map, [beeline.forward_kinematics(arm, arm.middle)], step=0.5)
    return found.placements[0] if found else None


def main() -> None:
    for arm in arms():
        names: list[str] = arm.joint_names
        assert len(names) == arm.dof
        assert tool_position(arm, arm.middle).shape == (3,)
        assert not arm.limit_violations(arm.middle)
        jacobian: Array = beeline.jacobian(arm, arm.middle, frame="tool")
        assert jacobian.shape[1] == arm.dof
    panda = beeline.arms.panda()
    jacobians_of_both_dtypes(panda)
    solutions_of_both_forms(panda)
    calls_by_name()
    placement = reach(beeline.arms.puma560())
    assert placement is not None and placement.margin > 0
    retimed(panda, line_down(panda, numpy.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785]), 0.1))
    try:
        beeline.Arm.load("no_such_arm")
    except beeline.Error as error:
        assert isinstance(error, ValueError) and "no_such_arm" in str(error)


if __name__ == "__main__":
    main()
