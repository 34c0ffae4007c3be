"""Collision meshes of URDF and MJCF files in the frames of an arm file's links."""

import pathlib
import xml.etree.ElementTree as xml

import numpy as np


def numbers(text, default):
    return np.array([float(x) for x in text.split()] if text else default)


def rotated(axis, angle):
    x, y, z = axis / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def transform(rotation, translation):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, translation
    return pose


def pose_matrix(pose):
    return transform(rpy_matrix(pose.get("rpy", [0, 0, 0])), pose.get("xyz", [0, 0, 0]))


def link_frames(arm, q):
    """The poses of links 0..n of an arm file with a DH table, or with revolute joints about axes through their frames' origins."""
    poses = [pose_matrix(arm.get("base", {}))]
    if "joints" in arm:
        for joint, value in zip(arm["joints"], q, strict=True):
            turn = transform(rotated(np.array(joint.get("axis", [0, 0, 1])), value), [0, 0, 0])
            poses.append(poses[-1] @ pose_matrix(joint.get("origin", {})) @ turn)
        return poses
    unit = np.pi / 180 if arm["dh"].get("degrees") else 1
    for row, value in zip(arm["dh"]["rows"], q, strict=True):
        turn = transform(rotated(np.array([0, 0, 1]), row.get("theta", 0) * unit + value), [0, 0, row["d"]])
        tilt = transform(rotated(np.array([1, 0, 0]), row["alpha"] * unit), [row["a"], 0, 0])
        poses.append(poses[-1] @ (turn @ tilt if arm["dh"]["convention"] == "standard" else tilt @ turn))
    return poses


def joint_names(arm):
    if "joints" in arm:
        return [joint["name"] for joint in arm["joints"]]
    return [row.get("name", f"joint{k}") for k, row in enumerate(arm["dh"]["rows"], 1)]


def rpy_matrix(rpy):
    x, y, z = (rotated(axis, angle) for axis, angle in zip(np.eye(3), rpy))
    return z @ y @ x


def read_stl(path):
    data = path.read_bytes()
    if data[:5] == b"solid" and b"facet" in data[:400]:
        rows = [line.split()[1:] for line in data.decode().splitlines() if line.split()[:1] == ["vertex"]]
        return np.array(rows, float).reshape(-1, 3, 3)
    count = int.from_bytes(data[80:84], "little")
    rows = np.frombuffer(data, np.dtype([("n", "<3f4"), ("v", "<9f4"), ("a", "<u2")]), count, 84)
    return rows["v"].astype(float).reshape(-1, 3, 3)


def urdf_links(path):
    """Each link from the root along the chain: its name, its pose in the parent, its axis, and its meshes."""
    root = xml.parse(path).getroot()
    pose = lambda e: transform(rpy_matrix(numbers(e.get("rpy"), [0, 0, 0])), numbers(e.get("xyz"), [0, 0, 0]))  # noqa: E731
    origin = lambda e: np.eye(4) if e.find("origin") is None else pose(e.find("origin"))  # noqa: E731
    joints = {j.find("child").get("link"): j for j in root.iter("joint") if j.find("child") is not None}
    links = []
    for link in root.iter("link"):
        meshes = []
        for collision in link.iter("collision"):
            mesh = collision.find("geometry/mesh")
            if mesh is not None:
                inner = mesh.get("filename").removeprefix("package://example-robot-data/robots/")
                found = next(f / inner for f in path.parents if (f / inner).exists())
                triangles = read_stl(found) * numbers(mesh.get("scale"), [1, 1, 1])
                at = origin(collision)
                meshes.append(triangles @ at[:3, :3].T + at[:3, 3])
        joint = joints.get(link.get("name"))
        axis = None if joint is None or joint.get("type") == "fixed" else numbers(joint.find("axis").get("xyz"), None)
        parent = None if joint is None else joint.find("parent").get("link")
        links.append((link.get("name"), parent, np.eye(4) if joint is None else origin(joint), axis, meshes))
    return links


def quaternion_matrix(q):
    w, x, y, z = q / np.linalg.norm(q)
    angle = 2 * np.arctan2(np.linalg.norm([x, y, z]), w)
    return rotated(np.array([x, y, z]), angle) if angle else np.eye(3)


def mjcf_links(path):
    root = xml.parse(path).getroot()
    files = {m.get("name"): path.parent / m.get("file") for m in root.iter("mesh")}
    pose = lambda e: transform(quaternion_matrix(numbers(e.get("quat"), [1, 0, 0, 0])), numbers(e.get("pos"), [0, 0, 0]))  # noqa: E731
    links = []

    def visit(body, parent):
        meshes = []
        for geom in body.findall("geom"):
            if geom.get("mesh") and (geom.get("contype") != "0" or geom.get("conaffinity") != "0"):
                at = pose(geom)
                meshes.append(read_stl(files[geom.get("mesh")]) @ at[:3, :3].T + at[:3, 3])
        joint = body.find("joint")
        axis = None if joint is None else numbers(joint.get("axis"), None)
        links.append((body.get("name"), parent, pose(body), axis, meshes))
        for child in body.findall("body"):
            visit(child, body.get("name"))

    for body in root.find("worldbody").findall("body"):
        visit(body, None)
    return links


def chain_links(path):
    return mjcf_links(path) if path.suffix == ".xml" else urdf_links(path)


def link_poses(links, q):
    """The pose of each described link and the number of joints above it, by name; joints beyond q stand at zero."""
    found, by_name = {None: (np.eye(4), 0)}, {name: link for name, *link in links}

    def visit(name):
        if name not in found:
            parent, at, axis, _ = by_name[name]
            pose, count = visit(parent)
            pose = pose @ at
            if axis is not None:
                pose = pose @ transform(rotated(axis, q[count] if count < len(q) else 0), [0, 0, 0])
            found[name] = pose, count + (axis is not None)
        return found[name]

    return {name: visit(name) for name in by_name}


def meshes_of_links(arm, path, turn=False):
    """For each link 0..n of an arm file: its name in the description, and the triangles of its meshes in the arm file's frame.

    The meshes are placed at the zero position. `turn`: the description's base is rotated by pi about z. The last value is the
    largest translation by which the two descriptions differ in 1,000 other configurations.
    """
    links = chain_links(pathlib.Path(path).resolve())
    count = len(joint_names(arm))
    base = transform(rotated(np.array([0, 0, 1]), np.pi * turn), [0, 0, 0])

    def offsets(q):
        theirs, ours = link_poses(links, q), link_frames(arm, q)
        return {n: np.linalg.inv(ours[k]) @ base @ pose for n, (pose, k) in theirs.items() if k <= count}

    zero = offsets(np.zeros(count))
    depth = {name: k for name, (_, k) in link_poses(links, np.zeros(count)).items()}
    bodies = [[None, np.empty((0, 3, 3))] for _ in range(count + 1)]
    used = []
    for name, _, _, axis, meshes in links:
        k = depth[name]
        if not meshes or k > count or (k > 0 and axis is None):
            continue
        at = zero[name]
        used.append(name)
        bodies[k][0] = name
        bodies[k][1] = np.concatenate([bodies[k][1]] + [m @ at[:3, :3].T + at[:3, 3] for m in meshes])
    rng = np.random.default_rng(0)
    others = [offsets(q) for q in rng.uniform(-np.pi, np.pi, (1000, count))]
    spread = max(abs(o[n] - zero[n])[:3, 3].max() for o in others for n in used)
    return bodies, spread
