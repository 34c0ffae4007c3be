"""The collision shapes of the arms in example-robot-data are Pinocchio's: where they stand, their sizes, and their hulls.

The poses in the world of all shapes at random configurations, also of links beside the chain, which are held. Then each mesh:
its hull against the hull of Qhull. With BEELINE_CASES=10 or more: all files whose shapes are read, with each of their tips.
"""

import os
import zlib

import numpy as np
import pinocchio
import pytest
from scipy.spatial import ConvexHull
from urdf_tree import ROBOTS, UrdfTree

import beeline

CASES = float(os.environ.get("BEELINE_CASES", "1"))
ALL = CASES >= 10
CONFIGURATIONS = round(100 * CASES)  # of each file, all its tips together
DIRECTIONS = round(100 * CASES)  # of each hull
TOLERANCE = 1e-12  # of positions, m, and of rotations, rad
FILES = [
    "anymal_c_simple_description/urdf/anymal", "centauro_description/urdf/centauro", "panda_description/urdf/panda",
    "panda_description/urdf/panda_collision", "pr2_description/urdf/pr2", "romeo_description/urdf/romeo_laas_small",
    "so_arm_description/urdf/so100", "solo_description/robots/solo12", "talos_data/robots/talos_left_arm",
    "talos_data/robots/talos_reduced", "tiago_pro_description/robots/tiago_pro", "ur_description/urdf/ur3_gripper",
    "ur_description/urdf/ur5_robot", "ur_description/urdf/ur10_robot", "xarm_description/urdf/xarm7",
    "z1_description/urdf/z1",
]
REPLACED = "simple_humanoid"  # has an element of Pinocchio that replaces its cylinder by a capsule
REFUSED = (".dae", ".DAE", "package:///")  # in the messages of files that are not read: Collada, a package without a name


def paths():
    if not ALL:
        return [pytest.param(ROBOTS / f"{name}.urdf", id=name) for name in FILES]
    found = [path for path in sorted(ROBOTS.rglob("*.urdf")) if path.stem != REPLACED]
    return [pytest.param(path, id=str(path.relative_to(ROBOTS).with_suffix(""))) for path in found]


def shapes_of(path):
    """The shapes of the links by tip: of one of the longest chains, or of all. Skips a file that is not read, or has none."""
    tree, found, refusal = UrdfTree(path), {}, "the file has no shapes"
    for tip in sorted(tree.leaves(), key=lambda tip: -len(tree.moving_joints(tip))):
        if not tree.moving_joints(tip) or (found and not ALL):
            continue
        try:
            shapes = beeline.read_arm_shapes(path, base=tree.root, tip=tip)
        except beeline.FileError as error:
            refusal = str(error)
            if "moves with it" not in refusal and tree.unknown_leaders(tip) == []:  # those cannot be placed
                assert any(reason in refusal for reason in REFUSED), refusal
            continue
        if shapes.links:
            found[tip] = shapes
    if not found:
        assert path.relative_to(ROBOTS).with_suffix("").as_posix() not in FILES, refusal
        pytest.skip(refusal)
    return found


class Peer:
    """Pinocchio's collision geometry of a file, in which each joint is free, mimic joints too."""

    def __init__(self, path):
        self.path = path
        folders = [str(ROBOTS.parent.parent)]
        self.model = pinocchio.buildModelFromUrdf(str(path), mimic=False)
        self.shapes = pinocchio.buildGeomFromUrdf(self.model, str(path), pinocchio.GeometryType.COLLISION, package_dirs=folders)
        self.data, self.places = self.model.createData(), self.shapes.createData()
        self.names = {}  # indices of the shapes of a link, in the order of the file
        for i, shape in enumerate(self.shapes.geometryObjects):
            self.names.setdefault(self.model.frames[shape.parentFrame].name, []).append(i)

    def configuration(self, values):
        q = pinocchio.neutral(self.model)
        for name, value in values.items():
            joint = self.model.joints[self.model.getJointId(name)]
            if joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)
            elif joint.nq == 1:
                q[joint.idx_q] = value
        return q

    def poses(self, values):
        pinocchio.updateGeometryPlacements(self.model, self.data, self.shapes, self.places, self.configuration(values))
        return np.array([pose.homogeneous for pose in self.places.oMg])


@pytest.fixture(scope="module", params=paths())
def robot(request):
    """The tree of a file, our shapes of its links by tip, and Pinocchio's geometry."""
    shapes = shapes_of(request.param)
    return UrdfTree(request.param), shapes, Peer(request.param)


@pytest.fixture
def rng(seed, robot):
    print(f"BEELINE_SEED={seed}")
    return np.random.default_rng([seed, zlib.crc32(robot[2].path.name.encode())])


def values_of_joints(tree, arm, held, q):
    """The values of all joints: of the chain, of its mimic joints, and the held ones."""
    values = dict(held) | dict(zip(arm.joint_names, q))
    for name, joint in tree.joints.items():
        if joint.moves and name not in values and joint.mimic and joint.mimic[0] in tree.joints:
            leader, ratio, shift = tree.leader(name, values)
            values[name] = ratio * values.get(leader, 0) + shift
    return values


def assert_same_size(ours, theirs, name):
    body = ours.body
    if isinstance(body, beeline.Sphere):
        same = [(body.radius, theirs.radius)]
    elif isinstance(body, beeline.Box):
        same = list(zip(body.size, 2 * theirs.halfSide))
    elif isinstance(body, beeline.ConvexHull):
        assert hasattr(theirs, "num_tris"), name
        return
    else:
        assert type(body).__name__ == type(theirs).__name__, name
        same = [(body.radius, theirs.radius), (body.length, 2 * theirs.halfLength)]
    assert ours.padding == 0, name
    for a, b in same:
        assert a == pytest.approx(b, rel=1e-15), name


def test_shapes_stand_where_pinocchio_has_them(robot, rng):
    tree, tips, theirs = robot
    apart = turned = shown = 0
    for tip, shapes in tips.items():
        arm = beeline.Arm.load(theirs.path, base=tree.root, tip=tip)
        assert {link.name: len(link.shapes) for link in shapes.links} == {n: len(of) for n, of in theirs.names.items()}
        bodies = [(link, shape, i) for link in shapes.links for shape, i in zip(link.shapes, theirs.names[link.name])]
        for link, shape, i in bodies:
            assert_same_size(shape, theirs.shapes.geometryObjects[i].geometry, link.name)
        links, order = [link.link for link, _, _ in bodies], [i for _, _, i in bodies]
        local = np.array([shape.pose for _, shape, _ in bodies])
        q = rng.uniform(np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi), (-(-CONFIGURATIONS // len(tips)), arm.dof))
        for row, world in zip(q, beeline.link_poses(arm, q)):
            ours, expected = world[links] @ local, theirs.poses(values_of_joints(tree, arm, shapes.held, row))[order]
            apart = max(apart, np.linalg.norm(ours[:, :3, 3] - expected[:, :3, 3], axis=1).max())
            turned = max(turned, np.linalg.norm(ours[:, :3, :3] - expected[:, :3, :3], axis=(1, 2)).max() / np.sqrt(2))
            shown += len(order)
    print(f"{shown} poses of shapes of {len(tips)} chains: {apart:.1e} m, {turned:.1e} rad")
    assert apart <= TOLERANCE and turned <= TOLERANCE


def meshes_of(shapes, theirs):
    """Each mesh of a file once: our hull, and the corners that Pinocchio reads, scaled."""
    found = {}
    for link in shapes.links:
        for shape, i in zip(link.shapes, theirs.names[link.name]):
            if shape.hull_of:
                geometry = theirs.shapes.geometryObjects[i]
                found[shape.hull_of, tuple(geometry.meshScale)] = shape, np.array(geometry.geometry.vertices())
    return found


def test_hulls_equal_qhull(robot, rng):
    _, tips, theirs = robot
    for (mesh, scale), (shape, corners) in meshes_of(next(iter(tips.values())), theirs).items():
        hull = ConvexHull(corners)
        ours, expected = np.array(shape.body.vertices), corners[hull.vertices]
        along = rng.normal(size=(DIRECTIONS, 3))
        along /= np.linalg.norm(along, axis=1)[:, None]
        excess = (along @ ours.T).max(1) + shape.padding - (along @ expected.T).max(1)
        dropped = hull.volume - ConvexHull(ours).volume
        # Pinocchio reads decimal numbers to single precision.
        error = (1e-12 if mesh.lower().endswith(".stl") else 1e-7) * abs(expected).max()
        name = f"{mesh.rsplit('/', 1)[-1]} scaled by {', '.join(map(str, scale))}"
        print(f"{name}: {len(corners)} corners, {len(ours)} of {len(expected)} vertices, padding {shape.padding:.1e} m, "
              f"excess {excess.min():.1e} to {excess.max():.1e} m, {dropped / hull.volume:.1e} of the volume missing")
        assert excess.min() >= -error, f"{name}: the hull does not contain the mesh"
        assert excess.max() <= shape.padding + error, name
        assert -error * hull.area <= dropped <= (shape.padding + error) * hull.area, name
        assert shape.padding <= max(1e-4, 1e-3 * np.linalg.norm(np.ptp(expected, axis=0))) or len(ours) >= 2000, name
