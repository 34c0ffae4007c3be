"""Input that does not fit: each call raises a clear error, and none crashes."""

import gc
import os
import pickle
import signal
import threading
import time

import beeline
import numpy as np
import pytest

PANDA = beeline.arms.panda()
POSE = beeline.forward_kinematics(PANDA, PANDA.middle)
Q = np.zeros(7)

MODEL = beeline.CollisionModel(
    PANDA, [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.1))]) for i in (3, 7)], max_work=0
)

CALLS = {
    "forward_kinematics": lambda q: beeline.forward_kinematics(PANDA, q),
    "link_poses": lambda q: beeline.link_poses(PANDA, q),
    "jacobian": lambda q: beeline.jacobian(PANDA, q),
    "manipulability": lambda q: beeline.manipulability(PANDA, q),
    "hessian": lambda q: beeline.hessian(PANDA, q),
    "task_jacobian": lambda q: beeline.task_jacobian(PANDA, q, "position"),
    "analytical_jacobian": lambda q: beeline.analytical_jacobian(PANDA, q, "rpy"),
    "joint_torques": lambda q: beeline.joint_torques(PANDA, q, np.zeros(6)),
    "derivative": lambda q: beeline.jacobian_derivative(PANDA, q, Q),
    "dq": lambda q: beeline.jacobian_derivative(PANDA, Q, q),
    "gradient": lambda q: beeline.manipulability_gradient(PANDA, q),
    "seed": lambda q: beeline.inverse_kinematics(PANDA, POSE, seed=q),
    "batch seed": lambda q: beeline.batch_inverse(PANDA, [POSE], seed=q),
    "nearest_pair": lambda q: beeline.nearest_pair(MODEL, q),
    "pairs_too_close": lambda q: beeline.pairs_too_close(MODEL, q),
    "blocked_by": lambda q: beeline.blocked_by(MODEL, q),
    "seed of out": lambda q: beeline.inverse_kinematics(PANDA, POSE, seed=q, out=np.empty(7)),
}


class Raises:
    def __array__(self, *args, **kwargs):
        raise RuntimeError("no array")


WITHIN_ITSELF = []
WITHIN_ITSELF.append(WITHIN_ITSELF)

WRONG = {
    "text": "home",
    "bytes": b"12345678",
    "number": 1.0,
    "dictionary": {"joint1": 0},
    "set": {1, 2, 3},
    "too few": np.zeros(6),
    "too many": np.zeros(8),
    "columns": np.zeros((7, 3)),
    "ragged": [[0] * 7, [0] * 6],
    "texts": ["0"] * 7,
    "objects": np.array([object()] * 7),
    "complex": np.zeros(7, complex),
    "times": np.zeros(7, "datetime64[s]"),
    "records": np.zeros(7, [("x", float)]),
    "nothing": [None] * 7,
    "empty": [],
    "no columns": np.zeros((3, 0)),
    "deep": np.zeros((1,) * 20 + (6,)),
    "within itself": WITHIN_ITSELF,
    "generator": (i for i in range(7)),
    "type": float,
    "raises": Raises(),
}


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("call", CALLS)
def test_what_is_no_configuration_is_refused(call, wrong):
    with pytest.raises((TypeError, beeline.Error, RuntimeError)) as error:
        CALLS[call](WRONG[wrong])
    assert str(error.value)


@pytest.mark.parametrize("call", CALLS)
def test_none_is_refused_or_means_the_default(call):
    if call in ("seed", "batch seed", "seed of out"):
        assert CALLS[call](None)
    else:
        with pytest.raises(TypeError, match=r"^\w+: expected numbers, not None$"):
            CALLS[call](None)


@pytest.mark.filterwarnings("ignore:Warning. converting a masked element")
@pytest.mark.parametrize("call", CALLS)
def test_masked_entries_are_refused(call):
    q = PANDA.middle
    mask = [False] * 6 + [True]
    for masked in (np.ma.array(q, mask=mask), [*q[:6], np.ma.masked], [np.ma.array([q, q], mask=[mask, mask])]):
        with pytest.raises(beeline.Error, match="masked"):
            CALLS[call](masked)
    CALLS[call](np.ma.array(q))


@pytest.mark.parametrize("function", ["forward_kinematics", "link_poses", "jacobian", "manipulability"])
def test_threads_are_checked_of_one_configuration_too(function):
    for q in (Q, [Q, Q]):
        with pytest.raises(beeline.Error, match="threads is -1"):
            getattr(beeline, function)(PANDA, q, threads=-1)
        with pytest.raises(TypeError, match="threads"):
            getattr(beeline, function)(PANDA, q, threads="2")


@pytest.mark.parametrize(
    "call, option",
    [
        (lambda: beeline.retime(PANDA, beeline.at_rest(PANDA, Q), spede_scale=1), "speed_scale"),
        (lambda: beeline.move_in_lines(PANDA, Q, [POSE], tolerence=1), "tolerance"),
        (lambda: beeline.control_joints(PANDA, Q, Q, kpp=1), "kp"),
        (lambda: beeline.Servo(PANDA, gian=1), "gain"),
        (lambda: beeline.Limits(lowr=1), "lower"),
    ],
)
def test_unknown_options_are_type_errors(call, option):
    with pytest.raises(TypeError, match=f'did you mean "{option}"'):
        call()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("call", CALLS)
def test_what_is_not_finite_is_refused(call, value):
    for dtype in (float, np.float32):
        q = np.full(7, value, dtype)
        with pytest.raises(beeline.Error, match="finite|nan|inf"):
            CALLS[call](q)


def test_rows_of_a_batch_that_are_not_finite_have_no_results():
    q = np.zeros((5, 7))
    q[2, 3] = np.nan
    for function in (beeline.forward_kinematics, beeline.jacobian, beeline.manipulability):
        for dtype in (float, np.float32):
            results = function(PANDA, q.astype(dtype)).reshape(5, -1)
            finite = np.isfinite(results).all(axis=1)
            assert finite.tolist() == [True, True, False, True, True]
    with pytest.raises(beeline.Error):
        beeline.hessian(PANDA, q)


def test_huge_and_extreme_numbers_do_not_crash():
    for value in (1e300, -1e300, 1e-320, 1e18):
        for call in CALLS.values():
            try:
                call(np.full(7, value))
            except beeline.Error:
                pass
    huge = np.broadcast_to(np.zeros(7), (2**50, 7))
    for call in CALLS.values():
        with pytest.raises((MemoryError, ValueError, TypeError)):
            call(huge)


def test_empty_batches_are_empty():
    for shape in [(0,), (3, 0), (0, 5)]:
        q = np.zeros((*shape, 7))
        assert beeline.forward_kinematics(PANDA, q).shape == (*shape, 4, 4)
        assert beeline.jacobian(PANDA, q, out=np.empty((*shape, 6, 7))).shape == (*shape, 6, 7)
        assert beeline.hessian(PANDA, q).shape == (*shape, 7, 6, 7)
        assert beeline.batch_inverse(PANDA, np.zeros((*shape, 4, 4))).q.shape == (*shape, 7)


def read_only(shape):
    array = np.empty(shape)
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    "out, error, message",
    [
        (np.empty((4, 3)), beeline.Error, r"out has the shape \(4, 3\); expected \(4, 4\)"),
        (np.empty((1, 4, 4)), beeline.Error, "shape"),
        (np.empty((4, 4), np.float32), TypeError, "out: expected an array of float64"),
        (np.empty((4, 4), int), TypeError, "float64"),
        (np.empty((4, 4), ">f8"), None, ""),
        ([[0.0] * 4] * 4, TypeError, "float64"),
        ("out", TypeError, "float64"),
        (read_only((4, 4)), beeline.Error, "out is read-only"),
        (np.broadcast_to(np.empty(4), (4, 4)), beeline.Error, "read-only"),
    ],
)
def test_arrays_for_results_that_do_not_fit(out, error, message):
    if error is None:
        assert np.array_equal(beeline.forward_kinematics(PANDA, Q, out=out), beeline.forward_kinematics(PANDA, Q))
        return
    with pytest.raises(error, match=message):
        beeline.forward_kinematics(PANDA, Q, out=out)


def test_results_are_not_written_over_their_configurations():
    memory = np.zeros((16 * 10,))
    q, out = memory[:70].reshape(10, 7), memory.reshape(10, 4, 4).swapaxes(1, 2)
    with pytest.raises(beeline.Error, match="out has memory of q"):
        beeline.forward_kinematics(PANDA, q, out=out)


@pytest.mark.parametrize(
    "call, error, message",
    [
        (lambda: beeline.jacobian(PANDA, Q, "bas"), beeline.Error, 'unknown frame "bas"; did you mean "base"'),
        (lambda: beeline.jacobian(PANDA, Q, 3), TypeError, "frame: expected text, not int"),
        (lambda: beeline.jacobian(PANDA, Q, "base\0"), beeline.Error, "frame"),
        (lambda: beeline.jacobian(PANDA, Q, "\ud800"), beeline.Error, "frame"),
        (lambda: beeline.jacobian("my.urdf", Q), TypeError, "^arm: expected an Arm, not"),
        (lambda: beeline.jacobian(None, Q), TypeError, "^arm: expected an Arm, not"),
        (lambda: beeline.forward_kinematics(PANDA, [Q, Q], threads=-1), beeline.Error, "threads is -1"),
        (lambda: beeline.forward_kinematics(PANDA, [Q, Q], threads=1.5), TypeError, "threads"),
        (lambda: beeline.forward_kinematics(PANDA, [Q, Q], threads=2**40), beeline.Error, "threads"),
        (lambda: beeline.forward_kinematics(PANDA, Q, base=np.zeros((4, 4))), beeline.Error, "base"),
        (lambda: beeline.forward_kinematics(PANDA, Q, tool="flange"), TypeError, "tool"),
        (lambda: beeline.forward_kinematics(PANDA, Q, layout="7"), beeline.Error, "layout"),
        (lambda: beeline.task_jacobian(PANDA, Q, "000000"), beeline.Error, "task"),
        (lambda: beeline.task_jacobian(PANDA, Q, "position", 0), beeline.Error, "length"),
        (lambda: beeline.joint_torques(PANDA, Q, np.zeros(5)), beeline.Error, r"wrench has the shape \(5,\)"),
        (lambda: beeline.joint_torques(PANDA, [Q, Q], np.zeros((3, 6))), beeline.Error, r"or \(2, 6\)"),
        (lambda: beeline.joint_torques(PANDA, Q, [0, 0, 0, 0, 0, np.nan]), beeline.Error, "finite"),
        (lambda: beeline.manipulability_measures(np.zeros((7, 7))), beeline.Error, "rows"),
        (lambda: beeline.manipulability_measures(np.zeros((0, 7))), beeline.Error, "empty|rows|Jacobian"),
        (lambda: beeline.manipulability_measures(Q), beeline.Error, "shape"),
        (lambda: beeline.inverse_kinematics(PANDA, np.zeros((3, 3))), beeline.Error, r"expected a pose \(4, 4\)"),
        (lambda: beeline.inverse_kinematics(PANDA, np.zeros((2, 3, 3))), beeline.Error, r"expected \(N, 4, 4\)"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, sed=Q), TypeError, 'did you mean "seed"'),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, lock=7), beeline.Error, "lock"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, lock="7"), TypeError, "lock"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, grid=0), beeline.Error, "grid"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, tolerance=0), beeline.Error, "tolerance"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, time_limit=-1), beeline.Error, "time_limit"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, random_seed=-1), beeline.Error, "random_seed"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, all=1), TypeError, "all: expected True or False"),
        (lambda: beeline.batch_inverse(PANDA, [POSE], progress=3), TypeError, "progress"),
        (lambda: beeline.batch_inverse(PANDA, np.zeros((3, 3))), beeline.Error, r"\(N, 4, 4\)"),
        (lambda: beeline.batch_inverse(PANDA, np.zeros((2, 4, 4))), beeline.Error, "pose"),
        (lambda: beeline.batch_inverse(PANDA, [POSE], seed=[Q, Q]), beeline.Error, "one for each pose"),
        (lambda: beeline.batch_inverse(PANDA, [POSE], threads="2"), TypeError, "threads"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, out=np.empty(6)), beeline.Error, r"out has the shape \(6,\)"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, out=np.empty((2, 2, 7))), beeline.Error, r"expected \(7,\) or"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, out=read_only(7)), beeline.Error, "read-only"),
        (lambda: beeline.inverse_kinematics(PANDA, POSE, out=[0.0] * 7), TypeError, "out"),
        (lambda: beeline.inverse_method(PANDA, method="closed"), beeline.Error, "closed_form"),
    ],
)
def test_options_that_do_not_fit(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_arrays_outlive_their_arm():
    arm = beeline.arms.panda()
    results = [beeline.jacobian(arm, np.zeros((100, 7))), arm.lower, arm.joints]
    expected = beeline.jacobian(arm, Q)
    del arm
    gc.collect()
    assert np.abs(results[0] - expected).max() < 1e-15
    assert len(results[1]) == len(results[2]) == 7


def test_pickles_that_are_cut_off_or_changed(rng):
    objects = [PANDA, beeline.inverse_kinematics(PANDA, POSE), beeline.Quaternion()]
    objects.append(beeline.batch_inverse(PANDA, [POSE]))
    for whole in map(pickle.dumps, objects):
        for _ in range(60):
            with pytest.raises(Exception):  # noqa: B017: pickle has many
                pickle.loads(whole[: rng.integers(len(whole) - 1)])
    for kind in map(type, objects):
        for state in [(), (1,), (1, 2), ("x",) * 4, ({},) * 10, None, "{}", 3]:
            with pytest.raises((TypeError, ValueError)):
                kind.__new__(kind).__setstate__(state)


@pytest.mark.filterwarnings("ignore:nanobind")
@pytest.mark.parametrize("kind", [beeline.Arm, beeline.InverseResult, beeline.Quaternion])
def test_objects_that_were_not_made(kind):
    empty = kind.__new__(kind)
    for use in (repr, pickle.dumps, lambda value: beeline.jacobian(value, Q)):
        with pytest.raises((TypeError, ValueError)):
            use(empty)


def test_interrupts_end_a_batch(rng):
    q = rng.uniform(-2, 2, (20000, 7))
    poses = beeline.forward_kinematics(PANDA, q)
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    begin = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        beeline.batch_inverse(PANDA, poses, method="numerical", tolerance=1e-300, max_restarts=10**6)
    print("ended after", time.monotonic() - begin, "s")


@pytest.mark.parametrize("kind", [beeline.Expression, beeline.ExpressionMatrix])
@pytest.mark.parametrize("state", [(), (PANDA,), ([],), (PANDA, [()]), (PANDA, 1, 1)])
def test_the_state_of_a_formula_cut_off_is_refused(kind, state):
    with pytest.raises((beeline.Error, TypeError)):
        kind.__new__(kind).__setstate__(state)
