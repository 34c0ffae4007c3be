"""Kinematics of one configuration and of many: laws, and every shape, dtype, order and stride of arrays."""


import beeline
import numpy as np
import pytest

ARMS = ["rrr", "rp", "gantry", "scara", "stanford", "puma560", "ur5", "panda", "iiwa14"]


@pytest.fixture(params=ARMS)
def arm(request):
    return beeline.Arm.load(request.param)


# Functions of the batch kernels: the inner shape of their results.
def batch_functions(arm):
    links = len(arm.joints) + 1
    return [
        (beeline.forward_kinematics, {}, (4, 4)),
        (beeline.forward_kinematics, {"layout": "position_quaternion"}, (7,)),
        (beeline.link_poses, {}, (links, 4, 4)),
        (beeline.link_poses, {"layout": "position_quaternion"}, (links, 7)),
        (beeline.jacobian, {}, (6, arm.dof)),
        (beeline.jacobian, {"frame": "tool"}, (6, arm.dof)),
        (beeline.jacobian, {"frame": "space"}, (6, arm.dof)),
        (beeline.manipulability, {}, ()),
    ]


def row_functions(arm):
    return [
        (beeline.task_jacobian, {"task": "110001:tool", "length_unit": 2}, (3, arm.dof)),
        (beeline.analytical_jacobian, {"coordinates": "quaternion"}, (7, arm.dof)),
        (beeline.joint_torques, {"wrench": [1, 2, 3, 4, 5, 6]}, (arm.dof,)),
        (beeline.jacobian_derivative, {"dq": np.arange(arm.dof)}, (6, arm.dof)),
        (beeline.hessian, {"frame": "tool"}, (arm.dof, 6, arm.dof)),
        (beeline.tool_acceleration, {"dq": np.arange(arm.dof), "ddq": np.ones(arm.dof)}, (6,)),
    ]


def test_a_batch_is_its_configurations_one_by_one(arm, rng):
    q = rng.uniform(-2, 2, (5, 11, arm.dof))
    for function, options, inner in batch_functions(arm) + row_functions(arm):
        many = function(arm, q, **options)
        assert many.shape == (5, 11, *inner) and many.dtype == np.float64
        for index in np.ndindex(5, 11):
            one = function(arm, q[index], **options)
            assert np.shape(one) == inner
            assert np.abs(many[index] - one).max() < 1e-12, function


def layouts(q):
    """The same numbers in memory of every kind, with what the results are compared by."""
    yield "C", q, 1e-12
    yield "Fortran", np.asfortranarray(q), 1e-12
    yield "negative strides", q[::-1, ::-1].copy()[::-1, ::-1], 1e-12
    yield "every other", np.repeat(np.repeat(q, 2, axis=0), 3, axis=1)[::2, ::3], 1e-12
    yield "another byte order", q.astype(q.dtype.newbyteorder()), 1e-12
    yield "read-only", np.frombuffer(q.tobytes()).reshape(q.shape), 1e-12
    unaligned = np.frombuffer(b"x" + q.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(q.shape)
    yield "unaligned", unaligned, 1e-12
    yield "lists", q.tolist(), 1e-12
    yield "tuples", tuple(map(tuple, q)), 1e-12
    yield "rows", list(q), 1e-12
    yield "subclass", q.view(np.recarray), 1e-12
    yield "masked", np.ma.array(q), 1e-12
    yield "broadcast", np.broadcast_to(q, (2, *q.shape))[1], 1e-12
    yield "half", q.astype(np.float16), 1e-2
    yield "single", q.astype(np.float32), 1e-5
    yield "single, Fortran", np.asfortranarray(q, np.float32), 1e-5


def test_every_layout_of_memory(arm, rng):
    q = rng.uniform(-2, 2, (37, arm.dof))
    for function, options, _ in batch_functions(arm)[::3] + row_functions(arm)[:2]:
        expected = function(arm, q, **options)
        for name, same, tolerance in layouts(q):
            results = function(arm, same, **options)
            assert np.abs(results - expected).max() < 10 * tolerance, name
            for one, reference in zip(same, expected):
                assert np.abs(function(arm, one, **options) - reference).max() < 10 * tolerance, name


def test_integers_are_numbers(arm):
    assert np.array_equal(beeline.jacobian(arm, [0] * arm.dof), beeline.jacobian(arm, np.zeros(arm.dof)))
    assert np.array_equal(
        beeline.forward_kinematics(arm, np.ones((3, arm.dof), np.int8)),
        beeline.forward_kinematics(arm, np.ones((3, arm.dof))),
    )


def test_single_precision_stays_single(arm, rng):
    for count in [(), (1,), (100,)]:
        q = rng.uniform(-2, 2, (*count, arm.dof)).astype(np.float32)
        for function, options, inner in batch_functions(arm):
            results = function(arm, q, **options)
            assert results.dtype == np.float32 and results.shape == (*count, *inner)
            assert np.abs(results - function(arm, q.astype(float), **options)).max() < 1e-4


def outputs(shape, dtype):
    yield np.empty(shape, dtype)
    yield np.empty(shape, dtype, order="F")
    if len(shape) >= 2:
        yield np.empty((*shape[:-2], shape[-1], shape[-2]), dtype).swapaxes(-1, -2)
    yield np.empty(tuple(2 * n for n in shape), dtype)[tuple(slice(None, None, 2) for _ in shape)]
    yield np.empty(shape, dtype)[tuple(slice(None, None, -1) for _ in shape)]


def test_results_are_written_into_arrays_of_every_layout(arm, rng):
    for q in (rng.uniform(-2, 2, arm.dof), rng.uniform(-2, 2, (20, arm.dof))):
        for function, options, _ in batch_functions(arm)[:-1] + row_functions(arm):
            expected = function(arm, q, **options)
            outs = [*outputs(expected.shape, float), np.empty_like(expected)]
            for out in outs:
                assert function(arm, q, out=out, **options) is out
                assert np.array_equal(out, expected)
    values = np.empty(20)
    assert beeline.manipulability(arm, q, out=values) is values
    assert np.array_equal(values, beeline.manipulability(arm, q))


def test_results_do_not_depend_on_the_threads(arm, rng):
    q = rng.uniform(-2, 2, (5000, arm.dof))
    for function, options, _ in batch_functions(arm):
        expected = function(arm, q, threads=1, **options)
        assert np.array_equal(function(arm, q, threads=2, **options), expected)
        assert np.array_equal(function(arm, q, **options), expected)


def test_bases_and_tools_of_each_row(arm, rng):
    def poses(count):
        return np.array([beeline.make_pose(p, rpy=r) for p, r in rng.uniform(-1, 1, (count, 2, 3))])

    q, bases, tools = rng.uniform(-2, 2, (30, arm.dof)), poses(30), poses(30)
    at = [beeline.Arm("moved", arm.joints, tool=t, base=b) for b, t in zip(bases, tools)]
    expected = np.array([beeline.forward_kinematics(a, row) for a, row in zip(at, q)])
    assert np.abs(beeline.forward_kinematics(arm, q, base=bases, tool=tools) - expected).max() < 1e-12
    assert np.abs(beeline.forward_kinematics(arm, q[3], base=bases[3], tool=tools[3]) - expected[3]).max() < 1e-12
    single = beeline.forward_kinematics(arm, q.astype(np.float32), base=bases, tool=list(tools))
    assert single.dtype == np.float32 and np.abs(single - expected).max() < 1e-4
    of_one = beeline.forward_kinematics(arm, q, tool=tools[0])
    assert np.abs(of_one - beeline.forward_kinematics(arm.with_tool(tools[0]), q)).max() < 1e-12
    seven = beeline.forward_kinematics(arm, q, base=bases, tool=tools, layout="position_quaternion")
    back = [beeline.make_pose(row[:3], quaternion=row[3:]) for row in seven]
    assert np.abs(np.array(back) - expected).max() < 1e-12
    with pytest.raises(beeline.Error, match="base: 2 poses for 30 configurations"):
        beeline.forward_kinematics(arm, q, base=bases[:2])


def test_derivatives_equal_differences(arm, rng):
    step = 1e-6
    for q, dq, ddq in rng.uniform(-1, 1, (5, 3, arm.dof)):
        for frame in ("base", "tool", "space"):
            ahead = beeline.jacobian(arm, q + step * dq, frame)
            behind = beeline.jacobian(arm, q - step * dq, frame)
            rate = beeline.jacobian_derivative(arm, q, dq, frame)
            assert np.abs((ahead - behind) / (2 * step) - rate).max() < 1e-7
            blocks = beeline.hessian(arm, q, frame)
            assert np.abs(np.einsum("kij,k->ij", blocks, dq) - rate).max() < 1e-11
            acceleration = beeline.tool_acceleration(arm, q, dq, ddq, frame)
            expected = beeline.jacobian(arm, q, frame) @ ddq + rate @ dq
            assert np.abs(acceleration - expected).max() < 1e-11


def test_links_and_torques_and_analytical_jacobians(arm, rng):
    for q in rng.uniform(-1, 1, (5, arm.dof)):
        links = beeline.link_poses(arm, q)
        assert np.abs(links[0] - arm.base).max() < 1e-15
        assert np.abs(links[-1] @ arm.tool - beeline.forward_kinematics(arm, q)).max() < 1e-13
        jacobian, wrench = beeline.jacobian(arm, q), rng.uniform(-1, 1, 6)
        assert np.abs(beeline.joint_torques(arm, q, wrench) - jacobian.T @ wrench).max() < 1e-13
        vector = beeline.analytical_jacobian(arm, q, "rotation-vector")
        assert np.abs(vector[:3] - jacobian[:3]).max() < 1e-13
        pose = beeline.forward_kinematics(arm, q)
        left = beeline.so3_left_jacobian(beeline.so3_log(pose))
        assert np.abs(left @ vector[3:] - jacobian[3:]).max() < 1e-9
        if arm.planar:
            rows = beeline.planar_jacobian(arm, q)
            assert np.array_equal(rows, jacobian[[0, 1, 5]])
            assert beeline.row_names(beeline.default_task(arm)) == ["x", "y", "theta"]
        else:
            with pytest.raises(beeline.Error, match="not planar"):
                beeline.planar_jacobian(arm, q)


def test_measures_equal_numpys(arm, rng):
    q = rng.uniform(-1, 1, (20, arm.dof))
    jacobians = beeline.jacobian(arm, q)
    rows = beeline.task_jacobian(arm, q)  # x, y, theta of a planar arm
    squares = np.linalg.det(rows @ rows.swapaxes(1, 2)) if arm.dof >= rows.shape[1] else np.zeros(20)
    assert np.abs(beeline.manipulability(arm, q) - np.sqrt(np.abs(squares))).max() < 1e-7
    for row, matrix in zip(q, jacobians):
        rows = matrix[:3, : max(3, arm.dof)]
        measures = beeline.manipulability_measures(rows)
        singular = np.linalg.svd(rows, compute_uv=False)
        assert np.abs(measures.singular_values - singular).max() < 1e-12
        ellipsoids = beeline.manipulability_ellipsoids(rows)
        velocity = ellipsoids.axes @ np.diag(ellipsoids.velocity**2) @ ellipsoids.axes.T
        assert np.abs(velocity - rows @ rows.T).max() < 1e-12
        gradient = beeline.manipulability_gradient(arm, row, "position")
        assert gradient.manipulability == pytest.approx(measures.manipulability, abs=1e-12)
        if gradient.manipulability > 1e-3:
            for k, step in enumerate(1e-6 * np.eye(arm.dof)):
                ahead = beeline.manipulability_gradient(arm, row + step, "position").manipulability
                behind = beeline.manipulability_gradient(arm, row - step, "position").manipulability
                assert (ahead - behind) / 2e-6 == pytest.approx(gradient.gradient[k], abs=1e-6)


def test_errors_of_tasks(arm, rng):
    q = rng.uniform(-1, 1, (2, arm.dof))
    desired, current = beeline.forward_kinematics(arm, q)
    whole = beeline.pose_error(desired, current)
    assert np.array_equal(whole, beeline.pose_difference(desired, current))
    assert np.array_equal(beeline.task_error("110000", desired, current), whole[:2])
    assert np.array_equal(beeline.task_rows("000111", whole), whole[3:])
    inside = beeline.pose_error(desired, current, "tool")
    assert np.abs(current[:3, :3] @ inside[:3] - whole[:3]).max() < 1e-13
    deviation = beeline.task_deviation("spatial", desired, current)
    assert deviation.position == pytest.approx(np.linalg.norm(whole[:3]))
    assert deviation.orientation == pytest.approx(np.linalg.norm(whole[3:]))
    assert beeline.within(deviation, deviation) and not beeline.within(deviation, beeline.Deviation(position=0, orientation=0))
    assert beeline.row_names("rpy") == ["x", "y", "z", "roll", "pitch", "yaw"]
