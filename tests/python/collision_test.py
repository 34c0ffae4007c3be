"""Shapes, scenes and proofs of clearance, as in C++."""

import json
import pathlib
import pickle
import re
import tarfile
import warnings

import beeline
import numpy as np
import pytest

PROBLEMS = pathlib.Path(__file__).resolve().parents[3] / "shared/data/motion_bench_maker/panda_problems.tar.xz"


def at(*position):
    pose = np.eye(4)
    pose[:3, 3] = position
    return pose


BODIES = [beeline.Sphere(0.1), beeline.Capsule(0.1, 2), beeline.Box([1, 2, 0]), beeline.Cylinder(1, 2), beeline.HalfSpace(),
          beeline.ConvexHull(np.array([[0, 0, 0], [1, 0, 0], [0, 1.0, 0]]))]


@pytest.fixture
def arm():
    return beeline.arms.rrr()


@pytest.fixture
def links():
    return [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.1))]) for i in (1, 2, 3)]


def tip(arm, q):
    return beeline.forward_kinematics(arm, np.asarray(q, float))[:3, 3]


@pytest.mark.parametrize("body", BODIES, ids=lambda body: type(body).__name__)
def test_shapes_compare_and_pickle(body):
    shape = beeline.Shape(body, at(1, 2, 3), padding=0.01)
    assert pickle.loads(pickle.dumps(shape)) == shape != beeline.Shape(body)
    assert type(shape.body) is type(body) and shape.body == body
    assert type(body).__name__ in repr(shape)
    np.testing.assert_array_equal(shape.pose, at(1, 2, 3))


def test_scenes_are_written_and_read(tmp_path):
    scene = beeline.Scene(obstacles=[beeline.Obstacle("a", [beeline.Shape(body) for body in BODIES]),
                                     beeline.Obstacle("b", [beeline.Shape(BODIES[0])], clearance=0.5)], allowed_pairs=[("a", "hand")])
    path = tmp_path / "scene.json"
    path.write_text(beeline.scene_to_json(scene))
    assert beeline.read_scene(path) == scene
    assert json.loads(path.read_text())["allowed_pairs"] == [["a", "hand"]]
    path.write_text('{"obstacles": [{"name": "a", "shapes": [{"box": {"size": [1, -1, 1]}}]}]}')
    with pytest.raises(beeline.FileError, match="scene.json:1.*edge of -1 m"):
        beeline.read_scene(path)


def test_a_motion_is_clear_or_collides(arm, links, rng):
    for _ in range(20):
        start, goal = rng.uniform(-1, 1, (2, 3))
        motion = beeline.move_joints(arm, start, goal).trajectory
        time = rng.uniform(motion.times[0], motion.times[-1])
        x, y, z = tip(arm, motion.sample(time).position)
        for height, clear in ((0, False), (0.5, True)):
            ball = beeline.Obstacle("ball", [beeline.Shape(beeline.Sphere(0.01), at(x, y, z + height))])
            model = beeline.CollisionModel(arm, links, beeline.Scene(obstacles=[ball]), self_collision=False)
            proof = beeline.prove_clearance(model, motion, closest=True)
            assert bool(proof) == clear and proof.status == ("clear" if clear else "collides")
            if clear:
                assert not proof.reason and proof.least_distance <= proof.pair.upper
                assert 0.3 < proof.least_distance <= 0.39 + 1e-9
            else:
                assert proof.reason.code in ("bodies_collide", "bodies_too_close")
                assert proof.reason.fields["other_body"] == "ball" and proof.time <= time + 0.05


def test_joints_of_a_motion_are_matched_by_name(arm, links, rng):
    motion = beeline.move_joints(arm, [0, 0, 0], [1, 0.2, 0]).trajectory
    ball = beeline.Obstacle("ball", [beeline.Shape(beeline.Sphere(0.1), at(*tip(arm, [0.5, 0.1, 0])))])
    model = beeline.CollisionModel(arm, links, beeline.Scene([ball]))
    order = rng.permutation(3)
    names = [motion.joint_names[k] for k in order]
    other = beeline.Trajectory(names, motion.times, motion.positions[:, order], motion.velocities[:, order], motion.accelerations[:, order])
    assert beeline.prove_clearance(model, motion).time == beeline.prove_clearance(model, other).time
    assert beeline.prove_clearance(model, other).status == "collides"
    foreign = beeline.Trajectory(["x", "y", "z"], motion.times, motion.positions, motion.velocities, motion.accelerations)
    for function in (beeline.prove_clearance, beeline.clearance_over_time):
        with pytest.raises(beeline.Error, match="x"):
            function(model, foreign)
    with pytest.raises(beeline.Error, match="x"):
        beeline.first_joint_fault(arm, foreign)


def test_the_gradient_of_the_nearest_pair(arm, links):
    far = beeline.Obstacle("far", [beeline.Shape(beeline.Sphere(0.5), at(2, 9, 1))])
    model = beeline.CollisionModel(arm, links, beeline.Scene(obstacles=[far]), self_collision=False)
    q = np.array([0.3, 0.4, 0.5])
    nearest = beeline.nearest_pair(model, q)
    assert nearest.names == ("link3", "far")
    distance = np.linalg.norm(tip(arm, q) - [2, 9, 1]) - 0.6
    assert nearest.lower <= distance + 1e-12 and distance - 1e-12 <= nearest.upper
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        difference = (beeline.nearest_pair(model, q + step).upper - beeline.nearest_pair(model, q - step).upper) / 2e-6
        assert difference == pytest.approx(nearest.gradient[k], abs=1e-6)
    assert beeline.pairs_too_close(model, q) == []


def test_pairs_that_count(arm, links):
    model = beeline.CollisionModel(arm, links, max_work=0)
    assert (model.pair_count, model.apart_count) == (1, 0)
    assert beeline.CollisionModel(arm, links).apart_count == 1, "the tip is never at joint 2"
    assert beeline.CollisionModel(arm, links, allowed_pairs=[("link1", "link3")], max_work=0).pair_count == 0
    assert model.arm == arm and model.neighbour_pairs == [("link1", "link2"), ("link2", "link3")]


def test_a_proof_about_no_pair_warns(arm, links):
    still = beeline.at_rest(arm, arm.middle)
    with pytest.warns(beeline.InputWarning, match="no pair of bodies counts: nothing was checked"):
        assert beeline.prove_clearance(beeline.CollisionModel(arm, links[:2]), still).pairs == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert beeline.prove_clearance(beeline.CollisionModel(arm, links, max_work=0), still).pairs == 1
    with pytest.raises(TypeError, match="beyond"):
        beeline.prove_clearance(beeline.CollisionModel(arm, links), still, beyond=0.1)


def test_links_of_a_cell_that_are_only_visible_warn(tmp_path):
    path = tmp_path / "cell.urdf"
    body = "<{0}><geometry><sphere radius='0.1'/></geometry></{0}>"
    path.write_text(f"""<robot name="cell"><link name="world">{body.format("collision")}</link>
        <link name="table">{body.format("visual")}</link>
        <joint name="j" type="fixed"><parent link="world"/><child link="table"/></joint></robot>""")
    with pytest.warns(beeline.InputWarning, match="no obstacles: table$"):
        scene = beeline.read_scene(path)
    assert [obstacle.name for obstacle in scene.obstacles] == ["world"] and scene.links_without_shapes == ["table"]


def test_shapes_of_a_file(tmp_path):
    path = tmp_path / "arm.urdf"
    collision = "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
    path.write_text(f"""<robot name="r"><link name="a"/><link name="b">{collision}</link><link name="c">{collision}</link>
        <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
        <joint name="k" type="prismatic"><parent link="b"/><child link="c"/><limit lower="0" upper="1"/></joint></robot>""")
    shapes = beeline.read_arm_shapes(path, tip="b", hold={"k": 0.25})
    assert [body.name for body in shapes.links] == ["b", "c"] and shapes.held == {"k": 0.25}
    np.testing.assert_allclose(shapes.links[1].shapes[0].pose[:3, 3], [0.25, 0, 0])
    with pytest.raises(beeline.Error, match="unknown joint.*j.*known: k"):
        beeline.read_arm_shapes(path, tip="b", hold={"j": 0})
    assert beeline.read_arm_shapes("fr3").links == []
    tool = tmp_path / "tool.json"
    tool.write_text('{"name": "probe", "shapes": [{"sphere": {"radius": 0.1}}]}')
    body = beeline.read_tool_shapes(tool, beeline.arms.panda())
    assert (body.name, body.link, body.at_proximal_joint) == ("probe", 7, False)


def test_meshes_cells_and_srdf_files(tmp_path):
    wedge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n"
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "wedge.obj").write_text(wedge)
    mesh = "<collision><geometry><mesh filename='package://parts/wedge.obj' scale='1 1 -2'/></geometry></collision>"
    path = tmp_path / "arm.urdf"
    path.write_text(f"""<robot name="r"><link name="a">{mesh}</link><link name="b">{mesh}</link>
        <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>""")
    (tmp_path / "arm.srdf").write_text("""<robot name="r"><disable_collisions link1="a" link2="b" reason="Adjacent"/>
        <disable_collisions link1="a" link2="c" reason="Never"/></robot>""")
    with pytest.raises(beeline.FileError, match=r"arm.urdf:1.*parts/wedge.obj.*package=\{"):
        beeline.read_arm_shapes(path)
    shapes = beeline.read_arm_shapes(path, package={"parts": tmp_path / "meshes"}, srdf=tmp_path / "arm.srdf")
    assert shapes.allowed_pairs == [("a", "b")]
    (shape,) = shapes.links[1].shapes
    assert shape.hull_of == str(tmp_path / "meshes" / "wedge.obj") and shape.padding == 0
    assert shape.body.vertices.tolist() == [[0, 0, -2], [0, 0, 0], [0, 1, 0], [1, 0, 0]]
    assert pickle.loads(pickle.dumps(shape)) == shape
    scene = beeline.read_scene(path, hold={"j": 0.5}, package={"parts": tmp_path / "meshes"})
    assert [obstacle.name for obstacle in scene.obstacles] == ["a", "b"] and scene.held == {"j": 0.5}
    with pytest.raises(TypeError, match="package"):
        beeline.read_scene(path, package=["parts"])


@pytest.mark.parametrize("make, says", [
    (lambda arm, links: beeline.Shape(beeline.Sphere(1), hull_of="a.stl"), "hull_of"),
    (lambda arm, links: beeline.Sphere(-1), "-1 m"),
    (lambda arm, links: beeline.Box([1, 2]), "size"),
    (lambda arm, links: beeline.Shape(1), "body"),
    (lambda arm, links: beeline.CollisionModel(arm, links + links), "link1"),
    (lambda arm, links: beeline.CollisionModel(arm, links, clearance=0), "clearance"),
    (lambda arm, links: beeline.CollisionModel(arm, links, allowed_pairs=[("link1", "tabel")]), "tabel"),
    (lambda arm, links: beeline.CollisionModel(arm, [beeline.LinkShapes("l", 4, [beeline.Shape(beeline.Sphere(1))])]), "link 4"),
    (lambda arm, links: beeline.nearest_pair(beeline.CollisionModel(arm, links), [0, 0]), "2"),
    (lambda arm, links: beeline.prove_clearance(beeline.CollisionModel(arm, links),
                                                beeline.at_rest(arm, arm.middle), resolution=0), "resolution"),
])  # fmt: skip
def test_refusals(arm, links, make, says):
    with pytest.raises((beeline.Error, TypeError), match=says):
        make(arm, links)


def test_pictures_show_the_obstacles(arm, links):
    scene = beeline.Scene(obstacles=[beeline.Obstacle("post", [beeline.Shape(beeline.Sphere(0.3), at(3, 6, 0))])])
    model = beeline.CollisionModel(arm, links, scene)
    motion = beeline.move_joints(arm, [0, 1.57, 0], [-0.3, 1.2, 0.3]).trajectory
    assert ">post<" in beeline.arm_figure(model, [0, 1.57, 0]).svg
    assert beeline.draw(model, [0, 1.57, 0]) == beeline.arm_figure(model, [0, 1.57, 0]) != beeline.draw(arm, [0, 1.57, 0])
    assert ">post<" in beeline.motion_figure(model, motion).svg and beeline.draw(model, motion) == beeline.motion_figure(model, motion)
    assert ">post<" in beeline.motion_animation(model, motion).svg
    clearance = beeline.clearance_over_time(model, motion)
    assert len(clearance.times) == len(clearance.proved) + 1 and clearance.clearance == 0.001
    assert clearance.ending == "complete"
    assert np.min(clearance.proved) <= np.min(clearance.sampled)
    plain, charted = (beeline.timing_figure(arm, motion, clearance=given) for given in (None, clearance))
    assert ">required<" in charted.svg and ">required<" not in plain.svg
    assert "remark of mine" in beeline.controller_file(arm, motion, "ros2", remarks=["remark of mine"]).text


def test_shapes_of_built_in_arms():
    """They equal the shapes in the file of the arm; an arm has them if it says where they are from."""
    folder = pathlib.Path(__file__).resolve().parents[2] / "beeline/model/arms"
    with_shapes = [about.name for about in beeline.built_in_arms() if about.shapes_source]
    assert set(with_shapes) == {"panda", "ur3", "ur5", "ur10", "ur5e", "iiwa7", "gen3", "xarm7", "so101"}
    for name in (about.name for about in beeline.built_in_arms()):
        links = beeline.read_arm_shapes(name).links
        assert bool(links) == (name in with_shapes)
        assert links == beeline.read_arm_shapes(folder / f"{name}.json").links
        assert len({body.link for body in links}) in (0, beeline.Arm.load(name).dof + 1)


@pytest.mark.skipif(not PROBLEMS.exists(), reason="the problems of MotionBenchMaker are not here")
def test_no_start_or_goal_of_motion_bench_maker_is_refused(tmp_path):
    """840 configurations that are free with the meshes, at 1 mm, with the Panda's built-in shapes and all pairs of its links."""
    with tarfile.open(PROBLEMS) as archive:
        archive.extractall(tmp_path, filter="data")
    arm, links = beeline.arms.panda(), beeline.read_arm_shapes("panda").links
    configurations = refused = 0
    for path in sorted(tmp_path.glob("*/scene*.yaml")):
        obstacles = beeline.read_scene(path).obstacles  # without the file's matrix
        model = beeline.CollisionModel(arm, links, beeline.Scene(obstacles), clearance=0.001)
        request = path.with_name(path.name.replace("scene", "request")).read_text()
        start = [float(x) for x in re.search(r"position: \[([^]]*)]", request)[1].split(",")]
        goal = [float(x) for x in re.findall(r"position: (-?[\d.e-]+)", request)]
        for q in start[:7], goal[:7]:
            configurations += 1
            refused += bool(beeline.pairs_too_close(model, q))
    assert (configurations, refused) == (840, 0)


def test_a_point_cloud_is_its_spheres(tmp_path):
    points = np.random.default_rng(7).uniform(-1, 1, (200, 3))
    cloud = beeline.PointCloud(points, 0.05)
    assert np.array_equal(cloud.points, points) and cloud.radius == 0.05
    arm, links = beeline.Arm.load("panda"), beeline.read_arm_shapes("panda").links
    spheres = [beeline.Shape(beeline.Sphere(0.05), pose=at(*p)) for p in points]
    scenes = [beeline.Scene([beeline.Obstacle("scan", [], cloud=cloud)]), beeline.Scene([beeline.Obstacle("scan", spheres)])]
    np.save(tmp_path / "scan.npy", points)
    scenes.append(beeline.read_scene(tmp_path / "scan.npy", radius=0.05))
    assert scenes[0] == scenes[2]
    models = [beeline.CollisionModel(arm, links, scene, self_collision=False) for scene in scenes]
    nearest = [beeline.nearest_pair(model, np.zeros(7)) for model in models]
    assert nearest[0].lower == nearest[1].lower == nearest[2].lower and nearest[0].names == nearest[1].names
    assert nearest[1].point is None
    assert np.linalg.norm(points[nearest[0].point] - nearest[0].on_second) <= 0.05 + 1e-9
    with pytest.raises(beeline.Error, match="needs a radius"):
        beeline.read_scene(tmp_path / "scan.npy")
    with pytest.raises(beeline.Error, match="point 1 of a point cloud"):
        beeline.PointCloud([[0, 0, 0], [np.nan, 0, 0]], 0.1)
