"""Obstacles, shapes of links and nearest pairs in axes of matplotlib."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Box, Capsule, CollisionModel, ConvexHull, Cylinder, HalfSpace, Sphere, Trajectory, link_poses, nearest_pair
from ._matplotlib import dots, line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._core import BodyDistance, Obstacle, PointCloud, Shape

    Array = NDArray[np.float64]

SAND, SAND_LINE = (0.82, 0.70, 0.50), (0.44, 0.35, 0.20)  # obstacles
STEEL, STEEL_LINE = (0.66, 0.74, 0.82), (0.33, 0.43, 0.56)  # shapes of links
CLEAR, CLOSE = (0.0, 0.55, 0.58), (0.83, 0.13, 0.15)  # pairs that keep their clearance, and others
MAX_LABELS = 12
MAX_POINTS = 5000  # of a point cloud
PICTURE = 200  # side of the region in a picture of the usual size, points
OBSTACLES, LINKS, PAIR = 0.6, 0.8, 7  # zorder: between the grid and the arm, and above the arm
TIMES = 201  # of a motion, at which the nearest pair is looked for, as `draw()` does


class Region:
    """The cube around the base of an arm that pictures show of its obstacles."""

    def __init__(self, model: CollisionModel) -> None:
        self.centre = np.asarray(model.arm.base)[:3, 3]
        self.half = 1.2 * max(model.arm.reach[1], 1e-6)

    def clamped(self, points: Array) -> Array:
        return np.clip(points, self.centre - self.half, self.centre + self.half)

    def of_cloud(self, cloud: PointCloud) -> Array:
        """The points whose spheres meet the region: of many every second, third or further one."""
        points = np.asarray(cloud.points).reshape(-1, 3)
        near = points[abs(points - self.centre).max(axis=1) <= self.half + cloud.radius]
        return np.asarray(near[:: -(-len(near) // MAX_POINTS) or 1])

    def meets(self, points: Array) -> bool:
        nearest = np.clip(self.centre, points.min(axis=(0, 1)), points.max(axis=(0, 1)))
        return bool(abs(nearest - self.centre).max() <= self.half)


def _directions(rings: int, parts: int) -> Array:
    """Unit vectors on a grid of latitudes and longitudes, which is closed: (rings + 1, parts + 1, 3)."""
    polar, around = np.linspace(0, np.pi, rings + 1)[:, None], np.linspace(0, 2 * np.pi, parts + 1)
    grid = [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar) + 0 * around]
    return np.stack(grid, axis=-1)


def _support(body: Any, along: Array) -> Array:
    """The points of a body that are furthest along each direction."""
    up = np.where(along[..., 2:] > 0, 0.5, -0.5) * np.array([0, 0, 1])
    if isinstance(body, Sphere):
        return body.radius * along
    if isinstance(body, Capsule):
        return np.asarray(body.radius * along + body.length * up)
    if isinstance(body, Box):
        return np.where(along > 0, 0.5, -0.5) * np.asarray(body.size)
    if isinstance(body, Cylinder):
        side = along * [1, 1, 0]
        size = np.linalg.norm(side, axis=-1, keepdims=True)
        return np.asarray(body.radius * np.divide(side, size, out=np.zeros_like(side), where=size > 1e-9) + body.length * up)
    vertices = np.asarray(body.vertices)
    return np.asarray(vertices[(along @ vertices.T).argmax(axis=-1)])


def faces_of(shape: Shape, region: Region) -> Array:
    """Quadrilaterals of the surface of a shape in the frame of its link: (N, 4, 3). Of hulls, between the vertices that are
    furthest in some hundred directions."""
    pose, body, padding = np.asarray(shape.pose), shape.body, shape.padding
    if isinstance(body, HalfSpace):  # a slab around the point that is nearest to the base
        middle = np.linalg.inv(pose) @ [*region.centre, 1]
        pose, half = pose.copy(), 0.6 * region.half
        pose[:3, 3] = (pose @ [*middle[:2], padding - 0.01 * region.half, 1])[:3]
        body, padding = Box([2 * half, 2 * half, 0.02 * region.half]), 0.0
    fine = isinstance(body, ConvexHull)
    along = _directions(16, 32) if fine else _directions(9, 24)
    if not fine:  # no direction is along a face
        along = along + 1e-6
    points = (_support(body, along) + padding * along) @ pose[:3, :3].T + pose[:3, 3]
    corners = [points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]]
    faces = np.stack(corners, axis=2).reshape(-1, 4, 3)
    areas = np.linalg.norm(np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1]), axis=1)
    return np.asarray(faces[areas > 1e-9 * max(areas.max(initial=0), 1e-300)])


def _outline(points: Array) -> Array:
    """The convex polygon around points of the plane, anticlockwise."""
    order = np.unique(points.round(12), axis=0)

    def half(rows: Array) -> list[Array]:
        kept: list[Array] = []
        for p in rows:
            while len(kept) > 1 and np.linalg.det([kept[-1] - kept[-2], p - kept[-1]]) <= 0:
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return np.array(half(order) + half(order[::-1])) if len(order) > 2 else order


def _shaded(colour: Any, faces: Array, alpha: float) -> Array:
    """The colour of each face, lighter where it looks up."""
    normals = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1)[:, None], 1e-300)
    light = 0.8 + 0.2 * abs(normals @ [0.3, -0.2, 0.93])
    return np.column_stack([np.clip(light[:, None] * colour, 0, 1), np.full(len(faces), alpha)])


class Bodies:
    """Faces of bodies, drawn in axes: one collection, whose faces are drawn from far to near."""

    def __init__(self, ax: Any, planar: bool, colour: Any, edge: Any, alpha: float, zorder: float) -> None:
        self.planar, self.colour, self.alpha = planar, colour, alpha
        if planar:
            module = importlib.import_module("matplotlib.collections")
            self.drawn = module.PolyCollection([], facecolor=(*colour, alpha), edgecolor=edge, linewidth=0.8, zorder=zorder)
            ax.add_collection(self.drawn, autolim=False)
        else:
            module = importlib.import_module("mpl_toolkits.mplot3d.art3d")
            self.drawn = module.Poly3DCollection([], linewidth=0, zorder=zorder)
            ax.add_collection3d(self.drawn, autolim=False)
            ax.computed_zorder = False  # the arm is drawn over its obstacles, through which it is seen
        self.drawn.set_label("_bodies")

    def show(self, bodies: list[Array]) -> None:
        if self.planar:
            self.drawn.set_verts([_outline(faces.reshape(-1, 3)[:, :2]) for faces in bodies])
            return
        faces = np.concatenate([*bodies, np.empty((0, 4, 3))])
        self.drawn.set_verts(faces)
        self.drawn.set_facecolor(_shaded(self.colour, faces, self.alpha))


class DrawnScene:
    """An arm's obstacles in axes, with the shapes of its links at a configuration."""

    def __init__(self, model: CollisionModel, ax: Any, shapes: bool) -> None:
        self.model, self.ax, self.region = model, ax, Region(model)
        self.links: Bodies | None = None
        self._draw_obstacles(model.scene.obstacles)
        if shapes:
            self.carried = [(body.link, faces_of(shape, self.region)) for body in model.links for shape in body.shapes]
            self.links = Bodies(ax, model.arm.planar, STEEL, STEEL_LINE, 0.35, LINKS)

    def _draw_obstacles(self, obstacles: list[Obstacle]) -> None:
        arm = self.model.arm
        shown: list[Array] = []
        labels: list[tuple[Array, str]] = []
        for obstacle in obstacles:
            faces = [faces_of(shape, self.region) for shape in obstacle.shapes]
            near = [self.region.clamped(part) for part in faces if len(part) and self.region.meets(part)]
            shown += near
            points = [part.reshape(-1, 3) for part in near]
            name = obstacle.name
            if obstacle.cloud is not None:
                cloud = self.region.of_cloud(obstacle.cloud)
                self._draw_cloud(cloud, obstacle.cloud.radius)
                points.append(cloud)
                if len(cloud) < len(obstacle.cloud.points):
                    name += f": {len(cloud)} of {len(obstacle.cloud.points)} points"
            if sum(map(len, points)) > 0:
                labels.append((self._place_of_label(np.concatenate(points)), name))
        Bodies(self.ax, arm.planar, SAND, SAND_LINE, 0.5, OBSTACLES).show(shown)
        self._contain(shown)
        if len(labels) > MAX_LABELS:
            return
        for at, name in labels:
            self._write(at, name, SAND_LINE, ha="center", va="bottom")

    def _draw_cloud(self, points: Array, radius: float) -> None:
        """Spheres as discs: in a plane of their size, in space of about their size at the middle of the picture."""
        if len(points) == 0:
            return
        if self.model.arm.planar:
            module = importlib.import_module("matplotlib.collections")
            discs = module.EllipseCollection(2 * radius, 2 * radius, 0, units="xy", offsets=points[:, :2],
                                             offset_transform=self.ax.transData, facecolor=(*SAND, 0.5),
                                             edgecolor=SAND_LINE, linewidth=0.3, zorder=OBSTACLES, label="_cloud")
            self.ax.add_collection(discs, autolim=False)
        else:
            size = 2 * radius * PICTURE / (2 * self.region.half)
            dots(self.model.arm, self.ax, points, color=[SAND], edgecolor=SAND_LINE, linewidth=0.2, s=max(size, 1) ** 2,
                 zorder=OBSTACLES, label="_cloud")
        self._contain([self.region.clamped(points)])

    def _place_of_label(self, points: Array) -> Array:
        """Above the middle of a body; of one that is at the base, at the corner that is near the viewer."""
        up = 1 if self.model.arm.planar else 2
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        if np.linalg.norm((middle - self.region.centre)[:up]) < 0.2 * self.region.half and not self.model.arm.planar:
            return np.asarray(points[(points @ [1, -1, 0.1]).argmax()])
        middle[up] = points[:, up].max()
        return np.asarray(middle)

    def _write(self, at: Array, text: str, colour: Any, **style: Any) -> None:
        effects = importlib.import_module("matplotlib.patheffects")
        position = at[: 2 if self.model.arm.planar else 3]
        written = self.ax.text(*position, text, color=colour, fontsize="small", zorder=PAIR, **style)
        written.set_path_effects([effects.withStroke(linewidth=2, foreground="white")])

    def _contain(self, bodies: list[Array]) -> None:
        """The axes contain the bodies."""
        if bodies:
            line(self.model.arm, self.ax, np.concatenate(bodies).reshape(-1, 3), alpha=0, label="_extent")

    def show(self, q: Array) -> list[Array]:
        """Draws the shapes of the links at a configuration, and returns their faces."""
        if self.links is None:
            return []
        poses = link_poses(self.model.arm, q)
        faces = [part @ poses[link, :3, :3].T + poses[link, :3, 3] for link, part in self.carried]
        self.links.show(faces)
        return faces

    def contain_links(self, q: Array) -> None:
        self._contain(self.show(q))

    def draw_pair(self, q: Array) -> BodyDistance | None:
        """Draws the line between the two bodies that are nearest to their clearance."""
        pair = nearest(self.model, q)
        if pair is None:
            return None
        arm, ends = self.model.arm, np.array([pair.on_first, pair.on_second])
        colour = CLEAR if pair.upper >= pair.clearance else CLOSE
        line(arm, self.ax, ends, color=colour, linewidth=1.8, zorder=PAIR, label="_nearest")
        dots(arm, self.ax, ends, color=[colour], s=14, zorder=PAIR)
        text = f"{pair.upper:.3g} m" if pair.lower > 0 else f"{-pair.lower:.3g} m deep"
        self._write(ends.mean(axis=0), f"  {text}", colour, va="top")
        return pair


def nearest(model: CollisionModel, q: Array) -> BodyDistance | None:
    """The pair with the least distance beyond its clearance; none if no pair counts."""
    return nearest_pair(model, q) if model.pair_count else None


def closest_configuration(model: CollisionModel, trajectory: Trajectory) -> Array:
    """The configuration of a motion with the least distance beyond a clearance, of 201 times."""
    times = np.linspace(trajectory.times[0], trajectory.times[-1], TIMES)
    configurations = trajectory.sample(times).position

    def excess(q: Array) -> float:
        pair = nearest(model, q)
        return np.inf if pair is None else (pair.upper if pair.lower > 0 else pair.lower) - pair.clearance

    return np.asarray(configurations[int(np.argmin([excess(q) for q in configurations]))])
