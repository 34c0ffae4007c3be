"""Forward kinematics, Jacobians and their time derivatives equal to Pinocchio's, for every arm in example-robot-data: each
chain from a root to a leaf with a joint that moves, at 1,000 random configurations."""

import subprocess
import zlib
from functools import lru_cache

import numpy as np
import pinocchio
import pytest
from urdf_tree import ROBOTS, UrdfTree

CONFIGURATIONS = 1000
TOLERANCE = 1e-12  # absolute: metres and radians, on arms of up to about two metres
DERIVATIVE_TOLERANCE = 1e-11  # of the time derivatives, joints at up to 1 rad/s or m/s
FRAMES = [  # in the order of kinematics_stream's answer: base, tool, space
    pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED,
    pinocchio.ReferenceFrame.LOCAL,
    pinocchio.ReferenceFrame.WORLD,
]


def label(path):
    return str(path.relative_to(ROBOTS).with_suffix(""))


def chains():
    found = []
    for path in sorted(ROBOTS.rglob("*.urdf")):
        tree = UrdfTree(path)
        for tip in tree.leaves():
            if tree.moving_joints(tip):
                found.append(pytest.param(path, tip, id=f"{label(path)}:{tip}"))
    return found


@lru_cache(maxsize=1)  # the cases come file by file
def peer(path, seed):
    return Peer(path, np.random.default_rng([seed, zlib.crc32(path.name.encode())]))


class Peer:
    """Pinocchio's answers for all tips of one file, at random values of all its joints."""

    def __init__(self, path, random):
        self.tree = UrdfTree(path)
        # Every joint is free here, mimic joints too: how they follow is put together below.
        self.model = pinocchio.buildModelFromUrdf(str(path), mimic=False)
        self.values, self.rates = {}, {}
        for name, joint in self.tree.joints.items():
            if joint.moves:
                far = 1 if joint.kind == "prismatic" else np.pi
                self.values[name] = random.uniform(-far, far, CONFIGURATIONS)
                self.rates[name] = random.uniform(-1, 1, CONFIGURATIONS)
        for name in self.values:
            leader, ratio, shift = self.tree.drive(name, self.values)
            self.values[name] = ratio * self.values[leader] + shift
            self.rates[name] = ratio * self.rates[leader]
        self.answers = self.run()

    def run(self):
        model, data = self.model, self.model.createData()
        tips = [tip for tip in self.tree.leaves() if self.tree.moving_joints(tip)]
        frames = [model.getFrameId(tip, pinocchio.FrameType.BODY) for tip in tips]
        columns = {
            tip: [model.joints[model.getJointId(j)].idx_v for j in self.tree.moving_joints(tip)]
            for tip in tips
        }
        answers = {
            tip: (
                np.empty((CONFIGURATIONS, 4, 4)),
                np.empty((CONFIGURATIONS, 2 * len(FRAMES), 6, len(columns[tip]))),
            )
            for tip in tips
        }
        for k, (q, dq) in enumerate(zip(self.configurations(), self.velocities())):
            pinocchio.computeJointJacobiansTimeVariation(model, data, q, dq)
            pinocchio.updateFramePlacements(model, data)
            for tip, frame in zip(tips, frames):
                poses, jacobians = answers[tip]
                poses[k] = data.oMf[frame].homogeneous
                for i, reference in enumerate(FRAMES):
                    jacobian = pinocchio.getFrameJacobian(model, data, frame, reference)
                    jacobians[k, i] = jacobian[:, columns[tip]]
                    derivative = pinocchio.getFrameJacobianTimeVariation(
                        model, data, frame, reference
                    )
                    jacobians[k, len(FRAMES) + i] = derivative[:, columns[tip]]
        return answers

    def configurations(self):
        q = np.empty((CONFIGURATIONS, self.model.nq))
        for name, values in self.values.items():
            joint = self.model.joints[self.model.getJointId(name)]
            if joint.nq == 2:  # continuous: a point on the unit circle
                q[:, joint.idx_q] = np.cos(values)
                q[:, joint.idx_q + 1] = np.sin(values)
            else:
                q[:, joint.idx_q] = values
        return q

    def velocities(self):
        dq = np.empty((CONFIGURATIONS, self.model.nv))
        for name, rates in self.rates.items():
            dq[:, self.model.joints[self.model.getJointId(name)].idx_v] = rates
        return dq

    def chain(self, tip):
        """The chain's coordinates, their values and velocities, the tip's poses, and the Jacobians
        and their derivatives with a column for each coordinate: a mimic joint's column counts for
        its leader, times its multiplier."""
        joints = self.tree.moving_joints(tip)
        drives = {name: self.tree.drive(name, joints) for name in joints}
        names = [name for name in joints if drives[name][0] == name]
        poses, columns = self.answers[tip]
        jacobians = np.zeros((*columns.shape[:-1], len(names)))
        for i, joint in enumerate(joints):
            leader, ratio, _ = drives[joint]
            jacobians[..., names.index(leader)] += ratio * columns[..., i]
        motion = [self.values[name] for name in names] + [self.rates[name] for name in names]
        return names, np.column_stack(motion), poses, jacobians


def stream(build, path, base, tip, q):
    program = build / "tests" / "kinematics_stream"
    return subprocess.run([program, path, base, tip], input=q.tobytes(), capture_output=True)


def beeline_kinematics(build, path, base, tip, q):
    answer = stream(build, path, base, tip, q)
    assert answer.returncode == 0, answer.stderr.decode()
    header, _, body = answer.stdout.partition(b"\n")
    names = header.decode().split("\t")
    numbers = np.frombuffer(body).reshape(len(q), 16 + 6 * 6 * len(names))
    poses = numbers[:, :16].reshape(-1, 4, 4)
    return names, poses, numbers[:, 16:].reshape(-1, 6, 6, len(names))


@pytest.mark.parametrize("path, tip", chains())
def test_kinematics_equal_pinocchio(path, tip, build, seed, worst_differences):
    expected = peer(path, seed)
    names, q, poses, jacobians = expected.chain(tip)
    base = expected.tree.root
    unknown = expected.tree.unknown_leaders(tip)
    if unknown:  # Pinocchio lets these joints move freely
        answer = stream(build, path, base, tip, q)
        assert answer.returncode == 3 and f'unknown joint "{unknown[0]}"' in answer.stderr.decode()
        return
    our_names, our_poses, our_jacobians = beeline_kinematics(build, path, base, tip, q)

    assert our_names == names
    pose_difference = np.abs(our_poses - poses).max()
    differences = np.abs(our_jacobians - jacobians).max(axis=(0, 2, 3))
    jacobian_difference = differences[: len(FRAMES)].max()
    worst_differences.append((label(path), pose_difference, jacobian_difference))
    assert pose_difference <= TOLERANCE
    assert jacobian_difference <= TOLERANCE
    assert differences[len(FRAMES) :].max() <= DERIVATIVE_TOLERANCE


def test_these_are_all_the_arms_that_the_package_has():
    assert len(chains()) == 585
