"""An arm as written by bench_inverse, and independent forward kinematics to check answers."""

import json
from pathlib import Path

import numpy as np

TOLERANCE = 1e-6  # metres and radians


class Description:
    """axes, points (n x 3): where the joints' axes are in the world at q = 0, where the tool is at
    `home` (4 x 4). poses (N x 4 x 4), q and near (N x n): what is asked, an answer, a seed."""

    def __init__(self, folder):
        folder = Path(folder)
        data = json.loads((folder / "arm.json").read_text())
        joints = data["joints"]
        self.name = data["name"]
        self.last = data.get("last")  # the last joint stands still there
        self.n = len(joints)
        self.slides = [joint["slides"] for joint in joints]
        self.axes = np.array([joint["axis"] for joint in joints])
        self.points = np.array([joint["point"] for joint in joints])
        self.lower = np.array([joint["lower"] for joint in joints])
        self.upper = np.array([joint["upper"] for joint in joints])
        # Right angles, free from the rounding of their cosines.
        self.axes[np.abs(self.axes) < 1e-15] = 0
        self.points[np.abs(self.points) < 1e-15] = 0
        self.home = np.array(data["home"]).reshape(4, 4)
        self.poses = np.fromfile(folder / "pose.f64").reshape(-1, 4, 4)
        self.q = np.fromfile(folder / "q.f64").reshape(-1, self.n)
        self.near = np.fromfile(folder / "near.f64").reshape(-1, self.n)
        self.middle = (self.lower + self.upper) / 2

    def forward(self, q):
        """The tool's poses at configurations q (N x n): a product of exponentials."""
        pose = np.broadcast_to(self.home, (len(q), 4, 4)).copy()
        for i in reversed(range(self.n)):
            pose = motion(self.axes[i], self.points[i], self.slides[i], q[:, i]) @ pose
        return pose

    def errors(self, goals, q):
        """The larger of distance and angle, for each configuration."""
        reached = self.forward(q)
        distance = np.linalg.norm(goals[:, :3, 3] - reached[:, :3, 3], axis=1)
        chord = np.linalg.norm(goals[:, :3, :3] - reached[:, :3, :3], axis=(1, 2)) / np.sqrt(8)
        return np.maximum(distance, 2 * np.arcsin(np.minimum(1, chord)))

    def within_limits(self, q):
        return np.all((q >= self.lower - TOLERANCE) & (q <= self.upper + TOLERANCE), axis=1)

    def frames(self):
        """A frame at each joint with z along its axis, in the world at q = 0."""
        frames = []
        for axis, point in zip(self.axes, self.points):
            side = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
            side /= np.linalg.norm(side)
            frame = np.eye(4)
            frame[:3, :4] = np.column_stack([side, np.cross(axis, side), axis, point])
            frames.append(frame)
        return frames

    def steps(self):
        """From frame to frame, starting at the world and ending at the tool: n + 1 poses."""
        stops = [np.eye(4), *self.frames(), self.home]
        return [np.linalg.inv(a) @ b for a, b in zip(stops, stops[1:])]


def motion(axis, point, slides, values):
    """exp of a unit screw: Rodrigues' formula."""
    pose = np.tile(np.eye(4), (len(values), 1, 1))
    if slides:
        pose[:, :3, 3] = values[:, None] * axis
        return pose
    hat = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    sine, versine = np.sin(values)[:, None, None], (1 - np.cos(values))[:, None, None]
    pose[:, :3, :3] = np.eye(3) + sine * hat + versine * (hat @ hat)
    pose[:, :3, 3] = point - pose[:, :3, :3] @ point
    return pose


def meeting_point(axes, points):
    """The point nearest to all these lines."""
    normal = sum(np.eye(3) - np.outer(w, w) for w in axes)
    moment = sum((np.eye(3) - np.outer(w, w)) @ p for w, p in zip(axes, points))
    return np.linalg.solve(normal, moment)
