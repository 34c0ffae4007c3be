"""
From failure to cure
====================

Lines that fail: the reason is data, and the next plan uses it.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
start = [0, 1.57, 0]
begin = beeline.forward_kinematics(rrr, start)


def moved(x: float) -> np.ndarray:
    return beeline.pose_of([x, 0, 0, 0, 0, 0]) @ begin


def report(title: str, motion: beeline.PathMotion) -> None:
    print(f"{title}: {motion}")
    if not motion:
        print("  code", motion.reason.code, motion.reason.fields)
    for near in motion.nearby:
        print("  would work:", near.description)


# Out of reach: with `suggest`, `nearby` has paths that work.
report("far", beeline.move_in_lines(rrr, start, [moved(2.7)], suggest=True))

# A joint limit: the reason names the joint and its limit. Without a start the arm may begin in another configuration,
# here with its elbow on the other side.
limited = rrr.with_limits({"joint2": beeline.LimitOverrides(lower=-2.5, upper=1.7)})
stopped = beeline.move_in_lines(limited, start, [moved(-1)])
report("limited", stopped)
if stopped.reason.code == "would_pass_limits":
    report("other elbow", beeline.move_in_lines(limited, None, [begin, moved(-1)]))

# Too short a duration: the reason has the shortest one.
quick = beeline.move_in_lines(rrr, start, [moved(1)], duration=0.1)
report("quick", quick)
if quick.reason.code == "duration_too_short":
    shortest = quick.reason.fields["shortest_duration"]
    assert isinstance(shortest, float)
    slower = beeline.move_in_lines(rrr, start, [moved(1)], duration=1.001 * shortest)
    report("slower", slower)
    assert slower
