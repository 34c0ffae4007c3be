"""Hostile invocations of the command: tests/hostile/run.py does more of them."""

import shlex
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import run


def test_every_invocation_ends_as_it_may(build, seed):
    faults = []
    for each in range(seed, seed + 250):
        fault, arguments, _ = run.invocation(build / "beeline", each)
        if fault:
            faults.append(f"seed {each}: {fault}: beeline {shlex.join(arguments)[:300]}")
    assert not faults, "\n".join(faults)
