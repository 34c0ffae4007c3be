"""Trajectories: columns in and out, the motion between samples, files, comparisons, refusals."""

import copy
import pickle

import beeline
import numpy as np
import pytest
from numpy.polynomial import Polynomial

PANDA = beeline.arms.panda()
COLUMNS = {"linear": 1, "cubic": 2, "quintic": 3}  # of an interpolation


def random_trajectory(rng, interpolation="quintic", samples=6, joints=3):
    times = np.cumsum(rng.uniform(0.1, 1, samples))
    columns = rng.uniform(-1, 1, (COLUMNS[interpolation], samples, joints))
    return beeline.Trajectory([f"j{i}" for i in range(joints)], times, *columns)


@pytest.fixture(params=COLUMNS)
def trajectory(request, rng):
    return random_trajectory(rng, request.param)


def columns_of(trajectory):
    return [c for c in (trajectory.positions, trajectory.velocities, trajectory.accelerations) if len(c)]


def test_trajectories_and_motions_are_printed_in_a_line(rng):
    trajectory = random_trajectory(rng, "cubic", 43, 7)
    assert str(trajectory) == f"7 joints, 43 samples, {trajectory.duration:.6g} s, cubic"
    goal = PANDA.middle + 0.1
    move = beeline.move_joints(PANDA, PANDA.middle, goal)
    recorded = move.trajectory
    reached = f"reached in {recorded.duration:.6g} s, {len(recorded)} samples, "
    assert str(move) == reached + "error 0"
    assert str(beeline.replay(PANDA, recorded)).startswith(reached + "up to ")
    fast = beeline.replay(PANDA, recorded, speed=50)
    assert str(fast) == f"{fast.status}: {fast.reason}" and fast.reason
    tool = beeline.forward_kinematics(PANDA, goal)
    done = beeline.move_program(PANDA, PANDA.middle, beeline.Program([beeline.Move("joint", tool)]))
    assert str(done).startswith("reached in ") and " samples, 1 move, deviation at most " in str(done)


def test_columns_come_back(rng):
    times, columns = np.arange(4.0), rng.uniform(-1, 1, (3, 4, 2))
    made = beeline.Trajectory(joint_names=["a", "b"], times=times, positions=columns[0],
                              velocities=columns[1], accelerations=columns[2])
    assert made.joint_names == ["a", "b"] and len(made) == 4 and made.duration == 3
    assert np.array_equal(made.times, times)
    for ours, given in zip(columns_of(made), columns):
        assert np.array_equal(ours, given)


@pytest.mark.parametrize("convert", [np.asfortranarray, np.float32, lambda x: x[::-1][::-1],
                                     np.ndarray.tolist, lambda x: tuple(map(tuple, x))])
def test_arrays_of_any_layout(convert):
    positions = np.arange(12.0).reshape(4, 3)
    made = beeline.Trajectory(["a", "b", "c"], range(4), convert(positions))
    assert np.array_equal(made.positions, positions)


def test_arrays_are_read_only_and_made_once(trajectory):
    assert trajectory.positions is trajectory.positions
    for column in (trajectory.times, *columns_of(trajectory)):
        with pytest.raises(ValueError):
            column[0] = 1


def test_arrays_outlive_their_trajectory(rng):
    positions = random_trajectory(rng).positions
    assert positions.sum() == positions.copy().sum()


def test_interpolation_follows_from_the_columns(trajectory):
    assert COLUMNS[trajectory.interpolation] == len(columns_of(trajectory))


def hermite(h, values):
    """The polynomial in the time since a sample that has these values and derivatives at 0 and h."""
    n = 2 * len(values)
    rows, right = [], []
    for order, (start, end) in enumerate(values):
        for t, value in ((0, start), (h, end)):
            basis = [Polynomial.basis(k).deriv(order)(t) if order else Polynomial.basis(k)(t) for k in range(n)]
            rows.append(basis)
            right.append(value)
    return Polynomial(np.linalg.solve(rows, right))


def test_samples_equal_the_polynomials(trajectory, rng):
    columns = columns_of(trajectory)
    for k in range(len(trajectory) - 1):
        h = trajectory.times[k + 1] - trajectory.times[k]
        t = rng.uniform(0, h, 5)
        state = trajectory.sample(trajectory.times[k] + t)
        for joint in range(3):
            p = hermite(h, [(c[k, joint], c[k + 1, joint]) for c in columns])
            for order, ours in enumerate((state.position, state.velocity, state.acceleration, state.jerk)):
                expected = p.deriv(order)(t) if order else p(t)
                scale = 1e-9 / h**order * max(1, 1 / h)
                assert np.abs(ours[:, joint] - expected).max() < scale, (k, joint, order)


def test_times_of_any_shape(trajectory, rng):
    t = rng.uniform(trajectory.times[0] - 1, trajectory.times[-1] + 1, (2, 4))
    many = trajectory.sample(t)
    assert many.position.shape == (2, 4, 3)
    for index in np.ndindex(2, 4):
        one = trajectory.sample(t[index])
        assert one.position.shape == (3,)
        for name in ("position", "velocity", "acceleration", "jerk"):
            assert np.array_equal(getattr(one, name), getattr(many, name)[index])
    assert trajectory.sample([]).velocity.shape == (0, 3)


def test_sides_of_a_sample():
    turn = beeline.Trajectory(["a"], [0, 1, 2], [[0], [1], [0]])
    assert turn.sample(1, side="before").velocity == 1
    assert turn.sample(1, side="after").velocity == -1
    assert turn.sample(1).velocity == -1


@pytest.mark.parametrize("ending", ["csv", "json", "yaml"])
def test_files_read_back(trajectory, tmp_path, ending):
    path = tmp_path / f"motion.{ending}"  # a path, and text
    trajectory.save(path)
    back = beeline.Trajectory.load(str(path))
    assert np.abs(back.times - trajectory.times).max() <= (0 if ending == "csv" else 1e-9)
    for ours, read in zip(columns_of(trajectory), columns_of(back)):
        assert np.array_equal(ours, read)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_a_file_that_cannot_be_written_leaves_the_old_one(tmp_path):
    path = tmp_path / "motion.csv"
    path.write_text("old")
    with pytest.raises(beeline.Error, match="no samples"):
        beeline.Trajectory(["a"], [], np.empty((0, 1))).save(path)
    assert path.read_text() == "old"
    with pytest.raises(beeline.FileError, match="no_such_folder"):
        beeline.Trajectory(["a"], [0], [[0]]).save(tmp_path / "no_such_folder" / "motion.csv")


def test_columns_are_matched_by_name(rng):
    names = PANDA.joint_names
    given = beeline.Trajectory(names[::-1], [0, 1], rng.uniform(-1, 1, (2, 7)))
    matched = given.matched_to(PANDA)
    assert matched.joint_names == names
    assert np.array_equal(matched.positions, given.positions[:, ::-1])
    with pytest.raises(beeline.Error, match="lacks joint7"):
        beeline.Trajectory(names[:6], [0], np.zeros((1, 6))).matched_to(PANDA)


def test_slowed_down_within_limits(rng):
    q = PANDA.middle + rng.uniform(-0.5, 0.5, (5, 7))
    fast = beeline.Trajectory(PANDA.joint_names, np.arange(5) / 100, q, np.zeros_like(q), np.zeros_like(q))
    used = beeline.limit_usage(PANDA, fast)
    assert used.velocity.fraction > 1 and used.velocity.exact and used.jerk.exact
    k = beeline.slowdown_factor(used.velocity.fraction, used.acceleration.fraction, used.jerk.fraction)
    slow = beeline.limit_usage(PANDA, beeline.slow_down(fast, k))
    assert max(slow.velocity.fraction, slow.acceleration.fraction, slow.jerk.fraction) == pytest.approx(1, abs=1e-9)
    assert beeline.slow_down(fast, 0.5) == fast
    dense = fast.sample(np.linspace(0, fast.duration, 5001)).velocity
    assert (np.abs(dense) / PANDA.velocity).max() == pytest.approx(used.velocity.fraction, rel=1e-4)


def test_the_difference_of_two_trajectories(rng):
    q = PANDA.middle + rng.uniform(-0.3, 0.3, (2, 7))
    a = beeline.Trajectory(PANDA.joint_names, [0, 1], q)
    b = beeline.Trajectory(PANDA.joint_names, [5, 6.5], q)  # each from its own first sample on
    same = beeline.difference(PANDA, a, a)
    assert max(same.largest_position, same.largest_orientation) < 1e-15 and same.longer == 0
    apart = beeline.difference(PANDA, a, b)
    assert apart.longer == 0.5 and apart.overlap == 1
    expected = np.abs(q[1] - q[0]) / 3  # at t = 1, b is at two thirds
    assert [joint.largest for joint in apart.joints] == pytest.approx(expected)


def test_copies_and_pickles_are_equal(trajectory):
    for other in (copy.copy(trajectory), copy.deepcopy(trajectory), pickle.loads(pickle.dumps(trajectory))):
        assert other == trajectory and other is not trajectory
    assert trajectory != beeline.slow_down(trajectory, 2)
    assert trajectory != "text" and not trajectory == None  # noqa: E711
    with pytest.raises(TypeError):
        hash(trajectory)


UR_NAMES = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]


def test_recordings_of_other_programs(tmp_path, rng):
    arm = beeline.arms.ur5e()
    assert UR_NAMES in {about.name: about for about in beeline.built_in_arms()}["ur5e"].joint_names
    q = rng.uniform(-1, 1, (4, 6))
    path = tmp_path / "log.txt"
    rows = [" ".join(map(repr, map(float, [1000 * k, *np.degrees(row)]))) for k, row in enumerate(q)]
    path.write_text("\n".join(["time " + " ".join(UR_NAMES), *rows]) + "\n")
    read = beeline.Trajectory.load(path, arm, angle_unit="degrees", time_unit="ms")
    assert np.array_equal(read.times, range(4)) and read.joint_names == arm.joint_names
    assert np.abs(read.positions - q).max() < 1e-14
    raw = beeline.Trajectory.load(path)
    assert raw.joint_names == UR_NAMES
    assert np.array_equal(raw.matched_to(arm, angle_unit="degrees").positions, read.positions)
    for call in (beeline.Trajectory.load, beeline.read_recording):
        with pytest.raises(TypeError, match="the keyword unit is called angle_unit"):
            call(path, arm, unit="degrees")
    with pytest.raises(TypeError, match="the keyword unit is called angle_unit"):
        raw.matched_to(arm, unit="degrees")
    with pytest.raises(beeline.Error, match="joint_map, angle_unit and time_unit need an arm"):
        beeline.Trajectory.load(path, angle_unit="degrees")


def test_joint_maps(tmp_path, rng):
    arm = beeline.Arm.from_string("RRR:1,1,1")
    q = rng.uniform(-1, 1, (3, 4))
    given = beeline.Trajectory(["x", "a", "b", "c"], range(3), q, q)
    path = tmp_path / "log.csv"
    given.save(path)
    expected = np.stack([q[:, 3], -q[:, 1], 2 * (q[:, 2] + 0.5)], axis=1)
    joints = ["c", "-a", beeline.MappedJoint("b", offset=0.5, unit=2)]
    for read in (given.matched_to(arm, joint_map=joints), beeline.Trajectory.load(path, arm, joint_map=joints)):
        assert np.allclose(read.positions, expected, atol=1e-15, rtol=0)
        assert np.allclose(read.velocities, expected - [0, 0, 1], atol=1e-15, rtol=0)
    assert np.array_equal(given.matched_to(arm, joint_map="c,-a,b").positions, q[:, [3, 1, 2]] * [1, -1, 1])
    file = tmp_path / "map.json"
    file.write_text('{"joint1": "c", "joint2": {"name": "a", "sign": -1}, "joint3": "b"}')
    assert given.matched_to(arm, joint_map=str(file)) == given.matched_to(arm, joint_map="c,-a,b")
    for wrong in (["c", "a"], ["c", "a", "d"], ["c", "a", ""], "c,a", "none.json"):
        with pytest.raises(beeline.Error):
            given.matched_to(arm, joint_map=wrong)
    with pytest.raises(TypeError):
        given.matched_to(arm, joint_map=3)


def test_notes_of_recordings_are_data_and_warnings(tmp_path):
    arm = beeline.Arm.load("ur5e")
    names = ",".join(f"joint{i}" for i in range(1, 7))
    path = tmp_path / "log.csv"
    path.write_text(f"sec,nanosec,{names}\n1700000000,5,-90,-45,90,10,20,30\n1700000001,5,-91,-45,90,10,20,30\n")
    with pytest.warns(beeline.RecordingWarning) as issued:
        recording = beeline.read_recording(path, arm)
    assert [note.kind for note in recording.notes] == ["times_since_1970", "likely_degrees"]
    epoch, degrees = recording.notes
    assert epoch.columns == ["sec", "nanosec"] and epoch.time_unit == "s" and epoch.joint_unit is None and epoch.path == str(path)
    assert degrees.joint == "joint1" and degrees.value == -91
    assert [warning.message.note for warning in issued] == recording.notes
    assert [str(note) for note in recording.notes] == [str(warning.message) for warning in issued]
    assert "count from the first sample" in str(issued[0].message)
    assert str(issued[1].message).endswith('out of range in radians but not in degrees; angle_unit="degrees" reads degrees')
    assert recording.has_times and not recording.mapped and not recording.in_time_unit
    with pytest.warns(beeline.RecordingWarning) as issued:
        loaded = beeline.Trajectory.load(path, arm)
    assert len(issued) == 2 and np.array_equal(loaded.positions, recording.trajectory.positions)
    with pytest.warns(beeline.RecordingWarning, match="is read in degrees"):
        detected = beeline.read_recording(path, arm, detect_degrees=True)
    with pytest.warns(beeline.RecordingWarning) as issued:
        given = beeline.read_recording(path, arm, angle_unit="degrees")
    assert [note.kind for note in given.notes] == ["times_since_1970"]
    assert np.allclose(given.trajectory.positions, detected.trajectory.positions, rtol=0, atol=1e-15)
    with pytest.raises(beeline.FileError, match="sec and nanosec are seconds and nanoseconds"):
        beeline.read_recording(path, arm, time_unit="ms")


def test_units_in_names_of_columns(tmp_path, rng):
    arm = beeline.Arm.from_string("RRR:1,1,1")
    q = rng.uniform(-1, 1, (3, 3))
    path = tmp_path / "log.csv"
    given = beeline.Trajectory([f"{name}_deg" for name in arm.joint_names], range(3), q, 2 * q)
    given.save(path)
    for unit in ("radians", "degrees"):
        with pytest.warns(beeline.RecordingWarning, match="are read in deg, as their names say"):
            read = beeline.read_recording(path, arm, angle_unit=unit)
        (note,) = read.notes
        assert note.kind == "named_unit" and note.joint_unit == "deg" and note.columns == given.joint_names
        assert np.allclose(read.trajectory.positions, np.radians(q), rtol=0, atol=1e-15)
        assert np.allclose(read.trajectory.velocities, np.radians(2 * q), rtol=0, atol=1e-15)
    assert beeline.Trajectory.load(path) == given
    beeline.Trajectory(arm.joint_names, range(3), q).save(path)
    with pytest.warns(beeline.RecordingWarning, match='; angle_unit="degrees" reads degrees'):
        (note,) = beeline.read_recording(path, arm, detect_degrees=True).notes
    assert note.kind == "read_in_radians"


def test_wrapped_values_are_unwrapped():
    arm = beeline.Arm.from_string("RR:1,1")
    q = np.stack([2.9 + 0.05 * np.arange(21), np.zeros(21)], axis=1)
    recorded = beeline.Trajectory(arm.joint_names, 0.1 * np.arange(21), np.remainder(q + np.pi, 2 * np.pi) - np.pi)
    turned = recorded.unwrapped(arm)
    assert np.allclose(turned.trajectory.positions, q, atol=1e-12, rtol=0)
    assert [(joint.joint, joint.wraps) for joint in turned.joints] == [("joint1", 1)]
    assert turned.joints[0].first_time == pytest.approx(0.5)
    for result in (beeline.replay(arm, recorded), beeline.retime(arm, recorded)):
        assert result and result.unwrapped == turned.joints
        assert result.trajectory.positions[-1] == pytest.approx(q[-1])
    for result in (beeline.replay(arm, recorded, no_unwrap=True), beeline.retime(arm, recorded, no_unwrap=True)):
        assert result and result.unwrapped == []
        assert result.trajectory.positions[-1] == pytest.approx(recorded.positions[-1])


REFUSED = [
    ((["a"], [0, 0], [[1], [2]]), "does not increase at sample 2"),
    ((["a"], [1, 0], [[1], [2]]), "does not increase at sample 2"),
    ((["a"], [0, np.nan], [[1], [2]]), "does not increase"),
    ((["a"], [0, 1], [[1], [np.nan]]), "sample 2 .* finite positions"),
    ((["a"], [0, 1], [[1], [np.inf]]), "sample 2 .* finite positions"),
    ((["a"], [0, 1], [[1]]), "2 times has 1 positions"),
    ((["a"], [0, 1], [1, 2]), "positions has the shape"),
    ((["a", "a"], [0], [[1, 2]]), "two joints"),
    ((["a", "b"], [0], [[1]]), "needs 2 finite positions"),
    ((["a"], [0], [[1]], [[1, 2]]), "velocities"),
    ((["a"], [0], [[1]], None, [[1]]), "without velocities"),
    ((["a"], [[0]], [[1]]), "times has the shape"),
]


@pytest.mark.parametrize("arguments, message", REFUSED)
def test_invalid_columns_are_refused(arguments, message):
    with pytest.raises(beeline.Error, match=message):
        beeline.Trajectory(*arguments)


@pytest.mark.parametrize("arguments", [(3, [0], [[1]]), (["a"], "x", [[1]]), ([1], [0], [[1]]), (["a"], [0], [["x"]]),
                                       (["a"], [0], [[1j]]), (["a"], [0], [[1], [1, 2]]), (), (["a"],)])
def test_wrong_types_are_refused(arguments):
    with pytest.raises(TypeError):
        beeline.Trajectory(*arguments)


def test_invalid_times_are_refused(trajectory):
    with pytest.raises(beeline.Error, match="NaN"):
        trajectory.sample([0, np.nan])
    with pytest.raises(beeline.Error, match="unknown side"):
        trajectory.sample(0, side="middle")
    with pytest.raises(beeline.Error, match="no samples"):
        beeline.Trajectory([], [], []).sample(0)
    with pytest.raises(beeline.Error, match="k is not finite"):
        beeline.slow_down(trajectory, np.inf)


def test_a_pickle_that_was_changed_is_refused(trajectory):
    state = list(trajectory.__getstate__())
    state[1] = state[1][::-1]
    with pytest.raises(beeline.Error, match="does not increase"):
        beeline.Trajectory.__new__(beeline.Trajectory).__setstate__(tuple(state))
    with pytest.raises(beeline.Error, match="another number"):
        beeline.Trajectory.__new__(beeline.Trajectory).__setstate__(())
