"""Lists of numbers are the arrays that numpy makes of them."""

import numpy as np
import pytest

import beeline

PANDA = beeline.arms.panda()
Q = PANDA.random(1, 20240229)[0]


@pytest.mark.parametrize("q", [
    Q.tolist(), tuple(Q.tolist()), list(Q), tuple(Q), [0, -0.5, 0, -2, 0, 1.5, 1], (0, 0, 0, -1, 0, 1, 0),
    [np.int64(0), 0.5, 0, -2, 0, np.float32(1.5), 1], [True, 0, 0, -1, 0, 1, 0], [np.array(0.1), 0, 0, -1, 0, 1, 0],
    [Q.tolist()] * 2, [Q, Q], [Q.tolist()] * 3, (tuple(Q), list(Q)), [[Q.tolist()] * 2] * 2, [[0.1] * 7],
])  # fmt: skip
def test_a_list_is_the_array_of_its_numbers(q):
    for function in (beeline.forward_kinematics, beeline.jacobian, beeline.manipulability):
        assert np.array_equal(function(PANDA, q), function(PANDA, np.array(q, float)))


def test_lists_of_every_size_are_arrays():
    for rows in range(1, 6):
        for columns in range(1, 9):
            numbers = np.random.default_rng(rows * columns).uniform(-1, 1, (rows, columns))
            joints = [f"joint{k}" for k in range(columns)]
            made = beeline.Trajectory(joints, list(range(rows)), numbers.tolist())
            assert np.array_equal(made.positions, numbers) and made.times.tolist() == list(range(rows))


@pytest.mark.parametrize("wrong", [
    [0.1] * 6, [0.1] * 8, [[0.1] * 7, [0.1] * 6], [[0.1] * 6, [0.1] * 7], [[0.1, 0.2], 0.3], [0.3, [0.1]], [[]], [[], []],
    ["1"] * 7, [0.1] * 6 + ["1"], [0.1] * 6 + [None], [0.1] * 6 + [1j], [0.1] * 6 + [object()], [0.1] * 6 + [10**400],
    [10**19] + [0.1] * 5 + ["1"], [], (),
])  # fmt: skip
def test_other_lists_are_refused_by_a_line_that_names_the_argument(wrong):
    with pytest.raises((TypeError, beeline.Error), match="^q") as error:
        beeline.forward_kinematics(PANDA, wrong)
    assert "\n" not in str(error.value)


def test_lists_with_values_that_are_none_are_refused():
    for value, text in ((np.nan, "nan"), (np.inf, "inf")):
        with pytest.raises(beeline.Error, match=f"the value of joint joint7 is {text}"):
            beeline.forward_kinematics(PANDA, [0.1] * 6 + [value])


def test_large_whole_numbers_are_read_as_numpy_reads_them():
    made = beeline.Trajectory(["a", "b"], [0, 2**53 + 1], [[2**63, -(2**63)], [2**64 - 1, 2**62 + 1]])
    assert made.positions.tolist() == [[2.0**63, -(2.0**63)], [2.0**64, 2.0**62]] and made.times[1] == 2.0**53


def test_lists_of_a_pose_are_the_pose():
    pose = beeline.forward_kinematics(PANDA, Q)
    for same in (pose.tolist(), tuple(map(tuple, pose)), [list(row) for row in pose], list(pose)):
        assert np.array_equal(beeline.checked_pose(same), beeline.checked_pose(pose))
