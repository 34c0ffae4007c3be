"""What the tests of the module share: random numbers from the seed of the run."""

import numpy as np
import pytest


@pytest.fixture
def rng(seed):
    print(f"BEELINE_SEED={seed}")
    return np.random.default_rng(seed)
