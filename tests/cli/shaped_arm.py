"""A planar arm whose links have shapes, and its motions, as files."""

import json
import math

LENGTHS = (3.5, 3.5, 2.0)


def capsule(length, radius=0.1):
    """Along a link of a planar arm, whose frame is at its end."""
    return {"capsule": {"radius": radius, "length": length},
            "pose": {"xyz": [-length / 2, 0, 0], "rpy": [0, math.pi / 2, 0]}}


def planar_arm(**keys):
    bodies = [{"joint": f"joint{i + 1}", "name": f"link{i + 1}", "shapes": [capsule(length)]}
              for i, length in enumerate(LENGTHS)]
    return json.dumps({"name": "planar", "joint_string": "RRR:3.5,3.5,2", "shapes": bodies, **keys})


def trajectory(*rows):
    names = ",".join(f"joint{i + 1}" for i in range(len(rows[0]) - 1))
    return f"t,{names}\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
