"""Feedback control, replay, and objects for control loops: laws, threads that share one, refusals."""

import copy
import gc
import pickle
import threading

import beeline
import numpy as np
import pytest
from moved import moved

PANDA, RRR = beeline.arms.panda(), beeline.arms.rrr()
HOME = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
TOOL = beeline.forward_kinematics(PANDA, HOME)
START, GOAL = np.zeros(3), np.radians([99.2, -68.8, -30.4])


@pytest.fixture(scope="module")
def recording():
    return beeline.move_in_lines(PANDA, HOME, [moved(TOOL, y=0.1), moved(TOOL, z=0.1)]).trajectory


def test_proportional_control_is_equation_1_3():
    motion = beeline.control_joints(RRR, START, GOAL, kp=0.1)
    assert motion and motion.status == "reached" and motion.steps == len(motion.trajectory) - 1
    q = START
    for sample in motion.trajectory.positions[:50]:
        assert sample == pytest.approx(q, abs=1e-12)
        q = q + 0.1 * (GOAL - q)
    late = beeline.control_joints(RRR, START, GOAL, kp=1.5)
    assert late.overshoot == pytest.approx(0.5) == beeline.joint_overshoot(late.trajectory.positions, GOAL)
    wild = beeline.control_joints(RRR, START, GOAL, kp=2.1)
    assert not wild and wild.status == "not_converged" and "too large" in wild.reason
    assert beeline.control_joints(RRR, START, GOAL, max_work=3).status == "work_limit"
    assert np.diff(beeline.control_joints(RRR, START, GOAL, time_step=0.5).trajectory.times[:2]) == 0.5


@pytest.mark.parametrize("method", ["inverse-jacobian", "inverse-kinematics"])
def test_cartesian_control_reaches_its_waypoints(method):
    waypoints = [beeline.parse_pose(pose, triple="planar") for pose in ("4.5,5.2,0", "2,6,0.5")]
    motion = beeline.control_in_lines(RRR, [0, np.pi / 2, 0], waypoints, method=method, gain=0.2, tolerance=1e-5)
    assert motion, motion.reason
    reached = beeline.forward_kinematics(RRR, motion.trajectory.positions[motion.arrivals])
    assert np.abs(reached - waypoints).max() < 1e-4


def test_control_reports_its_limits_and_the_jump_at_its_start():
    goal = HOME + [0, -0.2, 0, 0, 0, 0, 0]
    motion = beeline.control_joints(PANDA, HOME, goal, kp=0.1, time_step=0.02)
    assert motion and motion.start_jump.joint == "joint2" and not motion.start_jump.assumed
    assert motion.start_jump.velocity == pytest.approx(-1)
    assert motion.start_jump.fraction == motion.limits.velocity.fraction == pytest.approx(1 / 2.175)
    planned = beeline.move_joints(PANDA, HOME, goal).start_jump
    assert planned.joint == "" and planned.fraction == planned.velocity == 0


def test_pid_is_its_sum():
    pid = beeline.Pid([1, 2], kp=0.5, ki=0.1, kd=0.2)
    pid.start([0, 0])
    q, total, last = np.zeros(2), np.zeros(2), np.array([1.0, 2])
    for _ in range(20):
        error = np.array([1, 2]) - q
        total, change = total + error, 0.5 * error + 0.1 * (total + error) + 0.2 * (error - last)
        assert pid.step(q) == pytest.approx(change, abs=1e-12)
        q, last = q + change, error
    other = copy.copy(pid)
    assert np.array_equal(other.step(q), pid.step(q))
    pid.set_goal([0, 0])
    assert not np.array_equal(other.step(q), pid.step(q))


def test_a_replay_is_the_recording(recording):
    same = beeline.replay(PANDA, recording)
    assert same and np.array_equal(same.trajectory.positions, recording.positions)
    half = beeline.replay(PANDA, recording, speed=0.5)
    assert half.trajectory.duration == pytest.approx(2 * recording.duration, rel=1e-6)
    pauses = [(0, 1), (0.3, 0), beeline.SpeedChange(1, 0.5)]
    led = beeline.replay(PANDA, recording, start=HOME + 0.05, speed_at=pauses, ramp=0.1)
    assert led and led.lead_in > 0 and led.trajectory.duration > recording.duration + led.lead_in + 0.5
    fast = beeline.replay(PANDA, recording, speed=20)
    assert not fast and fast.status == "outside_limits" and len(fast.trajectory) == 0


def test_a_servo_keeps_the_direction_and_the_limits(rng):
    servo, q = beeline.Servo(PANDA), HOME.copy()
    last = np.zeros(7)
    for _ in range(300):
        command = np.concatenate([[0.2, 0.1, -0.1], np.zeros(3)])
        step = servo.step(q, command)
        assert 0 <= step.scale <= 1 and "scale" in str(step)
        assert (np.abs(step.velocity) <= PANDA.velocity * (1 + 1e-9)).all()
        assert (np.abs(step.velocity - last) <= PANDA.acceleration * 1e-3 * (1 + 1e-6)).all()
        assert beeline.jacobian(PANDA, q) @ step.velocity == pytest.approx(step.scale * command, abs=1e-8)
        last = step.velocity
        q = q + 1e-3 * last
    goal = moved(TOOL, z=0.05)
    for _ in range(3000):
        q = q + 1e-3 * servo.step_towards(q, goal).velocity
    assert np.abs(beeline.forward_kinematics(PANDA, q) - goal).max() < 1e-4


def test_a_tracker_follows_a_jump_within_its_limits():
    tracker, goal = beeline.Tracker(PANDA, HOME), moved(TOOL, x=0.05, z=-0.05)
    last_q, last_v, step = HOME, np.zeros(7), None
    for _ in range(2000):
        step = tracker.step(goal)
        assert step.velocity == pytest.approx((step.q - last_q) / 1e-3, abs=1e-9)
        assert (np.abs(step.velocity) <= PANDA.velocity * (1 + 1e-9)).all()
        assert (np.abs(step.velocity - last_v) <= PANDA.acceleration * 1e-3 * (1 + 1e-6)).all()
        last_q, last_v = step.q, step.velocity
    assert step.status == "following" and step.error.position < 1e-6
    assert np.abs(beeline.forward_kinematics(PANDA, tracker.configuration) - goal).max() < 2e-6
    before = tracker.configuration
    with pytest.raises(beeline.Error, match="not a rigid motion"):
        tracker.step(2 * np.eye(4))
    assert np.array_equal(tracker.configuration, before)
    tracker.reset(HOME)
    assert np.array_equal(tracker.configuration, HOME) and not tracker.velocity.any()


def test_a_player_plays_the_recording(recording):
    player = beeline.Player(PANDA, recording, HOME, time_step=0.01)
    commands, times = [], []
    while not player.done:
        commands.append(player.step())
        times.append(player.recording_time)
        player.measured(commands[-1].q + 1e-3)
    assert np.array_equal(commands[-1].q, recording.positions[-1])
    assert player.tracking.steps == len(commands) and player.tracking.rms == pytest.approx(np.full(7, 1e-3))
    for k in (5, len(commands) // 2):
        assert commands[k].q == pytest.approx(recording.sample(times[k]).position, abs=1e-9)
    led = beeline.Player(PANDA, recording, HOME + 0.1, speed=0)
    assert led.leading_in and led.speed == 0 and led.recording_time == 0
    led.set_speed(1)
    first = copy.deepcopy(led).step()
    assert first == led.step()


def loops(recording):
    servo, tracker = beeline.Servo(PANDA), beeline.Tracker(PANDA, HOME)
    player = beeline.Player(PANDA, recording, HOME)
    goal = moved(TOOL, x=0.05)
    return {"servo": lambda out: servo.step(HOME, [0.1, 0, 0, 0, 0, 0], out=out), "player": lambda out: player.step(out=out),
            "towards": lambda out: servo.step_towards(HOME, goal, out=out), "tracker": lambda out: tracker.step(goal, out=out)}


@pytest.mark.parametrize("name", ["servo", "towards", "tracker", "player"])
def test_results_into_the_callers_arrays(name, recording):
    step = loops(recording)[name]
    out = np.full(14, np.nan)[::2]  # of any strides
    made = step(out)
    assert np.array_equal(out, made.velocity if name in ("servo", "towards") else made.q)
    if name in ("tracker", "player"):
        q, velocity = np.empty(7), np.empty(7)
        made = step((q, velocity))
        assert np.array_equal(q, made.q) and np.array_equal(velocity, made.velocity)
    read_only = np.empty(7)
    read_only.flags.writeable = False
    for wrong in (np.empty(6), np.empty((7, 1)), read_only):
        with pytest.raises(beeline.Error, match="out"):
            step(wrong)
    for wrong in (np.empty(7, np.float32), [0] * 7, "out", (np.empty(7),)):
        with pytest.raises(TypeError, match="out"):
            step(wrong)


@pytest.mark.parametrize("name", ["servo", "towards", "tracker", "player"])
def test_threads_take_turns(name, recording):
    step, failures = loops(recording)[name], []

    def work():
        try:
            for _ in range(500):
                result = step(None)
                assert np.isfinite(result.velocity).all()
        except BaseException as error:  # noqa: B036
            failures.append(error)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_loops_outlive_their_arm_and_copy(recording):
    arm = beeline.Arm.from_json(PANDA.to_json())
    servo, tracker, player = beeline.Servo(arm), beeline.Tracker(arm, HOME), beeline.Player(arm, recording, HOME)
    del arm
    for loop, step in ((servo, lambda l: l.step(HOME, [0.1] * 6)), (tracker, lambda l: l.step(moved(TOOL, x=0.1))),
                       (player, lambda l: l.step())):
        other = copy.copy(loop)
        first = [step(loop) for _ in range(3)]
        assert [step(other) for _ in range(3)] == first
        assert loop == loop and loop != other
        assert repr(loop) == repr(other) == f"<beeline.{type(loop).__name__} of panda>"
        with pytest.raises(TypeError, match="has no pickle.*; pickle its arm"):
            pickle.dumps(loop)
        for value in (first[0],):
            assert pickle.loads(pickle.dumps(value)) == value == copy.deepcopy(value)


def test_a_copied_pid_continues_alone():
    pid = beeline.Pid([1, 2], kp=0.5, ki=0.1)
    pid.step([0, 0])
    other = copy.deepcopy(pid)
    assert np.array_equal(pid.step([0.1, 0]), other.step([0.1, 0]))
    pid.set_goal([5, 5])
    assert not np.array_equal(pid.step([0, 0]), other.step([0, 0]))
    assert repr(other) == "<beeline.Pid of 2 joints, kp=0.5, ki=0.1>"
    with pytest.raises(TypeError, match="pickle its goal and gains"):
        pickle.dumps(pid)


@pytest.mark.filterwarnings("ignore:nanobind")
def test_objects_that_were_not_made_are_refused():
    with pytest.raises(TypeError):
        beeline.Servo.__new__(beeline.Servo).step(HOME, [0] * 6)
    with pytest.raises(TypeError):
        beeline.Servo(PANDA).__init__(PANDA)


def test_copies_and_pickles_are_equal(recording):
    for value in (beeline.control_joints(RRR, START, GOAL), beeline.replay(PANDA, recording), beeline.SpeedChange(1, 0.5),
                  beeline.Player(PANDA, recording, HOME).tracking):
        for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
            assert other == value and repr(other) == repr(value)


REFUSED = {
    "takes 3 joint values": lambda: beeline.control_joints(RRR, START, GOAL[:2]),
    "kp must be above zero": lambda: beeline.control_joints(RRR, START, GOAL, kp=0),
    "at least one waypoint": lambda: beeline.control_in_lines(PANDA, HOME, []),
    "unknown method": lambda: beeline.control_in_lines(PANDA, HOME, [TOOL], method="magic"),
    "goal has 1 values": lambda: beeline.joint_overshoot([[1, 2]], [1]),
    "would not end": lambda: beeline.replay(PANDA, beeline.at_rest(PANDA, HOME), speed_at=[(0, 0)]),
    "no samples": lambda: beeline.Player(PANDA, beeline.Trajectory(PANDA.joint_names, [], []), HOME),
    "must be from 0 to 1": lambda: beeline.Player(PANDA, beeline.at_rest(PANDA, HOME), HOME).set_speed(2),
    "has 1 values": lambda: beeline.Player(PANDA, beeline.at_rest(PANDA, HOME), HOME).measured([1]),
    "the gain must be": lambda: beeline.Servo(PANDA, gain=-1),
    "command has the shape": lambda: beeline.Servo(PANDA).step(HOME, [0] * 5),
    "command must be finite": lambda: beeline.Servo(PANDA).step(HOME, [np.nan] * 6),
    "it must be a finite number": lambda: beeline.Servo(PANDA).step(HOME * np.nan, [0] * 6),
    "q has the shape": lambda: beeline.Servo(PANDA).step([HOME], [0] * 6),
    "outside its limits": lambda: beeline.Tracker(PANDA, HOME + 9),
    "not finite": lambda: beeline.Tracker(PANDA, HOME).step(TOOL * np.nan),
}


@pytest.mark.parametrize("message", REFUSED)
def test_invalid_arguments_are_refused(message):
    with pytest.raises(beeline.Error, match=message):
        REFUSED[message]()


def wall_model():
    facing_the_arm = [[0, 0, -1, 0.55], [0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1]]
    wall = beeline.Obstacle(name="wall", shapes=[beeline.Shape(body=beeline.HalfSpace(), pose=facing_the_arm)],
                            clearance=0.01)
    scene = beeline.Scene(obstacles=[wall])
    return beeline.CollisionModel(PANDA, beeline.read_arm_shapes("panda").links, scene)


BEFORE_WALL = np.array([0, -0.3, 0, -2.2, 0, 2.0, 0.785])


def test_a_servo_keeps_the_clearance_of_a_model():
    model = wall_model()
    servo, q = beeline.Servo(PANDA, model=model), BEFORE_WALL
    for _ in range(1500):
        step = servo.step(q, [0.3, 0, 0, 0, 0, 0])
        q = q + 1e-3 * step.velocity
        pair = beeline.nearest_pair(model, q)
        assert pair.lower >= pair.clearance - 1e-9
    assert (step.limit, step.bodies, step.joint) == ("clearance", ("panda_link7", "wall"), None)
    assert str(step).endswith("limit clearance of panda_link7 and wall") and step.proved
    assert servo.step(q, [-0.1, 0, 0, 0, 0, 0]).bodies is None


def test_a_servo_says_that_a_step_is_not_proved():
    model = wall_model()
    servo, q = beeline.Servo(PANDA, model=model), BEFORE_WALL
    while (pair := beeline.nearest_pair(model, q)).lower > pair.clearance + 1e-3:
        step = servo.step(q, [0.3, 0, 0, 0, 0, 0])
        q = q + 1e-3 * step.velocity
    while (pair := beeline.nearest_pair(model, q)).lower > pair.clearance:
        q = q + 1e-3 * step.velocity
    step = servo.step(q, [0.3, 0, 0, 0, 0, 0])
    assert not step.proved and str(step).endswith(", not proved")


def test_a_tracker_keeps_the_clearance_of_a_model():
    model = wall_model()
    tracker = beeline.Tracker(PANDA, BEFORE_WALL, model=model, damper_gain=20)
    goal = beeline.forward_kinematics(PANDA, BEFORE_WALL).copy()
    goal[0, 3] += 0.3
    for _ in range(1500):
        step = tracker.step(goal)
        pair = beeline.nearest_pair(model, step.q)
        assert pair.lower >= pair.clearance - 1e-9
    assert (step.status, step.limit, step.bodies) == ("limited", "clearance", ("panda_link7", "wall"))
    assert step.proved


def test_a_loop_keeps_its_model_and_its_copies_do():
    loops = [beeline.Servo(PANDA, model=wall_model())]
    loops.append(copy.copy(loops[0]))
    step = loops[0].step(BEFORE_WALL, [0.1, 0, 0, 0, 0, 0])
    del loops[0]
    gc.collect()
    assert np.array_equal(loops[0].step(BEFORE_WALL, [0.1, 0, 0, 0, 0, 0]).velocity, step.velocity)
    with pytest.raises(TypeError, match="model: expected CollisionModel"):
        beeline.Servo(PANDA, model="wall")
    with pytest.raises(beeline.Error, match="another arm"):
        beeline.Servo(beeline.arms.ur5e(), model=wall_model())
    with pytest.raises(beeline.Error, match="damper gain"):
        beeline.Servo(PANDA, model=wall_model(), damper_gain=0)
