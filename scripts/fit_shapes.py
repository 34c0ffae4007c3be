#!/usr/bin/env python3
"""Fits few convex bodies to the collision meshes of each link of an arm, and writes them into its arm file.

    fit_shapes.py panda panda.urdf             a URDF file and its meshes
    fit_shapes.py ur5e robot.xml --turn        MJCF; --turn: its base is rotated by pi about z from the arm file's

Each body is a box, a cylinder, or the convex hull of few points grown by a padding; two points are a capsule. The bodies of a
link contain its meshes, and no point of their surface is farther than --excess from them. Needs numpy and scipy; the numbers
repeat.

 1. The triangles are subdivided to 8 mm.
 2. A part whose hull exceeds the mesh too much is divided by the plane that leaves the least excess, and again. A triangle
    across a plane belongs to both parts, so each triangle lies in the body of a part.
 3. A part gets the box or the cylinder along an axis of its link that contains it, if the excess allows it. Otherwise its hull
    is eroded by a radius, and few of the eroded hull's vertices are chosen, the farthest one at a time. The padding is the
    distance of the part's vertices from their hull. The radius with the fewest points is taken.
tests/peers/arm_shapes_test.py verifies the numbers in the arm files, independently, and all of them with CASES=3.
"""

import argparse
import json
import pathlib

import numpy as np
from scipy import ndimage
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError, cKDTree
from scipy.spatial.transform import Rotation

from arm_meshes import joint_names, meshes_of_links
from triangles import subdivided

GRID, EDGE, ROUNDING = 0.004, 0.008, 1e-4  # m
MOST_POINTS, MOST_DIVISIONS = 60, 5
ARMS = pathlib.Path(__file__).resolve().parents[1] / "beeline" / "model" / "arms"


class Field:
    """The distance to a mesh on a grid, negative inside it.

    A point that has the mesh on five of its six sides along the axes is inside: openings of shells count as closed.
    """

    def __init__(self, triangles, margin=0.04):
        points = np.unique(subdivided(triangles, 0.25 * EDGE).reshape(-1, 3), axis=0)
        self.tree = cKDTree(points)
        self.origin = points.min(0) - margin
        sizes = np.ceil((points.max(0) + margin - self.origin) / GRID).astype(int) + 1
        nodes = np.stack(np.meshgrid(*[np.arange(n) for n in sizes], indexing="ij"), -1) * GRID + self.origin
        distance = self.tree.query(nodes.reshape(-1, 3))[0].reshape(sizes)
        wall = distance <= 0.75 * GRID
        regions, _ = ndimage.label(~wall)
        walls_around = np.zeros(sizes, int)
        for axis in range(3):
            walls_around += np.maximum.accumulate(wall, axis)
            walls_around += np.flip(np.maximum.accumulate(np.flip(wall, axis), axis), axis)
        inside = ~wall & ((regions != regions[0, 0, 0]) | (walls_around >= 5))
        openings = inside & ndimage.binary_dilation(~wall & ~inside)
        if openings.any():
            self.tree = cKDTree(np.concatenate([points, nodes[openings]]))
            distance = np.where(inside, distance, self.tree.query(nodes.reshape(-1, 3))[0].reshape(sizes))
        self.values = np.where(inside, -distance, distance)

    def at(self, points):
        where = ((points - self.origin) / GRID).T
        return ndimage.map_coordinates(self.values, where, order=1, mode="nearest")

    def exactly(self, points):
        """As at(), without the error of the grid outside the mesh."""
        at = self.at(points)
        return np.where(at < -GRID, at, self.tree.query(points)[0])


def closest_on_segments(points, a, b):
    along = b - a
    t = np.einsum("nmk,mk->nm", points[:, None] - a, along) / np.maximum((along**2).sum(1), 1e-300)
    return a + np.clip(t, 0, 1)[..., None] * along


def closest_on_triangles(points, triangles):
    """The point of the triangles that is closest to each of the points, and its distance."""
    a, b, c = triangles.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    length2 = (normal**2).sum(1)
    flat = points[:, None] - (np.einsum("nmk,mk->nm", points[:, None] - a, normal) / np.maximum(length2, 1e-300))[..., None] * normal
    inside = length2 > 1e-20
    for u, v in ((a, b), (b, c), (c, a)):
        inside = inside & (np.einsum("nmk,mk->nm", flat - u, np.cross(normal, v - u)) >= 0)
    found = [np.where(inside[..., None], flat, np.inf)]
    found += [closest_on_segments(points, u, v) for u, v in ((a, b), (b, c), (c, a))]
    found = np.concatenate(found, axis=1)
    distance = np.linalg.norm(found - points[:, None], axis=2)
    best = distance.argmin(1)
    rows = np.arange(len(points))
    return found[rows, best], distance[rows, best]


def unit_sphere(n):
    k = np.arange(n) + 0.5
    z, turn = 1 - 2 * k / n, np.pi * (1 + 5**0.5) * k
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], 1)


class Block:
    """A box (half sizes s) or a cylinder (radius and half length s) about the axis z of R."""

    def __init__(self, rotation, center, sizes):
        self.R, self.c, self.s = rotation, center.round(4), np.ceil(sizes / ROUNDING + 1) * ROUNDING

    def distance(self, points):
        q = np.abs((points - self.c) @ self.R)
        beyond = q - self.s if len(self.s) == 3 else np.stack([np.hypot(q[:, 0], q[:, 1]), q[:, 2]], 1) - self.s
        return np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(1), 0)

    def surface(self, spacing):
        steps = lambda half: np.linspace(-1, 1, max(3, int(np.ceil(2 * half / spacing)) + 1))  # noqa: E731
        if len(self.s) == 3:
            parts = []
            for k in range(3):
                grid = np.meshgrid(*[[-1, 1] if k == j else steps(self.s[j]) for j in range(3)], indexing="ij")
                parts.append(np.stack(grid, -1).reshape(-1, 3) * self.s)
        else:
            radius, half = self.s
            turn = np.linspace(0, 2 * np.pi, max(16, int(6.3 * radius / spacing)), endpoint=False)
            rings = [(radius, z * half) for z in steps(half)]
            rings += [(rho * radius, z) for rho in steps(radius / 2) / 2 + 0.5 for z in (-half, half)]
            parts = [np.c_[rho * np.cos(turn), rho * np.sin(turn), np.full(len(turn), z)] for rho, z in rings]
        return np.concatenate(parts) @ self.R.T + self.c

    def shape(self):
        number = lambda x: round(float(x), 4) + 0.0  # noqa: E731
        sizes = {"size": [number(2 * x) for x in self.s]}
        kind = "box" if len(self.s) == 3 else "cylinder"
        if kind == "cylinder":
            sizes = {"radius": number(self.s[0]), "length": number(2 * self.s[1])}
        rpy = [number(x) for x in Rotation.from_matrix(self.R).as_euler("xyz")]
        pose = {"xyz": [number(x) for x in self.c]} | ({"rpy": rpy} if any(rpy) else {})
        return {kind: sizes, "pose": pose}

    def __str__(self):
        return "box" if len(self.s) == 3 else "cylinder"


def smallest_circle(points):
    """The centre, by steps towards the farthest point (Badoiu and Clarkson), and the radius."""
    center = (points.min(0) + points.max(0)) / 2
    for k in range(1, 500):
        center = center + (points[((points - center) ** 2).sum(1).argmax()] - center) / (k + 1)
    return center, np.linalg.norm(points - center, axis=1).max()


def best_block(vertices, field):
    """The box or the cylinder that contains the vertices with the least excess."""
    low, high = vertices.min(0), vertices.max(0)
    blocks = [Block(np.eye(3), (low + high) / 2, (high - low) / 2)]
    for axes in ([0, 1, 2], [1, 2, 0], [2, 0, 1]):
        rotation = np.eye(3)[:, axes]
        q = vertices @ rotation
        center, radius = smallest_circle(q[:, :2])
        ends = q[:, 2].min(), q[:, 2].max()
        middle = rotation @ np.append(center, sum(ends) / 2)
        blocks.append(Block(rotation, middle, np.array([radius, (ends[1] - ends[0]) / 2])))
    excesses = [field.at(block.surface(0.008)).max() for block in blocks]
    return blocks[int(np.argmin(excesses))], min(excesses)


class Hull:
    """The convex hull of a few points, grown by a padding."""

    def __init__(self, points, padding=0.0):
        self.points, self.padding, self.planes = points, padding, np.empty((0, 4))
        try:
            hull = ConvexHull(points)
            self.triangles, self.planes = points[hull.simplices], hull.equations
            self.neighbours = hull.neighbors
        except (QhullError, ValueError):
            n = range(len(points))
            self.triangles = np.array([points[[i, j, k]] for i in n for j in n[i:] for k in n[j:]])

    def closest(self, points, chunk=4000):
        """The closest points and the distances; zero inside."""
        parts = [closest_on_triangles(points[i : i + chunk], self.triangles) for i in range(0, len(points), chunk)]
        closest, distance = (np.concatenate(x) for x in zip(*parts))
        if len(self.planes):
            inside = (points @ self.planes[:, :3].T + self.planes[:, 3]).max(1) <= 0
            distance[inside] = 0
        return closest, distance

    def distance(self, points):
        return self.closest(points)[1] - self.padding

    def surface(self, spacing):
        """Points of the surface."""
        padding = self.padding
        if len(self.planes):
            return self.surface_of_solid(spacing)
        low, high = self.points.min(0) - padding - spacing, self.points.max(0) + padding + spacing
        axes = [np.arange(a, b + spacing, spacing) for a, b in zip(low, high)]
        lattice = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        closest, distance = self.closest(lattice)
        near = (distance > 1e-6) & (abs(distance - padding) < 2 * spacing)
        return closest[near] + padding * (lattice[near] - closest[near]) / distance[near, None]

    def surface_of_solid(self, spacing):
        """Points above faces, edges and vertices."""
        count = int(max(5, np.ceil(np.linalg.norm(np.ptp(self.points, axis=0)) / 2 / spacing)))
        normals, (a, b, c) = self.planes[:, :3], self.triangles.transpose(1, 0, 2)
        weights = [(i / count, j / count) for i in range(count + 1) for j in range(count + 1 - i)]
        parts = [a + s * (b - a) + t * (c - a) + self.padding * normals for s, t in weights]
        if self.padding:
            directions = unit_sphere(int(max(500, 13 * (self.padding / spacing) ** 2)))
            parts.append(self.points[(directions @ self.points.T).argmax(1)] + self.padding * directions)
            for k, (u, v) in enumerate(((b, c), (c, a), (a, b))):  # neighbour k is opposite to corner k
                for t in (0.25, 0.5, 0.75):
                    between = (1 - t) * normals + t * normals[self.neighbours[:, k]]
                    between *= self.padding / np.maximum(np.linalg.norm(between, axis=1), 1e-9)[:, None]
                    parts += [u + s * (v - u) + between for s in np.linspace(0, 1, count)]
        return np.concatenate(parts)

    def shape(self):
        number = lambda x: round(float(x), 4) + 0.0  # noqa: E731
        points, padding = self.points, self.padding
        if len(points) > 2:
            hull = {"vertices": [[number(x) for x in p] for p in points]}
            return {"convex_hull": hull} | ({"padding": number(padding)} if padding else {})
        along = points[1] - points[0]
        yaw, pitch = np.arctan2(along[1], along[0]), np.arctan2(np.hypot(along[0], along[1]), along[2])
        length = np.ceil(np.linalg.norm(along) / ROUNDING) * ROUNDING
        pose = {"xyz": [round(float(x), 5) + 0.0 for x in points.mean(0)], "rpy": [0, number(pitch), number(yaw)]}
        return {"capsule": {"radius": number(padding + ROUNDING), "length": number(length)}, "pose": pose}

    def __str__(self):
        return "capsule" if len(self.points) == 2 else f"hull of {len(self.points)}"


def excess_of_hull(points, distance):
    hull = ConvexHull(points)
    a, b, c = points[hull.simplices].transpose(1, 0, 2)
    u = [(i / 5, j / 5) for i in range(6) for j in range(6 - i)]
    return distance(np.concatenate([a + s * (b - a) + t * (c - a) for s, t in u])).max()


def extreme(triangles):
    points = triangles.reshape(-1, 3)
    return points[ConvexHull(points).vertices]


def bodies_of(triangles, field, excess, depth=0):
    """The body that contains the triangles within the excess, or the bodies of two parts of them."""
    whole = extreme(triangles)
    block, reached = best_block(whole, field)
    if reached <= 0.9 * excess:
        return [block]
    if excess_of_hull(whole, field.exactly) <= max(0.6 * excess, 0.002) or depth == MOST_DIVISIONS:
        hull = simplified(whole, field, 0.96 * excess)
        if hull is not None:
            return [hull]
        if depth == MOST_DIVISIONS or excess < 0.004:
            return [Hull(whole.round(4), ROUNDING)]
    best = None
    for axis in np.eye(3):
        heights = triangles @ axis
        low, high = heights.min(), heights.max()
        for at in np.linspace(low, high, 10)[1:-1]:
            sides = [triangles[heights.min(1) <= at], triangles[heights.max(1) >= at]]
            if min(np.ptp(side @ axis) for side in sides) < 0.01:
                continue
            both = [max(0, excess_of_hull(extreme(side), field.at) - 0.6 * excess) for side in sides]
            score = sum(both) + 0.5 * max(both)
            if best is None or score < best[0]:
                best = score, sides
    return [body for side in best[1] for body in bodies_of(side, field, excess, depth + 1)]


def eroded(vertices, radius):
    """The vertices of the hull eroded by the radius, or None if nothing remains."""
    planes = ConvexHull(vertices).equations + [0, 0, 0, radius]
    inner = linprog([0, 0, 0, -1], np.c_[planes[:, :3], np.ones(len(planes))], -planes[:, 3], bounds=(None, None))
    if inner.status != 0 or inner.x[3] < 1e-4:
        return None
    try:
        return np.unique(HalfspaceIntersection(planes, inner.x[:3]).intersections.round(6), axis=0)
    except QhullError:
        return None


def deepest_radius(vertices):
    planes = ConvexHull(vertices).equations
    return linprog([0, 0, 0, -1], np.c_[planes[:, :3], np.ones(len(planes))], -planes[:, 3], bounds=(None, None)).x[3]


def simplified(vertices, field, excess):
    """The hull of the fewest points, with the padding that contains the vertices, within the excess; None if there is none."""
    found, largest = None, deepest_radius(vertices)
    for radius in np.linspace(0, 0.97, 7) * largest:
        inner = eroded(vertices, radius)
        if inner is None or len(inner) < 2:
            continue
        if len(inner) > 300:
            inner = inner[np.linspace(0, len(inner) - 1, 300).astype(int)]
        first = ((inner - inner.mean(0)) ** 2).sum(1).argmax()
        chosen = [first, ((inner - inner[first]) ** 2).sum(1).argmax()]
        while len(chosen) <= (MOST_POINTS if found is None else len(found.points)):
            hull = Hull(inner[chosen].round(4))
            hull.padding = np.ceil(hull.distance(vertices).max() / ROUNDING + 0.01) * ROUNDING
            if hull.padding - radius <= excess:
                hull.reached = field.exactly(hull.surface(0.008)).max()
                if hull.reached <= excess:
                    if found is None or (len(chosen), hull.reached) < (len(found.points), found.reached):
                        found = hull
                    break
            chosen.append(hull.distance(inner).argmax())
    return found


def fit(triangles, excess):
    small = subdivided(triangles, EDGE)
    field = Field(small)
    bodies = bodies_of(small, field, excess)
    return bodies, verified_excess(bodies, small, field)


def verified_excess(bodies, triangles, field):
    """The largest distance of the union's surface from the mesh; refuses a triangle that lies in no body."""
    corners = triangles.reshape(-1, 3)
    inside = [(body.distance(corners) <= 0).reshape(-1, 3).all(1) for body in bodies]
    if not np.any(inside, axis=0).all():
        raise SystemExit("a triangle lies in no body")
    largest = 0.0
    for i, body in enumerate(bodies):
        points = body.surface(0.005)
        for k, other in enumerate(bodies):
            if k != i and len(points):
                points = points[other.distance(points) >= 0]
        if len(points):
            largest = max(largest, field.tree.query(points)[0].max())
    return largest


def with_shapes(text, bodies):
    """The text of an arm file with the list `shapes`, one shape on each line."""
    rows = []
    for joint, name, shapes in bodies:
        head = {"joint": joint, "name": name} if joint else {"name": name}
        lines = ",\n".join("      " + json.dumps(one) for one in shapes)
        rows.append("    " + json.dumps(head)[:-1] + ', "shapes": [\n' + lines + "]}")
    return text.rstrip()[:-1].rstrip() + ',\n  "shapes": [\n' + ",\n".join(rows) + "\n  ]\n}\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("arm", help="a built-in arm with a DH table, or with revolute joints without `point`")
    parser.add_argument("description", help="URDF or MJCF file")
    parser.add_argument("--turn", action="store_true")
    parser.add_argument("--excess", type=float, nargs="+", default=[0.015], help="m, one or one for each link; %(default)s")
    parser.add_argument("--out", help="file to write; default: the arm file itself")
    args = parser.parse_args()
    path = ARMS / f"{args.arm}.json"
    arm = json.loads(path.read_text())
    links, spread = meshes_of_links(arm, args.description, args.turn)
    print(f"{args.arm}: link frames differ by at most {1e3 * spread:.2f} mm from the description")
    excess = args.excess * len(links) if len(args.excess) == 1 else args.excess
    bodies = []
    for k, ((name, triangles), most) in enumerate(zip(links, excess, strict=True)):
        if not len(triangles):
            continue
        found, reached = fit(triangles, most)
        print(f"{k} {name}: {', '.join(map(str, found))}; excess {1e3 * reached:.1f} mm", flush=True)
        bodies.append((joint_names(arm)[k - 1] if k else None, name, [body.shape() for body in found]))
    text = path.read_text()
    start = text.find(',\n  "shapes": [')
    pathlib.Path(args.out or path).write_text(with_shapes(text if start < 0 else text[:start] + "\n}\n", bodies))


if __name__ == "__main__":
    main()
