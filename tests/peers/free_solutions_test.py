"""Solutions called free keep the clearance by coal's distances, and solutions called blocked do not."""

import coal
import numpy as np
import pytest

import beeline

TOLERANCE = 1e-6  # of coal's distances, m
KINDS = ("sphere", "box", "capsule", "cylinder")


@pytest.fixture
def rng(seed):
    print(f"BEELINE_SEED={seed}")
    return np.random.default_rng(seed)


def random_body(rng, size):
    """The same body in both libraries."""
    kind = KINDS[rng.integers(len(KINDS))]
    a, b, c = rng.uniform(0.3, 1, 3) * size
    if kind == "sphere":
        return beeline.Sphere(a), coal.Sphere(a)
    if kind == "box":
        return beeline.Box([a, b, c]), coal.Box(a, b, c)
    if kind == "capsule":
        return beeline.Capsule(a / 2, b), coal.Capsule(a / 2, b)
    return beeline.Cylinder(a / 2, b), coal.Cylinder(a / 2, b)


def random_pose(rng, spread):
    pose = np.eye(4)
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    pose[:3, :3] = rotation * np.sign(np.linalg.det(rotation))
    pose[:3, 3] = rng.uniform(-spread, spread, 3)
    return pose


class Cell:
    """An arm with a body on each link among obstacles."""

    def __init__(self, arm, rng):
        size = arm.reach[1]
        self.arm, self.clearance = arm, 0.01 * size
        links, obstacles = [], []
        self.links, self.obstacles = [], []
        for i in range(1, len(arm.joints) + 1):
            body, shape = random_body(rng, 0.1 * size)
            pose = random_pose(rng, 0.02 * size)
            links.append(beeline.LinkShapes(f"link{i}", i, [beeline.Shape(body, pose)]))
            self.links.append((shape, pose))
        for i in range(10):
            body, shape = random_body(rng, 0.2 * size)
            pose = random_pose(rng, 0.7 * size)
            obstacles.append(beeline.Obstacle(f"obstacle{i}", [beeline.Shape(body, pose)]))
            self.obstacles.append((shape, pose))
        self.model = beeline.CollisionModel(arm, links, beeline.Scene(obstacles), clearance=self.clearance,
                                            self_collision=False)

    def distance(self, q):
        """The least distance of a link and an obstacle by coal."""
        poses = beeline.link_poses(self.arm, q)
        least = np.inf
        for i, (shape, pose) in enumerate(self.links, 1):
            at = poses[i] @ pose
            for other, other_pose in self.obstacles:
                result = coal.DistanceResult()
                least = min(least, coal.distance(shape, coal.Transform3s(at[:3, :3], at[:3, 3]), other,
                                                 coal.Transform3s(other_pose[:3, :3], other_pose[:3, 3]),
                                                 coal.DistanceRequest(), result))
        return least


@pytest.mark.parametrize("name", ["puma560", "ur5", "panda"])
def test_coal_agrees(name, rng):
    arm = beeline.Arm.load(name)
    free = blocked = 0
    for _ in range(5):
        cell = Cell(arm, rng)
        for _ in range(8):
            q = rng.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3))
            result = beeline.inverse_kinematics(arm, beeline.forward_kinematics(arm, q), all=True, grid=8,
                                                blocked_by=cell.model)
            for solution in result.solutions:
                assert cell.distance(solution) >= cell.clearance - TOLERANCE
            for one in result.blocked:
                assert cell.distance(one.q) <= cell.clearance + TOLERANCE
            free, blocked = free + len(result.solutions), blocked + len(result.blocked)
    assert free > 20 and blocked > 20
