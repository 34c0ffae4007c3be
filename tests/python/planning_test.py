"""Planned motions and their proofs, programs, files for controllers: laws, endings, refusals."""

import copy
import pickle

import beeline
import numpy as np
import pytest
from moved import moved

PANDA, UR5, RRR = beeline.arms.panda(), beeline.arms.ur5(), beeline.arms.rrr()
HOME = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
UR5_HOME = np.array([0.2, -1.2, 1.5, -0.5, 1.2, 0])


TOOL = beeline.forward_kinematics(PANDA, HOME)
SQUARE = np.array([moved(TOOL, y=0.1), moved(TOOL, y=0.1, z=0.1), moved(TOOL, z=0.1), TOOL])


@pytest.fixture(scope="module")
def motion():
    return beeline.move_in_lines(PANDA, HOME, SQUARE)


def distance_from_lines(positions, corners):
    nearest = np.full(len(positions), np.inf)
    for a, b in zip(corners, corners[1:]):
        s = np.clip((positions - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(positions - a - s[:, None] * (b - a), axis=1))
    return nearest


def test_the_tool_moves_in_lines(motion):
    assert motion and motion.status == "reached" and motion.reason == ""
    assert motion.trajectory is motion.trajectory and "reached" in str(motion)
    t = np.linspace(0, motion.trajectory.duration, 20001)
    tool = beeline.forward_kinematics(PANDA, motion.trajectory.sample(t).position)
    off = distance_from_lines(tool[:, :3, 3], np.array([TOOL, *SQUARE])[:, :3, 3])
    assert off.max() <= motion.deviation.bound.position <= 1e-4
    ends = beeline.forward_kinematics(PANDA, motion.trajectory.positions[motion.arrivals])
    assert np.abs(ends - SQUARE).max() < 1e-5
    assert not np.any(motion.trajectory.velocities[motion.arrivals])
    assert motion.deviation.interval_bounds.shape == (len(motion.trajectory) - 1, 2)
    assert motion.deviation.interval_bounds[:, 0].max() == pytest.approx(motion.deviation.bound.position)


def test_its_proof_is_repeated_from_the_columns(motion):
    proof = beeline.verify(PANDA, motion.trajectory, SQUARE)
    assert proof and proof.fault == "none" and "verified" in str(proof)
    assert proof.deviation.bound.position == pytest.approx(motion.deviation.bound.position, rel=0.1)
    assert np.array_equal(proof.arrivals, motion.arrivals)
    route = beeline.Route(motion.path, [True] * 4)
    again = beeline.verify(PANDA, motion.trajectory, route)
    assert again and again.deviation == motion.deviation
    along_path = beeline.path_deviation(PANDA, motion.trajectory, motion.path_parameters, motion.path)
    assert along_path.bound.position == pytest.approx(motion.deviation.bound.position, rel=0.2)
    assert np.array_equal(beeline.arrivals(motion.path_parameters), motion.arrivals)
    along = beeline.path_parameters_along(PANDA, motion.trajectory.positions, motion.path, motion.arrivals)
    assert np.abs(along - motion.path_parameters).max() < 1e-6


def test_faults_are_found(motion, rng):
    trajectory = motion.trajectory
    k = int(rng.integers(1, len(trajectory) - 1))
    q = trajectory.positions.copy()
    q[k, 3] += 2e-3
    off = beeline.Trajectory(trajectory.joint_names, trajectory.times, q, trajectory.velocities, trajectory.accelerations)
    answer = beeline.verify(PANDA, off, SQUARE)
    assert not answer and answer.fault != "none" and answer.reason and abs(answer.sample - k) <= 1
    fast = beeline.slow_down(trajectory, 1)
    fast = beeline.Trajectory(fast.joint_names, fast.times / 2, fast.positions, 2 * fast.velocities,
                              4 * fast.accelerations)
    fault = beeline.first_joint_fault(PANDA, fast)
    assert fault.kind in ("velocity", "acceleration", "jerk") and "joint" in fault.reason
    assert beeline.first_joint_fault(PANDA, trajectory) is None
    half = beeline.Trajectory(trajectory.joint_names, trajectory.times[k:], trajectory.positions[k:],
                              trajectory.velocities[k:], trajectory.accelerations[k:])
    if trajectory.velocities[k].any():
        assert beeline.first_joint_fault(PANDA, half).kind == "moving"
        assert beeline.first_joint_fault(PANDA, half, moving=(True, False)) is None


def test_paths_of_all_kinds():
    poses = [TOOL, moved(TOOL, y=0.05, z=0.05), moved(TOOL, y=0.1)]
    for kind in ("line", "screw", "arc", "spline"):
        route = beeline.route_of(beeline.path_through(poses, kind), kind)
        motion = beeline.move_along(PANDA, HOME, route)
        assert motion, (kind, motion.reason)
        assert beeline.verify(PANDA, motion.trajectory, route)
    blended = beeline.route_of(beeline.blended_lines(poses, (0.005, 0.05)))
    smooth = beeline.move_along(PANDA, None, blended, rate=200, tool_speed=0.1)
    assert smooth and np.abs(np.diff(smooth.trajectory.times) - 0.005).max() < 2e-9


def test_without_a_start_the_first_pose_is_it():
    motion = beeline.move_in_lines(UR5, None, [beeline.forward_kinematics(UR5, UR5_HOME),
                                               moved(beeline.forward_kinematics(UR5, UR5_HOME), z=0.05)])
    assert motion and len(motion.arrivals) == 1


def test_what_is_impossible_has_a_reason():
    far = beeline.move_in_lines(RRR, [0, np.pi / 2, 0], [beeline.parse_pose("20,0,0", triple="planar")])
    assert not far and far.status == "unreachable" and "stops after" in far.reason
    assert len(far.trajectory) == 0 and 0 < far.path_parameter < 1
    few = beeline.move_in_lines(PANDA, HOME, SQUARE, max_samples=10)
    assert few.status == "too_many_samples"
    tool = beeline.forward_kinematics(UR5, UR5_HOME)
    out = beeline.lines_through([tool, moved(tool, x=0.9)])
    fractions = []
    nearby = beeline.nearby_path(UR5, None, out, progress=fractions.append)
    assert fractions and fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] <= 1
    assert nearby is None or beeline.plan_path(UR5, None, nearby.path)


def test_budgets_end_plans():
    for keywords, status in (({"max_work": 1}, "work_limit"), ({"time_limit": 0}, "time_limit")):
        motion = beeline.move_in_lines(PANDA, HOME, SQUARE, **keywords)
        assert not motion and motion.status == status and motion.reason
        assert beeline.plan_path(PANDA, HOME, beeline.lines_through([TOOL, *SQUARE]), **keywords).status == status
    assert beeline.verify(PANDA, beeline.move_in_lines(PANDA, HOME, SQUARE).trajectory, SQUARE,
                          max_work=1).ending == "work_limit"


def test_all_branches_of_a_path():
    tool = beeline.forward_kinematics(UR5, UR5_HOME)
    path = beeline.lines_through([tool, moved(tool, z=0.1)])
    branches = beeline.branch_map(UR5, path, reasons="all")
    assert 1 < len(branches) <= 8 and any(branches)
    for branch in branches:
        assert np.abs(beeline.forward_kinematics(UR5, branch.start) - tool).max() < 1e-9
        assert bool(branch) == (branch.status == "reached") == (branch.reason == "")
        for segment in branch.segments:
            assert len(segment.samples) == len(segment.fractions)
    called = []
    guided = beeline.plan_path(UR5, UR5_HOME, path, guide=lambda s: called.append(s) or UR5_HOME)
    assert guided and called and 0 <= min(called) and max(called) <= 1


class Stop(Exception):
    pass


def test_exceptions_of_callbacks_end_the_work():
    def stop(argument):
        raise Stop(argument)

    path = beeline.lines_through([TOOL, *SQUARE])
    with pytest.raises(Stop):
        beeline.plan_path(UR5, UR5_HOME, beeline.lines_through(
            [beeline.forward_kinematics(UR5, UR5_HOME), moved(beeline.forward_kinematics(UR5, UR5_HOME), z=0.1)]), guide=stop)
    with pytest.raises(Stop):
        beeline.move_along(PANDA, HOME, beeline.route_of(beeline.path_through([TOOL, *SQUARE[:3]] * 8)),
                           progress=stop)
    with pytest.raises(beeline.Error, match="takes 6 joint values"):
        beeline.plan_path(UR5, UR5_HOME, beeline.lines_through(
            [beeline.forward_kinematics(UR5, UR5_HOME), moved(beeline.forward_kinematics(UR5, UR5_HOME), z=0.1)]),
            guide=lambda s: [0])
    assert beeline.plan_path(PANDA, HOME, path)  # all as before


@pytest.fixture(scope="module")
def pick(request):
    root = request.getfixturevalue("root")
    program = beeline.Program.load(root / "examples" / "pick_panda.csv", PANDA, angle_unit="degrees")
    return program, beeline.move_program(PANDA, None, program)


def test_a_program_of_a_file(pick, root):
    program, motion = pick
    assert motion and len(motion.moves) == len(program.moves) == motion.failed
    assert program.moves[0].kind == "joint" and program.moves[1].place.startswith("pick_panda.csv:")
    assert beeline.verify(PANDA, motion.trajectory, program)
    assert beeline.Program(program.moves) == program
    for move, planned in zip(program.moves, motion.moves):
        if move.blend == 0:
            tool = beeline.forward_kinematics(PANDA, motion.trajectory.positions[planned.end])
            assert np.abs(tool - move.target).max() < 1e-5


def test_blends_of_joint_moves():
    away = HOME + 0.2
    moves = [beeline.Move("joint", q=away, blend=0.05), beeline.Move("joint", q=HOME + [0.5, 0, 0, 0, 0, 0, 0])]
    motion = beeline.move_program(PANDA, HOME, beeline.Program(moves))
    assert motion and motion.moves[0].blend == "full" and motion.moves[1].blend == "none"
    assert motion.moves[0].joint_blend_radius > 0 and np.array_equal(motion.moves[0].waypoints, [away])
    stops = beeline.move_program(PANDA, HOME, beeline.Program([beeline.Move("joint", q=away), moves[1]]))
    assert motion.duration < stops.duration and beeline.verify(PANDA, motion.trajectory, beeline.Program(moves))


def test_the_end_of_the_search_for_blends_is_reported():
    """Of three runs of moves between stops, the blends that are proved before the end of the budget stay."""
    rng = np.random.default_rng(5)
    program = beeline.Program([beeline.Move("joint", q=HOME + rng.uniform(-0.3, 0.3, 7), blend=0 if i % 3 == 2 else 0.05)
                               for i in range(9)])
    whole = beeline.move_program(PANDA, HOME, program)
    assert whole.search_ending == "complete" and "blends:" not in str(whole)
    ended, work, motion = set(), 1024, None
    while not motion or motion.search_ending != "complete":
        motion = beeline.move_program(PANDA, HOME, program, max_work=work)
        work += work // 8
        if motion and motion.search_ending == "work_limit":
            assert beeline.verify(PANDA, motion.trajectory, program) and "blends: the limit of work ended" in str(motion)
            ended.add(sum(move.blend in ("full", "smaller") for move in motion.moves))
    assert any(0 < blends < 6 for blends in ended)


def test_a_program_of_moves():
    program = beeline.Program([
        beeline.Move("joint", q=HOME),
        beeline.Move("line", moved(TOOL, z=-0.1), speed=0.1, dwell=0.2),
        beeline.Move("arc", moved(TOOL, y=0.1, z=-0.1), via=(moved(TOOL, y=0.05, z=-0.05)[:3, 3])),
    ])
    motion = beeline.move_program(PANDA, HOME, program)
    assert motion, motion.reason
    assert beeline.verify(PANDA, motion.trajectory, program)
    assert motion.moves[1].tool_speed <= 0.1 + 1e-9
    wrong = beeline.Program([*program.moves[:2], beeline.Move("line", moved(TOOL, x=3))])
    answer = beeline.move_program(PANDA, HOME, wrong)
    assert not answer and answer.failed == 2 and "move 3" in answer.reason


def test_a_program_carries_a_part():
    arm = beeline.arms.rrr()

    def box(name, x, y):
        pose = np.eye(4)
        pose[:2, 3] = x, y
        return beeline.Obstacle(name, [beeline.Shape(beeline.Box([0.4, 0.4, 0.4]), pose)])

    start, end = np.radians([[0, 60, 60], [40, 60, 60]])
    x, y = beeline.forward_kinematics(arm, start)[:2, 3]
    links = [beeline.LinkShapes("hand", 3, [beeline.Shape(beeline.Sphere(0.05))])]
    scene = beeline.Scene([box("part", x, y), box("far", -9, 0)], allowed_pairs=[("hand", "part")])
    model = beeline.CollisionModel(arm, links, scene)
    moves = [beeline.Move("joint", q=start), beeline.Move("joint", q=end), beeline.Move("joint", q=start)]
    carried = beeline.Attachment("part", after=1, until=2, place="here")
    program = beeline.Program(moves, attachments=[carried])
    assert program != beeline.Program(moves) and program.attachments == [carried]
    motion = beeline.move_program(arm, None, program)
    arrivals = [move.end for move in motion.moves]
    proof = beeline.prove_clearance(model, motion.trajectory, program, arrivals, closest=True)
    assert proof and list(beeline.verify(arm, motion.trajectory, program).arrivals) == arrivals
    [part] = beeline.attached_parts(model, motion.trajectory, program, arrivals)
    times = motion.trajectory.times
    assert (part.part, part.attached, part.detached) == ("part", times[arrivals[0]], times[arrivals[1]])
    tool = beeline.forward_kinematics(arm, start)
    np.testing.assert_allclose(tool @ part.tool_T_part, scene.obstacles[0].shapes[0].pose, atol=1e-12)
    # A post that only the part sweeps through.
    tip = beeline.forward_kinematics(arm, np.radians([20, 60, 60]))[:2, 3]
    post = tip * (1 + 0.35 / np.linalg.norm(tip))
    blocked = beeline.CollisionModel(arm, links, beeline.Scene([*scene.obstacles, box("post", *post)],
                                                               allowed_pairs=scene.allowed_pairs))
    refused = beeline.prove_clearance(blocked, motion.trajectory, program, arrivals)
    assert refused.status == "collides" and set(refused.pair.names) == {"part", "post"}
    assert refused.reason.fields["move"] == 2 and "move 2 (joint)" in str(refused.reason)
    assert beeline.prove_clearance(blocked, motion.trajectory)
    over_time = beeline.clearance_over_time(blocked, motion.trajectory, program, arrivals)
    assert min(over_time.sampled) < 0 < min(beeline.clearance_over_time(blocked, motion.trajectory).sampled)
    with pytest.raises(beeline.Error, match="arrivals must be a sample for each of the 3 moves"):
        beeline.prove_clearance(model, motion.trajectory, program, arrivals[:2])
    with pytest.raises(beeline.Error, match="given together"):
        beeline.prove_clearance(model, motion.trajectory, program)
    with pytest.raises(beeline.Error, match='attach prt: unknown obstacle "prt"'):
        beeline.attached_parts(model, motion.trajectory, beeline.Program(moves, attachments=[beeline.Attachment("prt")]), arrivals)


def test_configurations_of_a_file(tmp_path):
    path = tmp_path / "moves.csv"
    path.write_text("motion,q\njoint,ready\njoint,\"0,-45,0,-135,0,90,45\"\n")
    program = beeline.Program.load(path, PANDA, angle_unit="degrees", states={"ready": HOME})
    assert np.array_equal(program.moves[0].q, HOME)
    assert program.moves[1].q == pytest.approx(np.radians([0, -45, 0, -135, 0, 90, 45]))
    with pytest.raises(beeline.FileError, match=":2: .*ready"):
        beeline.Program.load(path, PANDA)
    path.write_text("x,y,theta,motion\n1,2,3,line\n")
    with pytest.raises(beeline.FileError, match=":2: x,y,theta is for planar arms"):
        beeline.Program.load(path, PANDA)
    path.write_text("x,y,z,motion\n1,2,3,line\n")
    with pytest.raises(beeline.FileError, match=":2: the pose has no orientation"):
        beeline.Program.load(path, PANDA)


def test_poses_of_a_file(root):
    listed = beeline.read_poses(root / "examples" / "waypoints_rrr.csv", "degrees")
    assert listed.poses.shape == (3, 4, 4) and listed.planar and listed.columns == ["x", "y", "theta"]
    with pytest.raises(beeline.FileError, match="no_such_file"):
        beeline.read_poses("no_such_file.csv")
    assert beeline.parse_pose("1,2,3", triple="position")[:3, 3] == pytest.approx([1, 2, 3])
    with pytest.raises(beeline.Error):
        beeline.parse_pose("1,2,3,4")


def test_files_for_controllers(pick, tmp_path):
    program, motion = pick
    for form in ("ros2", "csv"):
        file = beeline.controller_file(PANDA, motion.trajectory, form, rate=100)
        assert file.proof and file.samples == pytest.approx(100 * file.duration + 1, abs=1.5)
        path = tmp_path / ("motion." + beeline.controller_file_endings(form)[0])
        file.save(path)
        assert path.read_text() == file.text
    ur5 = beeline.move_in_lines(UR5, UR5_HOME, [moved(beeline.forward_kinematics(UR5, UR5_HOME), z=0.05)])
    for form, word in (("urscript", "servoj"), ("rapid", "MoveAbsJ"), ("krl", "PTP")):
        assert word in beeline.controller_file(UR5, ur5.trajectory, form, program_name="lift").text
    plan = beeline.Program([beeline.Move("joint", q=UR5_HOME),
                            beeline.Move("line", moved(beeline.forward_kinematics(UR5, UR5_HOME), z=0.05))])
    planned = beeline.move_program(UR5, UR5_HOME, plan)
    assert "movel" in beeline.controller_file(UR5, plan, planned, "urscript").text
    in_work = beeline.controller_file(UR5, plan, planned, "urscript", work=plan.moves[1].target)
    assert "movel(pose_trans(work, p[0.000000000000,0.000000000000,0.000000000000," in in_work.text
    with pytest.raises(beeline.Error, match="work frame is for the export of programs"):
        beeline.controller_file(UR5, ur5.trajectory, "krl", work=np.eye(4))
    with pytest.raises(beeline.Error, match="six revolute joints"):
        beeline.controller_file(PANDA, motion.trajectory, "rapid")


def test_a_file_for_a_controller_keeps_the_limits(tmp_path):
    motion = beeline.move_joints(PANDA, HOME, HOME + 0.1).trajectory
    file = beeline.controller_file(PANDA, motion, "ros2")
    assert file and file.proof.startswith("the limits of position, velocity, acceleration and jerk at all times")
    assert file.not_proved == [] and not file.reason
    slow = PANDA.with_limits({"joint1": {"velocity": 0.01}})
    refused = beeline.controller_file(slow, motion, "ros2")
    assert not refused and refused.text == "" and refused.reason.fields["joint"] == "joint1"
    with pytest.raises(beeline.Error, match="nothing is saved: .*joint1"):
        refused.save(tmp_path / "motion.yaml")
    assert not (tmp_path / "motion.yaml").exists()
    written = beeline.controller_file(slow, motion, "ros2", ignore_limits=True)
    assert written and any(line.startswith("limits of velocity: ") for line in written.not_proved)


def test_copies_and_pickles_are_equal(motion, pick):
    program, planned = pick
    far = beeline.move_in_lines(RRR, [0, np.pi / 2, 0], [beeline.parse_pose("20,0,0", triple="planar")])
    values = [motion, motion.deviation, far, program, program.moves[0], planned, planned.moves[1],
              beeline.verify(PANDA, motion.trajectory, SQUARE), beeline.MovingEnds(True, False),
              beeline.plan_path(PANDA, HOME, motion.path),
              beeline.controller_file(PANDA, motion.trajectory, "ros2")]
    for value in values:
        for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
            assert other == value and repr(other) == repr(value)
        assert value != 0 and value != None  # noqa: E711


REFUSED = {
    "the motion cannot start": lambda: beeline.move_in_lines(PANDA, HOME + 9, SQUARE),
    "takes 7 joint values": lambda: beeline.move_in_lines(PANDA, HOME[:6], SQUARE),
    "at least one waypoint": lambda: beeline.move_in_lines(PANDA, HOME, []),
    "waypoints has the shape": lambda: beeline.move_in_lines(PANDA, HOME, np.zeros((2, 3, 4))),
    "not a rigid motion": lambda: beeline.move_in_lines(PANDA, HOME, 2 * SQUARE),
    "number that is not finite": lambda: beeline.move_in_lines(PANDA, HOME, SQUARE * np.nan),
    "tolerance must be": lambda: beeline.move_in_lines(PANDA, HOME, SQUARE, tolerance=0),
    "unknown task": lambda: beeline.move_in_lines(PANDA, HOME, SQUARE, task="planer"),
    "a route needs segments": lambda: beeline.move_along(PANDA, HOME, beeline.Route(beeline.ToolPath([]), [])),
    "a path needs segments": lambda: beeline.plan_path(PANDA, HOME, beeline.ToolPath([])),
    "a program needs moves": lambda: beeline.move_program(PANDA, None, beeline.Program([])),
    "an arc needs a via": lambda: beeline.move_program(PANDA, HOME, beeline.Program([beeline.Move("arc", TOOL)])),
    "does not fit": lambda: beeline.verify(UR5, beeline.at_rest(PANDA, HOME), SQUARE),
    "not a path parameter": lambda: beeline.arrivals([0, np.nan]),
    "arrivals are indices": lambda: beeline.path_parameters_along(
        PANDA, [HOME], beeline.lines_through([TOOL, SQUARE[0]]), [3]),
    "a path parameter for each": lambda: beeline.path_deviation(
        PANDA, beeline.at_rest(PANDA, HOME), [], beeline.lines_through([TOOL, SQUARE[0]])),
}


@pytest.mark.parametrize("message", REFUSED)
def test_invalid_arguments_are_refused(message):
    with pytest.raises(beeline.Error, match=message):
        REFUSED[message]()


@pytest.mark.parametrize("call", [
    lambda: beeline.verify(PANDA, beeline.at_rest(PANDA, HOME), "poses"), lambda: beeline.Move(),
    lambda: beeline.Program([TOOL]), lambda: beeline.Program(beeline.Move("line")),
    lambda: beeline.plan_path(PANDA, HOME, beeline.lines_through([TOOL, SQUARE[0]]), guide=3),
    lambda: beeline.controller_file(PANDA, TOOL, "csv"),
    lambda: beeline.move_in_lines(PANDA, HOME, SQUARE, progress=1)])
def test_wrong_types_are_refused(call):
    with pytest.raises(TypeError):
        call()


def test_verify_without_a_path_checks_the_joints_and_lists_every_kind_of_fault():
    arm = beeline.arms.ur5()
    motion = beeline.move_joints(arm, [0] * 6, [1, 1, 1, 0, 0, 0])
    assert motion.limits.acceleration.assumed and 0 < motion.limits.position.fraction < 1
    assert beeline.verify(arm, motion.trajectory).faults == []
    positions = np.array(motion.trajectory.positions)
    positions[20:, 1] += 7
    jumping = beeline.Trajectory(motion.trajectory.joint_names, motion.trajectory.times, positions)
    checked = beeline.verify(arm, jumping)
    kinds = {faults.kind: faults for faults in checked.faults}
    assert not checked and checked.faults[0].kind == checked.fault
    assert {"limits", "flip", "velocity"} <= set(kinds)
    assert kinds["limits"].sample == np.argmax(positions[:, 1] > 2 * np.pi)
    assert kinds["limits"].amount == pytest.approx(positions[:, 1].max() - 2 * np.pi)
    assert kinds["flip"].sample == 19 and kinds["flip"].amount > np.pi
