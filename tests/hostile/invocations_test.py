"""Hostile invocations of the command: tests/hostile/run.py does more of them."""

import shlex
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
import inputs
import run


@pytest.mark.parametrize("arguments", inputs.COMMANDS, ids=" ".join)
def test_what_is_mutated_succeeds(build, tmp_path, arguments):
    command = str(build / "beeline")
    if not inputs.is_in_build(command, arguments):
        pytest.skip("this build has no such verb")
    for name, data in inputs.valid_files(command).items():
        (tmp_path / name).write_bytes(data)
    done = subprocess.run([command, *arguments], cwd=tmp_path, capture_output=True)
    assert done.returncode == 0, done.stderr


def test_every_invocation_ends_as_it_may(build, seed):
    faults = []
    for each in range(seed, seed + 250):
        fault, arguments, _ = run.invocation(build / "beeline", each)
        if fault:
            faults.append(f"seed {each}: {fault}: beeline {shlex.join(arguments)[:300]}")
    assert not faults, "\n".join(faults)
