"""Segments, tool paths, routes, blends, and paths in joint space: laws at random poses, refusals."""

import copy
import pickle

import beeline
import numpy as np
import pytest

KINDS = ["line", "screw", "arc", "spline"]


def random_pose(rng):
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    pose = np.eye(4)
    pose[:3, :3] = rotation * np.linalg.det(rotation)
    pose[:3, 3] = rng.uniform(-1, 1, 3)
    return pose


def near_poses(rng, count):
    """Poses whose orientations are less than 1 rad apart."""
    poses = [random_pose(rng)]
    while len(poses) < count:
        pose = random_pose(rng)
        angle = np.arccos((np.trace(poses[-1][:3, :3].T @ pose[:3, :3]) - 1) / 2)
        if angle < 1:
            poses.append(pose)
    return np.array(poses)


@pytest.fixture(params=KINDS)
def path(request, rng):
    return beeline.path_through(near_poses(rng, 5), request.param)


def test_paths_pass_their_poses(rng):
    poses = near_poses(rng, 5)
    for kind in KINDS:
        path = beeline.path_through(poses, kind)
        passed = poses[::2] if kind == "arc" else poses
        s = np.arange(len(path.segments) + 1)
        assert np.abs(beeline.pose_at(path, s) - passed).max() < 1e-12, kind
    assert np.abs(beeline.pose_at(beeline.path_through(poses, "arc"), np.linspace(0, 1, 10001))[:, :3, 3]
                  - poses[1, :3, 3]).__pow__(2).sum(1).min() < 1e-6  # arcs pass the positions between


def test_motions_are_derivatives(path, rng):
    h = 1e-5
    for segment in path.segments:
        s = rng.uniform(0.1, 0.9)
        at = beeline.motion_at(segment, s)
        before, after = (beeline.motion_at(segment, s + step) for step in (-h, h))
        assert np.array_equal(at.pose, beeline.pose_at(segment, s))
        velocity = (after.pose[:3, 3] - before.pose[:3, 3]) / (2 * h)
        rate = (after.pose[:3, :3] - before.pose[:3, :3]) / (2 * h) @ at.pose[:3, :3].T
        turning = np.array([rate[2, 1], rate[0, 2], rate[1, 0]])
        assert np.abs(at.velocity - np.concatenate([velocity, turning])).max() < 1e-7
        assert np.abs(at.acceleration - (after.velocity - before.velocity) / (2 * h)).max() < 1e-6


def test_lengths_belong_to_the_origin(path):
    for segment in path.segments:
        origins = beeline.pose_at(segment, np.linspace(0, 1, 20001))[:, :3, 3]
        chords = np.linalg.norm(np.diff(origins, axis=0), axis=1).sum()
        assert beeline.length_of(segment) == pytest.approx(chords, rel=1e-6)


def test_reversed_is_the_path_from_its_end(path):
    s = np.linspace(0, len(path.segments), 37)
    back = path.reversed()
    assert np.abs(beeline.pose_at(back, len(path.segments) - s) - beeline.pose_at(path, s)).max() < 1e-9
    for segment in path.segments:
        again = segment.reversed()
        assert type(again) is type(segment)
        assert np.abs(beeline.pose_at(again, 0.3) - beeline.pose_at(segment, 0.7)).max() < 1e-9


def test_a_path_of_given_segments(path):
    assert beeline.ToolPath(path.segments, path.spans, path.names) == path
    made = beeline.ToolPath(segments=path.segments, names=["first"] + ["next"] * (len(path.segments) - 1))
    assert np.all(made.spans > 0) and made.segment_at(0.5) == 0
    assert made.span_to(len(made.segments)) == pytest.approx(made.spans.sum())
    if not isinstance(path.segments[0], beeline.SplineSegment):
        assert np.array_equal(made.spans, path.spans)


def test_routes_stop_at_corners(path, rng):
    kind = {beeline.Line: "line", beeline.ScrewLine: "screw", beeline.Arc: "arc", beeline.SplineSegment: "spline"}
    route = beeline.route_of(path, kind[type(path.segments[0])])
    inner = route.stops[:-1]
    assert not any(inner) if isinstance(path.segments[0], beeline.SplineSegment) else all(inner)
    assert [path.corner_at(i + 1) for i in range(len(inner))] == inner
    slower = beeline.Route(path, route.stops, speeds=[0.1] * len(route.stops))
    assert slower.path == path and np.all(slower.speeds == 0.1)


def test_blends_keep_their_tolerances(rng):
    poses = near_poses(rng, 4)
    within = beeline.Deviation(position=0.01, orientation=0.05)
    blended = beeline.blended_lines(poses, within)
    assert blended == beeline.blended_lines(poses, (0.01, 0.05)) == beeline.blended_lines(poses, [within, (0.01, 0.05)])
    assert len(blended.blends) == 2
    for blend in blended.blends:
        assert blend.corner_deviation.position <= 0.01 + 1e-12 and blend.line_deviation.position <= 0.01 + 1e-12
        assert blend.corner_deviation.orientation <= 0.05 + 1e-12
    assert beeline.route_of(blended).stops[:-1] == blended.stops[:-1]
    corners = [i for i, (a, b) in enumerate(zip(blended.path.segments, blended.path.segments[1:]))
               if blended.path.corner_at(i + 1)]
    assert not corners


def test_an_arc_through_three_positions(rng):
    a, b, c = near_poses(rng, 3)
    arc = beeline.arc_through(a, b[:3, 3], c)
    radius = np.linalg.norm(a[:3, 3] - arc.centre)
    for position in (b[:3, 3], c[:3, 3], *beeline.pose_at(arc, np.linspace(0, 1, 9))[:, :3, 3]):
        assert np.linalg.norm(position - arc.centre) == pytest.approx(radius)
    assert beeline.Arc(a, c, arc.centre, arc.rotation) == arc


def test_joint_splines_are_smooth_and_without_knots_beside_the_ends(rng):
    samples = rng.uniform(-1, 1, (9, 3))
    s = beeline.chord_length(samples)
    assert s == pytest.approx(np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(samples, axis=0), axis=1))]))
    path = beeline.joint_spline(samples, s)
    assert np.array_equal(path.q, samples) and np.array_equal(path.s, s)
    for k in range(1, 8):
        before, after = beeline.path_point(path, k - 1, 1), beeline.path_point(path, k, 0)
        assert before.q == pytest.approx(samples[k]) and after.q == pytest.approx(samples[k])
        for order in ("dq", "ddq") + (("dddq",) if k in (1, 7) else ()):
            scale = 1e-9 * max(1, np.abs(getattr(before, order)).max())
            assert np.abs(getattr(before, order) - getattr(after, order)).max() < scale, (k, order)


def test_refined_paths_are_the_same_path(rng):
    path = beeline.joint_spline(rng.uniform(-1, 1, (6, 2)), np.arange(6))
    fine = beeline.refined(path, min_steps=40, max_change=0.5)
    assert len(fine) > 40 and set(path.s) <= set(fine.s)
    k = rng.integers(0, len(fine) - 1)
    step = int(fine.s[k])
    assert fine.q[k] == pytest.approx(beeline.path_point(path, step, fine.s[k] - step).q)
    smooth = beeline.smooth_derivatives(path)
    assert np.array_equal(smooth.q, path.q) and not np.array_equal(smooth.dq, path.dq)


def test_copies_and_pickles_are_equal(path, rng):
    blended = beeline.blended_lines(near_poses(rng, 3), (0.01, 0.05))
    joints = beeline.joint_spline(rng.uniform(-1, 1, (5, 2)), np.arange(5))
    values = [path, *path.segments, beeline.Route(path, [True] * len(path.segments)), blended, blended.blends[0], joints,
              beeline.path_point(joints, 0, 0.5), beeline.motion_at(path.segments[0], 0.5), beeline.Deviation(1, 2)]
    for value in values:
        for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
            assert other == value and other is not value and repr(other) == repr(value)
        assert value != copy and value is not None and value != None  # noqa: E711


A, B = np.eye(4), np.eye(4)
B[0, 3] = 1
LINE = beeline.Line(A, B)
SPLINE = beeline.joint_spline([[0], [1], [3]], [0, 1, 2])
REFUSED = {
    "ends 1 m": lambda: beeline.ToolPath([LINE, LINE]),
    "0 of segment 1": lambda: beeline.ToolPath([LINE], [0]),
    "1 segments has 2 spans": lambda: beeline.ToolPath([LINE], [1, 1]),
    "no segments": lambda: beeline.pose_at(beeline.ToolPath([]), 0),
    "s is not finite": lambda: beeline.pose_at(LINE, [0, np.nan]),
    "segments has 2 stops": lambda: beeline.Route(beeline.ToolPath([LINE]), [True, False]),
    "at least two poses": lambda: beeline.path_through([A]),
    "unknown kind": lambda: beeline.path_through([A, B], "curve"),
    "first, last": lambda: beeline.path_through([A, B], "spline", last=np.full(6, np.inf)),
    "straight line": lambda: beeline.arc_through(A, [0.5, 0, 0], B),
    "passed has a value": lambda: beeline.arc_through(A, [0.5, 0, np.nan], B),
    "rotation must be above 0": lambda: beeline.Arc(A, B, [0, 0, 0], [0, 0, 0]),
    "at most 2 pi": lambda: beeline.Arc(A, B, [0, 0, 0], [0, 0, 7]),
    "terms has a value": lambda: beeline.SplineSegment(A, np.full((6, 6), np.nan)),
    "from_ is not a rigid": lambda: beeline.Line(2 * A, B),
    "to has the shape": lambda: beeline.Line(A, np.zeros((3, 4))),
    "as many tolerances": lambda: beeline.blended_lines([A, B, A], []),
    "does not increase": lambda: beeline.joint_spline([[0], [1]], [1, 0]),
    "two grid points": lambda: beeline.JointPath([0], [[0]], [[0]], [[0]]),
    "step 2 is not": lambda: beeline.path_point(SPLINE, 2, 0),
    "step must be a whole number": lambda: beeline.path_point(SPLINE, -1, 0),
    "must be above 0": lambda: beeline.refined(SPLINE, min_steps=0),
    "must be at most": lambda: beeline.refined(SPLINE, max_parts=2**31 - 1),
}


@pytest.mark.parametrize("message", REFUSED)
def test_invalid_arguments_are_refused(message):
    with pytest.raises(beeline.Error, match=message.replace("ends 1 m", "begins 1 m")):
        REFUSED[message]()


@pytest.mark.parametrize("call", [lambda: beeline.Line(A), lambda: beeline.Line(A, B, A), lambda: beeline.Line(A, to=A, from_=B),
                                  lambda: beeline.pose_at("line", 0), lambda: beeline.ToolPath([A]),
                                  lambda: beeline.Route(beeline.ToolPath([LINE]), "yes"), lambda: beeline.route_of(LINE),
                                  lambda: beeline.blended_lines([A, B, A], 0.01), lambda: beeline.Deviation(1, "a")])
def test_wrong_types_are_refused(call):
    with pytest.raises(TypeError):
        call()
