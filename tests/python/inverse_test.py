"""Inverse kinematics: solutions reach their poses; options, records, batches, solvers and threads."""

import copy
import pickle
import threading

import beeline
import numpy as np
import pytest

ARMS = ["rrr", "scara", "stanford", "puma560", "ur5", "panda", "iiwa14"]


@pytest.fixture(params=ARMS)
def arm(request):
    return beeline.Arm.load(request.param)


def reachable(arm, rng, count):
    q = rng.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3), (count, arm.dof))
    return q, beeline.forward_kinematics(arm, q)


def test_solutions_reach_the_pose(arm, rng):
    for q, pose in zip(*reachable(arm, rng, 20)):
        result = beeline.inverse_kinematics(arm, pose)
        assert result and result.status == "solved" and result.nearest is None
        assert np.abs(beeline.forward_kinematics(arm, result.q) - pose).max() < 1e-9
        assert np.array_equal(result.q, result.solutions[0])
        assert not arm.limit_violations(result.q)
        near = beeline.inverse_kinematics(arm, pose, seed=q, redundancy="nearest")
        assert np.linalg.norm(near.q - q) < 1e-3
        assert pickle.loads(pickle.dumps(result)) == result == copy.deepcopy(result)


def test_the_default_with_a_seed_is_near_it(rng):
    """Poses 5 mm apart: as near as the nearest of all, in one call, into an array and in a batch."""
    arm = beeline.arms.panda()
    seeds, poses = reachable(arm, rng, 100)
    poses[:, :3, 3] += 0.005 * np.array([0.6, 0, 0.8])
    out, compared = np.empty(7), 0
    batch = beeline.batch_inverse(arm, poses, seed=seeds).q
    for seed, pose, row in zip(seeds, poses, batch):
        nearest = beeline.inverse_kinematics(arm, pose, seed=seed, redundancy="nearest")
        if not nearest or np.linalg.norm(nearest.q - seed) > 0.1:
            continue
        compared += 1
        found = beeline.inverse_kinematics(arm, pose, seed=seed)
        beeline.inverse_kinematics(arm, pose, seed=seed, out=out)
        assert np.linalg.norm(found.q - seed) < 0.3  # no jump
        assert np.allclose(found.q, out, atol=1e-9) and np.allclose(found.q, row, atol=1e-9)
    assert compared > 60
    without, any_of_them = (beeline.batch_inverse(arm, poses, **more).q for more in ({}, {"redundancy": "any"}))
    assert np.array_equal(without, any_of_them, equal_nan=True)
    assert np.nanmax(np.abs(without - batch)) > 0.1


def test_all_solutions_of_a_redundant_arm_on_a_grid(rng):
    arm = beeline.Arm.load("panda")
    _, (pose,) = reachable(arm, rng, 1)
    grid = beeline.inverse_kinematics(arm, pose, all=True, grid=11).grid
    assert grid.joint == 6 and len(grid.values) == 11 and set(grid.complete) <= set(grid.values)
    assert beeline.inverse_kinematics(arm, pose).grid is None


def test_all_solutions(arm, rng):
    for q, pose in zip(*reachable(arm, rng, 5)):
        result = beeline.inverse_kinematics(arm, pose, all=True, seed=q)
        distances = np.linalg.norm(result.solutions - q, axis=1)
        assert np.all(np.diff(distances) > -1e-12)
        poses = beeline.forward_kinematics(arm, result.solutions)
        assert np.abs(poses - pose).max() < 1e-8
        assert result.solutions.shape[1] == arm.dof and not result.solutions.flags.writeable


def test_options_have_the_names_of_the_library(rng):
    arm = beeline.arms.panda()
    q, poses = reachable(arm, rng, 1)
    locked = beeline.inverse_kinematics(arm, poses[0], seed=q[0], lock=6)
    assert locked and locked.q[6] == pytest.approx(q[0][6], abs=1e-12)
    position = beeline.inverse_kinematics(arm, poses[0], task="position")
    assert position and np.abs(beeline.forward_kinematics(arm, position.q)[:3, 3] - poses[0][:3, 3]).max() < 1e-9
    numerical = beeline.inverse_kinematics(arm, poses[0], method="numerical", random_seed=3)
    assert numerical.method.startswith("numerical")
    ended = beeline.inverse_kinematics(arm, poses[0], method="numerical", all=True, max_work=1)
    assert not ended and ended.status == "work_limit" and ended.reason
    stopped = beeline.inverse_kinematics(arm, poses[0], method="numerical", time_limit=0)
    assert stopped.status in ("time_limit", "solved")


def test_negative_answers_have_reasons(arm):
    pose = np.eye(4)
    pose[:3, 3] = arm.reach[0] + [3 * arm.reach[1] if np.isfinite(arm.reach[1]) else 99, 0, 0]
    result = beeline.inverse_kinematics(arm, pose)
    assert not result and result.q is None and result.solutions.size == 0
    assert result.status in ("unreachable", "outside_limits") and result.reason
    assert result.nearest.error.position > 0 and result.nearest.q.shape == (arm.dof,)
    assert repr(result).startswith(f"InverseResult(status='{result.status}'")


@pytest.mark.parametrize("used", ["nearest", "residual", "reason", "equal", "pickle", "copy", "text"])
def test_the_nearest_configuration_is_found_by_its_first_use(used):
    arm = beeline.arms.panda()
    folded = beeline.forward_kinematics(arm, [0, 3, 0, 0.5, 0, 3, 0])
    far, turned = (beeline.make_pose(xyz) for xyz in ([2, 0, 0], [0.3, 0.2, -0.4]))
    for pose, status in ((far, "unreachable"), (turned, "orientation_unreachable"), (folded, "outside_limits")):
        result, other = (beeline.inverse_kinematics(arm, pose) for _ in range(2))
        assert not result and result.status == status
        if used == "equal":
            assert result == other
        elif used == "pickle":
            result = pickle.loads(pickle.dumps(result))
        elif used == "copy":
            result = copy.deepcopy(result)
        elif used == "text":
            assert str(result) == str(other) and repr(result) == repr(other)
        else:
            getattr(result, used)
        assert result.residual == other.residual > 0
        assert (result.nearest.q == other.nearest.q).all()
        assert result.reason == other.reason and result.reason.fields == other.reason.fields
        assert result == other and result.status == other.status
        if result.status == "unreachable":
            assert result.reason.fields["nearest"] == list(result.nearest.world_T_tool[:3, 3])


def test_one_solution_is_written_into_an_array(arm, rng):
    q, poses = reachable(arm, rng, 20)
    for seed, pose in zip(q, poses):
        result = np.empty(arm.dof)
        assert beeline.inverse_kinematics(arm, pose, seed=seed, out=result, max_restarts=50) == 1
        assert np.abs(beeline.forward_kinematics(arm, result) - pose).max() < 1e-8
        assert arm.inverse_kinematics(pose, out=result) == 1
        method = beeline.inverse_kinematics(arm, pose).method
        assert method in (beeline.inverse_method(arm), "numerical")
    assert beeline.inverse_method(arm, method="numerical") == arm.inverse_method(method="numerical") == "numerical"


def test_solutions_are_written_into_arrays(rng):
    arm = beeline.arms.ur5()
    (q,), (pose,) = reachable(arm, rng, 1)
    expected = beeline.inverse_kinematics(arm, pose, seed=q, all=True).solutions
    for out in (np.empty((64, 6)), np.empty((64, 6), order="F"), np.empty((128, 12))[::2, ::2]):
        count = beeline.inverse_kinematics(arm, pose, seed=q, all=True, out=out)
        assert count == len(expected) and np.abs(out[:count] - expected).max() < 1e-9
        assert np.isnan(out[count:]).all()
    assert beeline.inverse_kinematics(arm, beeline.make_pose([9, 9, 9]), seed=q, all=True, out=out) == 0
    assert np.isnan(out).all()


def test_a_batch_is_its_poses_one_by_one(arm, rng):
    q, poses = reachable(arm, rng, 60)
    poses[7, 0, 3] = np.nan
    poses[8] = beeline.make_pose([99, 0, 0])
    result = beeline.batch_inverse(arm, poses)
    assert not result and result.solved == 58 and result.computed == 60 and result.ending == "complete"
    assert np.flatnonzero(~result.has_solution).tolist() == [7, 8] and np.isnan(result.q[7:9]).all()
    for pose, found in zip(poses[result.has_solution], result.q[result.has_solution]):
        one = np.empty(arm.dof)
        assert beeline.inverse_kinematics(arm, pose, out=one) == 1
        assert np.array_equal(one, found)
    assert np.array_equal(beeline.batch_inverse(arm, poses, threads=1).q, result.q, equal_nan=True)
    good = poses[9:].copy()
    whole = beeline.batch_inverse(arm, good)
    assert whole and pickle.loads(pickle.dumps(whole)) == whole == copy.copy(whole)
    for same in (good.tolist(), list(good), np.asfortranarray(good), good[::-1].copy()[::-1]):
        assert np.array_equal(beeline.batch_inverse(arm, same).q, whole.q)
    grid = beeline.batch_inverse(arm, good[:50].reshape(5, 10, 4, 4))
    assert grid.q.shape == (5, 10, arm.dof) and np.array_equal(grid.q.reshape(50, -1), whole.q[:50])
    assert grid.has_solution.shape == (5, 10)
    seven = beeline.forward_kinematics(arm, q[9:], layout="position_quaternion")
    other = beeline.batch_inverse(arm, seven, layout="position_quaternion")
    assert other.solved == 51
    seeded = beeline.batch_inverse(arm, good, seed=q[9:], redundancy="nearest")
    assert np.linalg.norm(seeded.q - q[9:], axis=1).max() < 1e-3
    out = np.empty((51, arm.dof))
    assert beeline.batch_inverse(arm, good, out=out).q is out


def test_a_budget_ends_a_batch(rng):
    arm = beeline.arms.panda()
    _, poses = reachable(arm, rng, 200)
    result = beeline.batch_inverse(arm, poses, max_work=100, method="numerical")
    assert not result and result.ending == "work_limit" and result.computed < 200
    assert np.count_nonzero(result.has_solution) == result.solved
    assert beeline.batch_inverse(arm, poses[:0]).q.shape == (0, 7)
    assert beeline.batch_inverse(arm, [])


def test_threads_call_at_once(rng):
    arm = beeline.arms.panda()
    q, poses = reachable(arm, rng, 200)
    expected = [beeline.inverse_kinematics(arm, pose) for pose in poses]
    kinematics = beeline.jacobian(arm, q)
    wrong = []

    def work():
        for row, pose, result, columns in zip(q, poses, expected, kinematics):
            if beeline.inverse_kinematics(arm, pose) != result or np.abs(beeline.jacobian(arm, row) - columns).max() > 1e-12:
                wrong.append(row)
        if np.abs(beeline.forward_kinematics(arm, q) - poses).max() != 0:
            wrong.append("batch")

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def model_among_balls(arm, rng, balls):
    size = arm.reach[1]
    links = [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.03 * size))]) for i in range(1, len(arm.joints) + 1)]
    obstacles = []
    for i in range(balls):
        pose = np.eye(4)
        pose[:3, 3] = rng.uniform(-0.5, 0.5, 3) * size
        obstacles.append(beeline.Obstacle(f"ball{i}", [beeline.Shape(beeline.Sphere(0.1 * size), pose)]))
    return beeline.CollisionModel(arm, links, beeline.Scene(obstacles), clearance=0.01 * size, max_work=10)


@pytest.mark.parametrize("name", ["rrr", "ur5", "panda"])
def test_solutions_that_are_blocked(name, rng):
    arm = beeline.Arm.load(name)
    free = blocked = 0
    for _ in range(6):
        model = model_among_balls(arm, rng, 6)
        q, poses = reachable(arm, rng, 4)
        for pose in poses:
            every = beeline.inverse_kinematics(arm, pose, all=True, grid=8)
            result = beeline.inverse_kinematics(arm, pose, all=True, grid=8, blocked_by=model)
            together = [*map(tuple, result.solutions), *(tuple(one.q) for one in result.blocked)]
            assert sorted(together) == sorted(map(tuple, every.solutions))
            for solution in result.solutions:
                nearest = beeline.nearest_pair(model, solution)
                assert nearest.lower >= nearest.clearance and not beeline.blocked_by(model, solution)
            for one in result.blocked:
                assert one.reason and one.reason == beeline.blocked_by(model, one.q)
                assert one.reason.fields["clearance"] > beeline.nearest_pair(model, one.q).lower
                assert one.reason.code in ("bodies_collide", "bodies_too_close", "clearance_not_decided")
            single = beeline.inverse_kinematics(arm, pose, blocked_by=model, grid=8)
            assert bool(single) == (len(result.solutions) > 0) or (name == "panda" and single)
            assert single.status in ("solved", "blocked")
            assert pickle.loads(pickle.dumps(result)) == result
            free, blocked = free + len(result.solutions), blocked + len(result.blocked)
        batch = beeline.batch_inverse(arm, poses, blocked_by=model, grid=8)
        for pose, row in zip(poses, batch.q):
            one = beeline.inverse_kinematics(arm, pose, blocked_by=model, grid=8)
            assert np.array_equal(row, one.q) if one else np.isnan(row).all()
    assert free and blocked


def test_a_model_of_another_arm_blocks_nothing_by_mistake(rng):
    arm, other = beeline.arms.ur5(), beeline.arms.ur5e()
    model = model_among_balls(other, rng, 1)
    pose = beeline.forward_kinematics(arm, arm.middle)
    for call in (lambda: beeline.inverse_kinematics(arm, pose, blocked_by=model),
                 lambda: beeline.inverse_kinematics(arm, pose, blocked_by=model, out=np.empty(arm.dof)),
                 lambda: beeline.batch_inverse(arm, [pose], blocked_by=model),
                 lambda: beeline.move_in_lines(arm, None, [pose, pose], blocked_by=model)):
        with pytest.raises(beeline.Error, match="another arm"):
            call()
    with pytest.raises(TypeError, match="blocked_by"):
        beeline.inverse_kinematics(arm, pose, blocked_by="scene.json")
    assert beeline.inverse_kinematics(arm, pose, blocked_by=None)
