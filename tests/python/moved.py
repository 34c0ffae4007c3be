"""A pose of the tests, at another position."""

import numpy as np


def moved(pose, x=0.0, y=0.0, z=0.0):
    other = np.array(pose)
    other[:3, 3] += [x, y, z]
    return other
