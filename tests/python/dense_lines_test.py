"""Straight lines of seven-joint arms beside a search that shares nothing with the planner: thousands of configurations
follow the line by Newton's method in numpy, and wander along the self-motions within the limits. If one arrives, the line is
feasible, and the planner must find a motion. BEELINE_CASES=2: all arms, two lines of each."""

import time

import beeline
import numpy as np
import pytest

from random_cases import cases

ARMS = ["gen3", "panda", "iiwa14", "xarm7"][: cases(6)]
LINES = cases(3)


def hat(w):
    zero = np.zeros_like(w[..., 0])
    rows = [zero, -w[..., 2], w[..., 1], w[..., 2], zero, -w[..., 0], -w[..., 1], w[..., 0], zero]
    return np.stack(rows, -1).reshape(*w.shape[:-1], 3, 3)


def rotation_vectors(R):
    """Of rotations below pi."""
    vee = np.stack([R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]], -1) / 2
    sine = np.linalg.norm(vee, axis=-1)
    angle = np.arctan2(sine, (np.trace(R, axis1=-2, axis2=-1) - 1) / 2)
    return vee * np.where(sine > 1e-9, angle / np.maximum(sine, 1e-9), 1)[..., None]


def rotation_about(w):
    angle = np.linalg.norm(w)
    k = hat(w / angle) if angle > 0 else np.zeros((3, 3))
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


class Swarm:
    """Configurations of an arm, by the product of exponentials of its axes at zero."""

    def __init__(self, arm, rng):
        self.rng = rng
        zero = np.zeros(arm.dof)
        space = beeline.jacobian(arm, zero, frame="space")
        self.axes = hat(space[3:].T)
        self.squares = self.axes @ self.axes
        self.points = np.cross(space[3:].T, space[:3].T)
        self.home = np.asarray(beeline.forward_kinematics(arm, zero))
        self.lower, self.upper = np.array(arm.lower), np.array(arm.upper)

    def forward(self, q):
        """Rotations and positions of the tool, and Jacobians in the axes of the base."""
        n, dof = q.shape
        R, p = np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 3))
        axes, points = np.empty((n, dof, 3)), np.empty((n, dof, 3))
        for k in range(dof):
            axis = np.array([self.axes[k][2, 1], self.axes[k][0, 2], self.axes[k][1, 0]])
            axes[:, k], points[:, k] = R @ axis, R @ self.points[k] + p
            turn = np.eye(3) + np.sin(q[:, k])[:, None, None] * self.axes[k] + (1 - np.cos(q[:, k]))[:, None, None] * self.squares[k]
            p = p + np.einsum("nij,nj->ni", R, self.points[k] - turn @ self.points[k])
            R = R @ turn
        p = p + R @ self.home[:3, 3]
        R = R @ self.home[:3, :3]
        J = np.concatenate([np.cross(axes, p[:, None] - points), axes], -1).transpose(0, 2, 1)
        return R, p, J

    def error(self, R, p, to):
        return np.concatenate([to[:3, 3] - p, rotation_vectors(to[:3, :3] @ R.transpose(0, 2, 1))], -1)

    def newton(self, q, to, steps):
        """Continued to the pose by minimum-norm steps; those that arrive within the limits, and which they are."""
        start, which = q, np.arange(len(q))
        for _ in range(steps):
            R, p, J = self.forward(q)
            e = self.error(R, p, to)
            gram = J @ J.transpose(0, 2, 1) + 1e-12 * np.eye(6)
            q = q + (J.transpose(0, 2, 1) @ np.linalg.solve(gram, e[..., None]))[..., 0]
        R, p, _ = self.forward(q)
        good = np.abs(self.error(R, p, to)).max(-1) < 1e-7
        good &= ((q >= self.lower) & (q <= self.upper)).all(-1)
        return q[good], which[good], np.abs(q - start).max(-1)[good]

    def begin(self, pose, count):
        lower, upper = np.maximum(self.lower, -np.pi), np.minimum(self.upper, np.pi)
        return self.newton(self.rng.uniform(lower, upper, (count, len(lower))), pose, 12)[0]

    def wander(self, q, pose, size, rounds):
        """Copies of them moved along their self-motions."""
        for _ in range(rounds):
            null = np.linalg.svd(self.forward(q)[2])[2][:, -1]
            moved, _, far = self.newton(q + self.rng.uniform(-size, size, len(q))[:, None] * null, pose, 3)
            q = np.concatenate([q, moved[far < 2 * size]])
            if len(q) > self.most:
                q = q[self.rng.choice(len(q), self.most, replace=False)]
        return q

    most = 600

    def arrives(self, first, last, steps, size):
        """Whether one of them follows the line to its end."""
        turn = rotation_vectors(last[:3, :3] @ first[:3, :3].T)
        q = self.wander(self.begin(first, 2000), first, size, 4)
        for i in range(1, steps + 1):
            to = np.eye(4)
            to[:3, 3] = first[:3, 3] + i / steps * (last[:3, 3] - first[:3, 3])
            to[:3, :3] = rotation_about(i / steps * turn) @ first[:3, :3]
            q, _, far = self.newton(q, to, 4)
            q = q[far < 0.15]
            if len(q) == 0:
                return False
            q = self.wander(q, to, size, 2)
        return True


def random_line(rng, swarm):
    R, p, _ = swarm.forward(rng.uniform(np.maximum(swarm.lower, -np.pi), np.minimum(swarm.upper, np.pi))[None])
    first, last = np.eye(4), np.eye(4)
    first[:3, :3], first[:3, 3] = R[0], p[0]
    direction, axis = rng.normal(size=3), rng.normal(size=3)
    last[:3, 3] = p[0] + rng.uniform(0.1, 0.6) * direction / np.linalg.norm(direction)
    last[:3, :3] = rotation_about(rng.uniform(0, 1.2) * axis / np.linalg.norm(axis)) @ R[0]
    return first, last


@pytest.mark.parametrize("name", ARMS)
def test_every_line_that_a_dense_search_follows_is_found(name, rng):
    arm = beeline.Arm.load(name)
    swarm = Swarm(arm, rng)
    followed, found, refusals = 0, 0, []
    for _ in range(LINES):
        line = random_line(rng, swarm)
        begin = time.process_time()
        motion = beeline.move_in_lines(arm, None, list(line))
        took = time.process_time() - begin
        arrived = swarm.arrives(*line, 100, 0.1)
        followed, found = followed + arrived, found + bool(motion)
        if not motion:
            refusals.append(took)
            # Again with shorter steps, so that none of them jumps past a limit or a gap.
            assert not (arrived and swarm.arrives(*line, 400, 0.03)), f"{line}: {motion.reason}"
    slow = ", ".join(f"{1e3 * t:.0f}" for t in sorted(refusals)[-3:])
    print(f"{name}: {LINES} lines, {followed} followed by the search, {found} planned; slowest refusals {slow} ms")
