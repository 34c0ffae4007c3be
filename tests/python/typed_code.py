"""Code that uses much of the module, as a type checker sees it (typing_test.py) and as it runs."""

import numpy
from numpy.typing import NDArray

import beeline


def arms() -> list[beeline.Arm]:
    rows = [beeline.DhRow(a=0.4), beeline.DhRow(a=0.3)]
    arm = beeline.Arm.from_dh(rows, convention="standard", name="two links")
    limits = {"joint1": beeline.LimitOverrides(velocity=1.5)}
    return [
        beeline.arms.panda(),
        beeline.Arm.load("RRR:3.5,3.5,2"),
        arm.with_limits(limits).with_speed_scale(0.5),
        beeline.Arm.from_json(arm.to_json()),
    ]


def tool_position(arm: beeline.Arm, q: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    pose = beeline.forward_kinematics(arm, q)
    return pose[:3, 3]


def main() -> None:
    for arm in arms():
        names: list[str] = arm.joint_names
        assert len(names) == arm.dof
        assert tool_position(arm, arm.middle).shape == (3,)
        assert not arm.limit_violations(arm.middle)
    try:
        beeline.Arm.load("no_such_arm")
    except beeline.Error as error:
        assert isinstance(error, ValueError) and "no_such_arm" in str(error)


if __name__ == "__main__":
    main()
