"""beeline.plot in matplotlib, without a display: what the axes show, and refusals."""

import os

os.environ["MPLBACKEND"] = "Agg"

import numpy as np  # noqa: E402
import pytest  # noqa: E402

beeline = pytest.importorskip("beeline")
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402

from beeline import plot  # noqa: E402


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def motion(arm, with_velocities=True):
    t = np.linspace(0, 2, 9)
    amplitude = np.linspace(0.5, -0.4, arm.dof)
    q = beeline.display_configuration(arm) + np.sin(t)[:, None] * amplitude
    return beeline.Trajectory(arm.joint_names, t, q, np.cos(t)[:, None] * amplitude if with_velocities else None)


def points_of(line):
    return np.array(line.get_data_3d() if hasattr(line, "get_data_3d") else line.get_data()).T


@pytest.mark.parametrize("name", beeline.arms.names())
def test_every_built_in_arm(name, tmp_path):
    arm = beeline.Arm.load(name)
    q = beeline.display_configuration(arm)
    ax = plot.arm(arm, frames=True, jacobian=True, label="here")
    links = next(line for line in ax.lines if line.get_label() == "here")
    dimensions = 2 if arm.planar else 3
    tool = beeline.forward_kinematics(arm, q)[:dimensions, 3]
    assert np.allclose(points_of(links)[-1], tool)
    drawn = {tuple(np.round(point, 9) + 0.0) for point in points_of(links)}
    for pose in beeline.link_poses(arm, q):
        assert tuple(np.round(pose[:dimensions, 3], 9) + 0.0) in drawn
    for extent, value in zip((ax.get_xlim(), ax.get_ylim()), tool):
        assert extent[0] <= value <= extent[1]
    ax.figure.savefig(tmp_path / "arm.png")
    for draw in (plot.motion, plot.trail):
        draw(arm, motion(arm), waypoints=[beeline.forward_kinematics(arm, q)]).figure.savefig(tmp_path / "motion.png")


def test_the_trail_shows_the_motion_between_its_samples():
    arm = beeline.arms.panda()
    trajectory = motion(arm)
    ax = plot.trail(arm, trajectory, samples=33)
    exact = beeline.forward_kinematics(arm, trajectory.sample(np.linspace(0, 2, 33)).position)[:, :3, 3]
    shown = points_of(ax.lines[0])
    assert all(np.abs(shown - point).max(axis=1).min() < 1e-12 for point in exact)
    rows = plot.trail(arm, trajectory.positions)
    assert len(points_of(rows.lines[0])) == 9


def test_joint_curves_have_the_library_s_colours_and_the_arm_s_limits():
    arm = beeline.arms.panda()
    trajectory = motion(arm)
    axes = plot.joints(arm, trajectory)
    curves = [line for line in axes[0].lines if line.get_label() in arm.joint_names]
    assert [to_rgb(curve.get_color()) for curve in curves] == [beeline.distinct_colour(k) for k in range(7)]
    assert to_rgb(curves[0].get_color())[0] > 0.8 and to_rgb(curves[2].get_color())[2] > 0.7
    t = np.linspace(0, 1.99, 50)
    state = trajectory.sample(t)
    for ax, values in zip(axes, (state.position, state.velocity, state.acceleration)):
        line = ax.lines[3]
        assert np.abs(np.interp(t, *line.get_data()) - values[:, 3]).max() < 2e-3
    levels = {round(line.get_ydata()[0], 4) for line in axes[0].lines if line.get_linestyle() == "--"}
    assert levels == set(np.round(np.concatenate([arm.lower, arm.upper]), 4))
    assert len(plot.joints(trajectory)[0].lines) == 7
    former = plot.joints(trajectory, arm)
    assert [len(ax.lines) for ax in former] == [len(ax.lines) for ax in axes]


def test_a_linear_motion_has_steps():
    arm = beeline.arms.rrr()
    axes = plot.joints(arm, motion(arm, with_velocities=False))
    assert "by differences" in axes[2].get_ylabel()
    assert any(line.get_linestyle() == ":" for line in axes[1].lines)  # an assumed limit
    velocity = axes[1].lines[0].get_ydata()
    assert len(np.unique(np.round(velocity, 9))) == 8


@pytest.mark.parametrize("name", ["rrr", "panda"])
def test_an_animation_passes_the_whole_motion(name, tmp_path):
    arm = beeline.Arm.load(name)
    trajectory = motion(arm)
    moving = plot.animation(arm, trajectory, speed=2, fps=10)
    moving.save(tmp_path / "moving.gif", writer="pillow")
    assert (tmp_path / "moving.gif").stat().st_size > 1000
    ends = [points_of(moving._func(frame)[0])[-1] for frame in (0, 10)]
    poses = beeline.forward_kinematics(arm, trajectory.positions[[0, -1]])
    assert np.allclose(ends, poses[:, : len(ends[0]), 3])


def test_a_slice_of_a_reach_map(tmp_path):
    map = beeline.reach_map(beeline.arms.puma560(), resolution=0.4, directions=1.5)
    slice = beeline.slice_of(map, "y", 0.1, "margin")
    ax = plot.reach(slice)
    (mesh,) = ax.collections
    np.testing.assert_array_equal(np.ma.filled(mesh.get_array(), np.nan), slice.values.T)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "z [m]") and len(ax.figure.axes) == 2
    assert plot.reach(slice, ax, colorbar=False, cmap="magma", vmax=0.5) is ax and len(ax.figure.axes) == 2
    ax.figure.savefig(tmp_path / "slice.png")


def among_obstacles(name):
    arm = beeline.Arm.load(name)
    size = arm.reach[1]
    links = [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.03 * size))]) for i in range(1, len(arm.joints) + 1)]
    bodies = [beeline.Sphere(0.1 * size), beeline.Capsule(0.05 * size, 0.2 * size), beeline.Box([0.1 * size, 0.2 * size, 0.3 * size]),
              beeline.Cylinder(0.1 * size, 0.2 * size), beeline.ConvexHull(size / 5 * np.vstack([np.zeros(3), np.eye(3)]))]
    obstacles = []
    for i, body in enumerate(bodies):
        pose = np.eye(4)
        pose[:3, :3] = [[0, -1, 0], [0.6, 0, -0.8], [0.8, 0, 0.6]]
        pose[:3, 3] = size * np.array([np.cos(i), np.sin(i), 0.2])
        obstacles.append(beeline.Obstacle(f"body{i}", [beeline.Shape(body, pose, 0.01 * size)]))
    obstacles.append(beeline.Obstacle("floor", [beeline.Shape(beeline.HalfSpace())]))
    return beeline.CollisionModel(arm, links, beeline.Scene(obstacles))


def faces_in(ax):
    """The faces of the obstacles, and of the shapes of the links."""
    bodies = [drawn for drawn in ax.collections if drawn.get_label() == "_bodies"]
    return [drawn._faces if hasattr(drawn, "_faces") else [path.vertices for path in drawn.get_paths()] for drawn in bodies]


@pytest.mark.parametrize("name", ["rrr", "panda"])
def test_an_arm_among_obstacles(name, tmp_path):
    model = among_obstacles(name)
    arm, q = model.arm, beeline.display_configuration(model.arm)
    ax = plot.arm(model, q)
    obstacles, links = faces_in(ax)
    assert len(links) >= len(arm.joints) and len(obstacles) >= 6
    texts = [text.get_text() for text in ax.texts]
    assert [text for text in texts if text.startswith("body")] == [f"body{i}" for i in range(5)] and "floor" in texts
    pair = beeline.nearest_pair(model, q)
    (line,) = [line for line in ax.lines if line.get_label() == "_nearest"]
    dimensions = 2 if arm.planar else 3
    assert np.allclose(points_of(line), np.array([pair.on_first, pair.on_second])[:, :dimensions])
    assert any(text.strip().startswith(f"{pair.upper:.3g} m" if pair.lower > 0 else f"{-pair.lower:.3g} m") for text in texts)
    shown = np.concatenate([np.reshape(face, (-1, dimensions)) for face in links])
    for pose in beeline.link_poses(arm, q)[1:]:  # a sphere around each frame
        distances = np.linalg.norm(shown - pose[:dimensions, 3], axis=1)
        assert np.abs(distances - 0.03 * arm.reach[1]).min() < 1e-3 * arm.reach[1]
    ax.figure.savefig(tmp_path / "scene.png")
    assert len(faces_in(plot.arm(model, q, shapes=False))) == 1


@pytest.mark.parametrize("name", ["rrr", "panda"])
def test_point_clouds_are_drawn_as_far_as_they_are_near(name, tmp_path):
    arm = beeline.Arm.load(name)
    size, rng = arm.reach[1], np.random.default_rng(7)
    links = [beeline.LinkShapes("tip", len(arm.joints), [beeline.Shape(beeline.Sphere(0.03 * size))])]
    near = size * rng.uniform([0.5, -0.5, 0], [1, 0.5, 0.1], (12_000, 3))
    few, far = near[:100] + [0, 0, 0.2 * size], near + [9 * size, 0, 0]
    clouds = {"scan": near, "few": few, "far": far}
    scene = beeline.Scene([beeline.Obstacle(name, [], cloud=beeline.PointCloud(points, 0.01 * size))
                           for name, points in clouds.items()])
    ax = plot.arm(beeline.CollisionModel(arm, links, scene), np.zeros(len(arm.joints)))
    dimensions = 2 if arm.planar else 3
    shown = [np.column_stack(drawn._offsets3d) if dimensions == 3 else drawn.get_offsets()
             for drawn in ax.collections if drawn.get_label() == "_cloud"]
    np.testing.assert_allclose(shown[0], near[::3, :dimensions])  # at most 5,000
    np.testing.assert_allclose(shown[1], few[:, :dimensions])
    assert len(shown) == 2
    texts = [text.get_text() for text in ax.texts]
    assert "scan: 4000 of 12000 points" in texts and "few" in texts and not any("far" in text for text in texts)
    limits = np.array([ax.get_xlim(), ax.get_ylim()])
    assert np.all(limits[:, 0] < near[:, :2].min(axis=0)) and np.all(near[:, :2].max(axis=0) < limits[:, 1])
    ax.figure.savefig(tmp_path / "clouds.png")


def test_faces_are_on_the_surface_of_their_shape():
    from beeline._matplotlib_scene import Region, faces_of

    model = among_obstacles("panda")
    for obstacle in model.scene.obstacles[:5]:
        (shape,) = obstacle.shapes
        corners = faces_of(shape, Region(model)).reshape(-1, 3)
        assert len(corners) >= 16, obstacle.name
        for corner in np.unique(corners.round(9), axis=0)[::7]:
            place = np.eye(4)
            place[:3, 3] = corner
            at = beeline.LinkShapes("point", 1, [beeline.Shape(beeline.Sphere(1e-9), np.linalg.inv(
                beeline.link_poses(model.arm, np.zeros(7))[1]) @ place)])
            distance = beeline.nearest_pair(beeline.CollisionModel(model.arm, [at], beeline.Scene([obstacle])), np.zeros(7))
            assert abs(distance.upper) < 1e-6 and distance.lower < 1e-6, obstacle.name


@pytest.mark.parametrize("name", ["rrr", "panda"])
def test_a_motion_among_obstacles(name, tmp_path):
    model = among_obstacles(name)
    trajectory = motion(model.arm)
    ax = plot.motion(model, trajectory)
    times = np.linspace(trajectory.times[0], trajectory.times[-1], 201)
    pairs = [beeline.nearest_pair(model, q) for q in trajectory.sample(times).position]
    closest = min(pairs, key=lambda pair: (pair.upper if pair.lower > 0 else pair.lower) - pair.clearance)
    (line,) = [line for line in ax.lines if line.get_label() == "_nearest"]
    assert np.allclose(points_of(line)[0], closest.on_first[: 2 if model.arm.planar else 3], atol=1e-9)
    moving = plot.animation(model, trajectory, fps=3)
    moving.save(tmp_path / "moving.gif", writer="pillow")
    moving._func(0)
    first = faces_in(moving._fig.axes[0])[1]
    moving._func(2)
    second = faces_in(moving._fig.axes[0])[1]
    assert not np.allclose(np.concatenate([np.reshape(f, (-1, 2)) for f in first[:1]]),
                           np.concatenate([np.reshape(f, (-1, 2)) for f in second[:1]]))


def test_refusals():
    rrr, panda = beeline.arms.rrr(), beeline.arms.panda()
    with pytest.raises(ValueError, match="3d"):
        plot.arm(panda, ax=pyplot.figure().add_subplot())
    with pytest.raises(ValueError, match="planar"):
        plot.arm(rrr, ax=pyplot.figure().add_subplot(projection="3d"))
    with pytest.raises(beeline.Error):
        plot.arm(rrr, [1, 2])
    with pytest.raises(beeline.Error):
        plot.motion(rrr, motion(panda))
    with pytest.raises(TypeError, match="Trajectory"):
        plot.joints([1, 2, 3])
    with pytest.raises(ValueError, match="positive"):
        plot.animation(rrr, motion(rrr), speed=0)
    with pytest.raises(ValueError, match="too long"):
        plot.animation(rrr, beeline.Trajectory(rrr.joint_names, [0, 1e9], np.zeros((2, 3))))
