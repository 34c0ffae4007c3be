"""An evaluation of trajectories that shares no code with Beeline: forward kinematics from DH tables, the
polynomials that the columns mean, limits, and the deviation from straight lines of the tool."""

import numpy as np

TOLERANCE = 1e-4  # metres and radians, the default of check
SLACK = 1e-6  # of limits, as check documents it
PI = np.pi


class Arm:
    """Denavit-Hartenberg rows (a, alpha, d) and limits (velocity, acceleration, jerk)."""

    def __init__(self, name, modified, rows, tool, limits, home, planar=False, locked=None):
        self.name, self.modified, self.rows, self.tool = name, modified, rows, tool
        self.limits, self.home, self.planar = np.array(limits), np.array(home), planar
        self.free = [i for i in range(len(rows)) if i != locked]

    def fk(self, q):
        q = np.atleast_2d(q)
        pose = np.broadcast_to(np.eye(4), (len(q), 4, 4))
        for i, (a, alpha, d) in enumerate(self.rows):
            z = np.zeros((len(q), 4, 4))
            c, s = np.cos(q[:, i]), np.sin(q[:, i])
            z[:, 0, 0], z[:, 0, 1], z[:, 1, 0], z[:, 1, 1] = c, -s, s, c
            z[:, 2, 2] = z[:, 3, 3] = 1
            z[:, 2, 3] = d
            x = np.eye(4)
            x[0, 3] = a
            x[1:3, 1:3] = [[np.cos(alpha), -np.sin(alpha)], [np.sin(alpha), np.cos(alpha)]]
            pose = pose @ x @ z if self.modified else pose @ z @ x
        pose = pose.copy()
        pose[:, :3, 3] += self.tool * pose[:, :3, 2]
        return pose

    def ik(self, pose, q):
        """Newton's method from q with a numerical Jacobian."""
        q = q.copy()
        for _ in range(30):
            now = self.fk(q)[0]
            error = np.concatenate([pose[:3, 3] - now[:3, 3], rotation_vector(pose[:3, :3] @ now[:3, :3].T)])
            if np.abs(error).max() < 1e-14:
                break
            columns = []
            for i in self.free:
                step = np.zeros(len(q))
                step[i] = 1e-6
                up, down = self.fk(q + step)[0], self.fk(q - step)[0]
                columns.append(np.concatenate([(up - down)[:3, 3], rotation_vector(up[:3, :3] @ down[:3, :3].T)]) / 2e-6)
            q[self.free] += np.linalg.lstsq(np.array(columns).T, error, rcond=1e-9)[0]
        return q


ASSUMED = lambda n: [(1.0, 4.0, np.inf)] * n  # 1 rad/s in 0.25 s; an assumed jerk is not held
ARMS = [
    Arm("panda", True, [(0, 0, .333), (0, -PI / 2, 0), (0, PI / 2, .316), (.0825, PI / 2, 0),
                        (-.0825, -PI / 2, .384), (0, PI / 2, 0), (.088, PI / 2, 0)], .107,
        [(2.175, 15, 7500), (2.175, 7.5, 3750), (2.175, 10, 5000), (2.175, 12.5, 6250),
         (2.61, 15, 7500), (2.61, 20, 10000), (2.61, 20, 10000)],
        [0, .3, 0, -1.6, 0, 1.4, .785], locked=2),
    Arm("ur5", False, [(0, PI / 2, .089159), (-.425, 0, 0), (-.39225, 0, 0), (0, PI / 2, .10915),
                       (0, -PI / 2, .09465), (0, 0, .0823)], 0, ASSUMED(6), [.2, -1.2, 1.5, -.5, 1.2, 0]),
    Arm("rrr", False, [(3.5, 0, 0), (3.5, 0, 0), (2, 0, 0)], 0, ASSUMED(3), [1, -.9, .4], planar=True),
]


def rotation_vector(r):
    r = np.asarray(r)
    v = np.stack([r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]], -1) / 2
    s = np.linalg.norm(v, axis=-1)
    angle = np.arctan2(s, (np.trace(r, axis1=-2, axis2=-1) - 1) / 2)
    return v * np.where(s > 1e-15, angle / np.maximum(s, 1e-300), 1)[..., None]


def rotation(v):
    v = np.asarray(v, float)
    angle = np.linalg.norm(v, axis=-1)[..., None, None]
    k = np.zeros(v.shape[:-1] + (3, 3))
    k[..., 0, 1], k[..., 0, 2], k[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    k = k - np.swapaxes(k, -1, -2)
    return np.eye(3) + np.sinc(angle / PI) * k + np.sinc(angle / 2 / PI)**2 / 2 * k @ k


class Line:
    """A straight line of the tool, and joints q(s) along it as Chebyshev polynomials."""

    def __init__(self, arm, q, goal):
        self.begin, self.end = arm.fk(q)[0], goal
        self.d = goal[:3, 3] - self.begin[:3, 3]
        self.turn = rotation_vector(goal[:3, :3] @ self.begin[:3, :3].T)
        nodes = (1 - np.cos(np.linspace(0, PI, 33))) / 2
        points = []
        for s in nodes:
            q = arm.ik(self.pose(s), q)
            points.append(q)
        self.fits = [np.polynomial.Chebyshev.fit(nodes, column, 32, domain=[0, 1]) for column in np.array(points).T]
        self.last = q

    def pose(self, s):
        pose = np.eye(4)
        pose[:3, 3] = self.begin[:3, 3] + s * self.d
        pose[:3, :3] = rotation(s * self.turn) @ self.begin[:3, :3]
        return pose

    def joints(self, s, order=0):
        return np.stack([(f.deriv(order) if order else f)(s) for f in self.fits], -1)

    def motion(self, s, ds, dds):
        """Positions, velocities and accelerations for s(t) and its derivatives."""
        q1 = self.joints(s, 1)
        return (self.joints(s), q1 * ds[:, None],
                self.joints(s, 2) * ds[:, None] ** 2 + q1 * dds[:, None])


class File:
    """The columns of a trajectory; v and a may be None."""

    def __init__(self, t, q, v, a):
        self.t, self.q, self.v, self.a = t, q, v, a

    def copy(self):
        return File(*(None if x is None else x.copy() for x in (self.t, self.q, self.v, self.a)))

    def slower(self, k):
        return File(self.t * k, self.q, None if self.v is None else self.v / k,
                    None if self.a is None else self.a / k**2)

    def dense(self, points=40):
        """Times, joints and their derivatives up to the order that is bounded, between samples."""
        h, n = np.diff(self.t)[:, None], 2 * self.order()
        conditions = np.zeros((n, n))  # of the coefficients of u: values and derivatives at 0 and 1
        for d in range(n // 2):
            for k in range(d, n):
                factor = np.prod(np.arange(k - d + 1, k + 1, dtype=float))
                conditions[2 * d, k], conditions[2 * d + 1, k] = factor * (k == d), factor
        columns = [x for x in (self.q, self.v, self.a) if x is not None]
        values = [h**d * x[ends] for d, x in enumerate(columns) for ends in (slice(None, -1), slice(1, None))]
        c = np.einsum("ij,jkl->ikl", np.linalg.inv(conditions), np.array(values))
        u = np.linspace(0, 1, points + 1)
        rows = []
        for order in range(4):
            c = c if len(c) else np.zeros((1, len(h), self.q.shape[1]))
            x = np.einsum("pi,ikl->kpl", u[:, None] ** np.arange(len(c)), c) / h[:, :, None]**order
            rows.append(x.reshape(-1, self.q.shape[1]))
            c = c[1:] * np.arange(1, len(c))[:, None, None]
        return (self.t[:-1, None] + h * u).ravel(), rows

    def order(self):
        return 1 + (self.v is not None) + (self.a is not None)


def differences(file, order):
    """The derivative of positions as check documents it where the interpolation does not bound it."""
    t, table = file.t, file.q
    for level in range(1, order + 1):
        table = (table[1:] - table[:-1]) / (t[level:] - t[:-level])[:, None]
    largest = np.abs(table) * [1, 1, 2, 6][order]
    if order == 2:
        h = np.diff(t)
        v = np.diff(file.q, axis=0) / h[:, None]
        corner = np.abs(np.diff(v, axis=0)) / (2 * np.minimum(h[1:], h[:-1]))[:, None]
        largest = np.maximum(largest, corner)
    return largest


def limit_fractions(arm, file, dense):
    fractions = []
    for order in (1, 2, 3):
        x = np.abs(dense[order]) if order <= file.order() else differences(file, order)
        fractions.append((x / arm.limits[:, order - 1]).max() if len(x) else 0)
    return np.array(fractions)


def slowest(fractions):
    return max(fractions ** (1 / np.arange(1, 4)))


def path_error(arm, lines, q):
    """Deviation from the nearest of the lines, and the path length up to the nearest point."""
    pose = arm.fk(q)
    best = np.full((len(q), 2), np.inf)
    place = np.zeros(len(q))
    before = 0
    for line in lines:
        length = np.linalg.norm(line.d)
        s = np.clip((pose[:, :3, 3] - line.begin[:3, 3]) @ line.d / length**2, 0, 1)
        off = np.linalg.norm(pose[:, :3, 3] - line.begin[:3, 3] - s[:, None] * line.d, axis=1)
        wanted = rotation(s[:, None] * line.turn) @ line.begin[:3, :3]
        turned = np.linalg.norm(rotation_vector(pose[:, :3, :3] @ np.swapaxes(wanted, 1, 2)), axis=1)
        nearer = np.maximum(off, turned) < best.max(1)
        best[nearer] = np.stack([off, turned], 1)[nearer]
        place[nearer] = before + s[nearer] * length
        before += length
    return best, place


def truth(arm, lines, file):
    """The excess of the motion over limits and tolerance, at most 0 for a good one, and its kind."""
    _, dense = file.dense()
    found = {"limits": max(limit_fractions(arm, file, dense)) / (1 + SLACK) - 1}
    best, place = path_error(arm, lines, dense[0])
    found["deviation"] = best.max() / TOLERANCE - 1
    found["backwards"] = (np.maximum.accumulate(place) - place).max() / TOLERANCE - 1
    begin, end = arm.fk(file.q[[0, -1]])
    for which, pose, goal in (("begin", begin, lines[0].begin), ("end", end, lines[-1].end)):
        off = max(np.linalg.norm(pose[:3, 3] - goal[:3, 3]), np.linalg.norm(rotation_vector(pose[:3, :3] @ goal[:3, :3].T)))
        found[which] = off / TOLERANCE - 1
    h = file.t[[1, -1]] - file.t[[0, -2]]
    ends = file.v[[0, -1]] if file.v is not None else np.array([file.q[1] - file.q[0], file.q[-1] - file.q[-2]]) / h[:, None]
    allowed = 1e-4 * arm.limits[:, 0] + (0 if file.v is not None else 2 * arm.limits[:, 1] * h[:, None])
    found["moving"] = (np.abs(ends) / allowed).max() - 1
    kind = max(found, key=found.get)
    return found[kind], kind
