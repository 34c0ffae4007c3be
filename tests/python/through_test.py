"""move_through(): motions through configurations."""

import beeline
import numpy as np
import pytest

PANDA = beeline.arms.panda()
WAYPOINTS = PANDA.middle + np.array([[0, 0, 0, 0, 0, 0, 0], [0.5, 0.2, 0, -0.3, 0, 0.2, 0], [0.6, 0, 0.4, 0, 0.3, 0, 0.5]])


def test_a_spline_passes_them_and_blends_pass_near():
    spline = beeline.move_through(PANDA, WAYPOINTS)
    assert spline and spline.sections == 1 and len(spline.blends) == 0
    assert min(np.linalg.norm(spline.trajectory.positions - WAYPOINTS[1], axis=1)) < 1e-8
    blended = beeline.move_through("panda", WAYPOINTS.tolist(), joint_blend=0.2)
    assert list(blended.blends) == [0.2] and blended.sections == 1
    assert min(np.linalg.norm(blended.trajectory.positions - WAYPOINTS[1], axis=1)) < 0.2
    stopping = beeline.move_through(PANDA, WAYPOINTS, joint_blend=0)
    assert stopping.sections == 2 and stopping.duration > blended.duration
    assert beeline.move_through(PANDA, WAYPOINTS, duration=9).duration == 9
    again = beeline.retime(PANDA, beeline.Trajectory(PANDA.joint_names, [0, 1, 2], WAYPOINTS), joint_blend=0.2)
    assert again.trajectory == blended.trajectory


def test_what_does_not_fit_is_refused():
    with pytest.raises(beeline.Error, match="joint_blend"):
        beeline.move_through(PANDA, WAYPOINTS, joint_blend=-1)
    with pytest.raises(beeline.Error, match="7 joint values"):
        beeline.move_through(PANDA, WAYPOINTS[:, :3])
    with pytest.raises(beeline.Error, match="two different positions"):
        beeline.move_through(PANDA, WAYPOINTS[:1])
