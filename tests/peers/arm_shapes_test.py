"""The shapes of built-in arms contain the meshes that they are fitted to, and exceed them by at most 15 mm.

With CASES=3 all triangles and links are looked at; by default one triangle of three, and the excess of one link of three. The
meshes and their places are Pinocchio's reading of example-robot-data, or of the MJCF files of robosuite where that is installed;
the shapes are read by Beeline from the arm's name. The bodies are named as the links of these descriptions.
"""

import importlib.util
import os
import pathlib
import sys
import xml.etree.ElementTree as xml

import beeline
import numpy as np
import pytest
from random_cases import cases
from scipy.spatial import ConvexHull, cKDTree
from scipy.spatial.transform import Rotation

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from triangles import pieces_in_no_body, subdivided  # noqa: E402

MOST = 0.015
SPACING = 0.006
MOST_PLACES = int(7_000 * float(os.environ.get("BEELINE_CASES") or 1))  # of a link, at which the excess is measured
PART = 1 if cases(3) >= 3 else 3  # one of so many triangles is looked at, and the excess of one of so many links
HALF_TURN = np.diag([-1.0, -1, 1, 1])  # from the base of the maker's controller to the description's, as in catalog_test.py
URDF = {  # path below example-robot-data/robots, base
    "panda": ("panda_description/urdf/panda.urdf", np.eye(4)),
    "so101": ("so_arm_description/urdf/so101.urdf", np.eye(4)),
    "ur3": ("ur_description/urdf/ur3_robot.urdf", HALF_TURN),
    "ur5": ("ur_description/urdf/ur5_robot.urdf", HALF_TURN),
    "ur10": ("ur_description/urdf/ur10_robot.urdf", HALF_TURN),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", np.eye(4)),
}
MJCF = {"ur5e": ("ur5e", HALF_TURN), "iiwa7": ("iiwa", np.eye(4)), "gen3": ("kinova3", np.eye(4))}


def placed(triangles, pose):
    return triangles @ pose[:3, :3].T + pose[:3, 3]


def urdf_meshes(path):
    """For each link: the triangles of its meshes in the world, all joints at 0."""
    import pinocchio as pin

    folder = next(p for p in (f / "share" for f in pathlib.Path(pin.__file__).parents) if (p / "example-robot-data").is_dir())
    file = str(folder / "example-robot-data/robots" / path)
    model = pin.buildModelFromUrdf(file)
    shapes = pin.buildGeomFromUrdf(model, file, pin.GeometryType.COLLISION, [str(folder)])
    data, places = model.createData(), shapes.createData()
    pin.updateGeometryPlacements(model, data, shapes, places, np.zeros(model.nq))
    meshes = {}
    for shape, place in zip(shapes.geometryObjects, places.oMg, strict=True):
        if not hasattr(shape.geometry, "num_tris"):
            continue
        corners = [[t[0], t[1], t[2]] for t in (shape.geometry.tri_indices(i) for i in range(shape.geometry.num_tris))]
        name = model.frames[shape.parentFrame].name
        meshes.setdefault(name, []).append(placed(np.array(shape.geometry.vertices())[corners], place.homogeneous))
    return {name: np.concatenate(parts) for name, parts in meshes.items()}


def mjcf_meshes(path):
    root = xml.parse(path).getroot()
    files = {mesh.get("name"): path.parent / mesh.get("file") for mesh in root.iter("mesh")}
    meshes = {}

    def pose_of(element):
        numbers = [[float(x) for x in element.get(key, default).split()] for key, default in (("pos", "0 0 0"), ("quat", "1 0 0 0"))]
        pose = np.eye(4)
        pose[:3, 3] = numbers[0]
        pose[:3, :3] = Rotation.from_quat(np.roll(numbers[1], -1)).as_matrix()
        return pose

    def visit(body, world):
        at = world @ pose_of(body)
        for geom in body.findall("geom"):
            if geom.get("mesh") and (geom.get("contype"), geom.get("conaffinity")) != ("0", "0"):
                rows = np.fromfile(files[geom.get("mesh")], np.dtype([("", "<3f4"), ("v", "<9f4"), ("", "<u2")]), offset=84)
                triangles = placed(rows["v"].astype(float).reshape(-1, 3, 3), at @ pose_of(geom))
                meshes.setdefault(body.get("name"), []).append(triangles)
        for child in body.findall("body"):
            visit(child, at)

    for body in root.find("worldbody").findall("body"):
        visit(body, np.eye(4))
    return {name: np.concatenate(parts) for name, parts in meshes.items()}


def distance_to_triangles(points, triangles):
    """From each point to the nearest triangle: in its plane, or on its edges."""
    a, b, c = triangles.transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    height = np.einsum("nmk,mk->nm", points[:, None] - a, normals)
    over = np.ones_like(height, bool)
    nearest = np.full_like(height, np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        from_u, along = points[:, None] - u, v - u
        over &= np.einsum("nmk,mk->nm", from_u, np.cross(normals, along)) >= 0
        t = np.clip(np.einsum("nmk,mk->nm", from_u, along) / (along**2).sum(1), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(from_u - t[..., None] * along, axis=2))
    return np.where(over, abs(height), nearest).min(1)


class Body:
    """A shape in the frame of its link."""

    def __init__(self, shape):
        self.shape, self.pose = shape, np.asarray(shape.pose)
        if isinstance(shape.body, beeline.ConvexHull):
            vertices = np.array(shape.body.vertices)
            if len(vertices) == 3:  # flat: every point counts as outside its planes
                self.triangles, self.planes = vertices[None], np.array([[0, 0, 0, 1e-12]])
            else:
                hull = ConvexHull(vertices)
                self.triangles, self.planes = vertices[hull.simplices], hull.equations

    def least_distance(self, points):
        """A lower bound of distance(): of a hull, from its planes."""
        if not isinstance(self.shape.body, beeline.ConvexHull):
            return self.distance(points)
        q = (points - self.pose[:3, 3]) @ self.pose[:3, :3]
        values = np.full(len(q), -np.inf)
        for plane in self.planes:
            np.maximum(values, q @ plane[:3] + plane[3], out=values)
        return values - self.shape.padding

    def distance(self, points, beyond=np.inf):
        """The distance of points outside, 0 or less inside; of points farther than `beyond` at least that."""
        q = (points - self.pose[:3, 3]) @ self.pose[:3, :3]
        body, padding = self.shape.body, self.shape.padding
        if isinstance(body, beeline.ConvexHull):
            values = self.least_distance(points) + padding
            for chunk in np.array_split(np.flatnonzero((values > 0) & (values <= beyond + padding)), len(q) // 3000 + 1):
                if len(chunk):
                    values[chunk] = distance_to_triangles(q[chunk], self.triangles)
            return values - padding
        q = abs(q)
        if isinstance(body, beeline.Box):
            excess = q - np.array(body.size) / 2
        else:
            radius, padding = (0, body.radius + padding) if isinstance(body, beeline.Capsule) else (body.radius, padding)
            excess = np.stack([np.hypot(q[:, 0], q[:, 1]) - radius, q[:, 2] - body.length / 2], 1)
        return np.linalg.norm(np.maximum(excess, 0), axis=1) + np.minimum(excess.max(1), 0) - padding


def assert_contained(triangles, bodies, name):
    lost = pieces_in_no_body(triangles, lambda points: [body.distance(points, 0) <= 1e-9 for body in bodies])
    assert not len(lost), f"{name}: {len(lost)} pieces of triangles are in no body, one at {lost[0, 0]}"


def excess_of(triangles, bodies):
    """The largest distance from the surface of the bodies to the mesh.

    At places of a lattice outside the bodies and near them, chosen at random: the distance to the mesh less that to the bodies,
    which the excess is no smaller than. Openings of shells count as closed: a point that has the mesh on five of its six sides
    along the axes belongs to the mesh.
    """
    small = subdivided(triangles, 0.5 * SPACING)
    points = small.mean(1)
    low, high = points.min(0) - 2 * MOST, points.max(0) + 2 * MOST
    axes = [np.arange(a, b, SPACING) for a, b in zip(low, high)]
    lattice = np.stack(np.meshgrid(*axes, indexing="ij"), -1)
    wall = cKDTree(points).query(lattice, distance_upper_bound=SPACING)[0] <= 0.75 * SPACING
    walls_around = sum(np.maximum.accumulate(wall, k).astype(int) for k in range(3))
    walls_around += sum(np.flip(np.maximum.accumulate(np.flip(wall, k), k), k).astype(int) for k in range(3))
    closed = np.concatenate([points, lattice[~wall & (walls_around >= 5)]])
    lattice = lattice[~wall & (walls_around < 5)]
    lattice = lattice[np.min([body.least_distance(lattice) for body in bodies], axis=0) <= SPACING]
    lattice = np.random.default_rng(1).permutation(lattice)[:MOST_PLACES]
    to_bodies = np.min([body.distance(lattice, SPACING) for body in bodies], axis=0)
    near = (to_bodies >= 0) & (to_bodies <= SPACING)
    to_mesh = cKDTree(closed).query(lattice[near])[0]
    return (to_mesh - to_bodies[near]).max(initial=0)


def assert_fits(name, meshes, base):
    arm = beeline.Arm.load(name)
    links = beeline.read_arm_shapes(name).links
    assert len(links) == arm.dof + 1 and [body.link for body in links] == list(range(arm.dof + 1))
    frames = beeline.link_poses(arm, np.zeros(arm.dof))
    for k, link in enumerate(links):
        triangles = placed(meshes[link.name], np.linalg.inv(frames[link.link]) @ base)
        bodies = [Body(shape) for shape in link.shapes]
        assert_contained(triangles[k % PART :: PART], bodies, link.name)
        if k % PART:
            continue
        excess = excess_of(triangles, bodies)
        print(f"{name} {link.name}: {len(bodies)} bodies, excess {1e3 * excess:.1f} mm")
        assert excess <= MOST + 0.05 * SPACING, link.name  # which openings count as closed depends on the spacing


@pytest.mark.parametrize("name", URDF)
def test_shapes_contain_the_meshes_of_example_robot_data(name):
    path, base = URDF[name]
    assert_fits(name, urdf_meshes(path), base)


@pytest.mark.skipif(importlib.util.find_spec("robosuite") is None, reason="robosuite, 150 MB, is not installed: CONTRIBUTING.md")
@pytest.mark.parametrize("name", MJCF)
def test_shapes_contain_the_meshes_of_robosuite(name):
    folder, base = MJCF[name]
    package = pathlib.Path(importlib.util.find_spec("robosuite").submodule_search_locations[0])
    assert_fits(name, mjcf_meshes(package / "models/assets/robots" / folder / "robot.xml"), base)


def test_a_body_that_is_too_small_or_too_large_is_noticed():
    meshes = urdf_meshes("panda_description/urdf/panda.urdf")["panda_link0"]
    bodies = [Body(shape) for shape in beeline.read_arm_shapes("panda").links[0].shapes]
    assert excess_of(meshes * 0.8, bodies) > MOST
    with pytest.raises(AssertionError, match="in no body"):
        assert_contained(meshes * 1.2, bodies, "panda_link0")
