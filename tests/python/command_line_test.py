"""`python -m beeline` is the command: the same output and exit codes as the program."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

MODULE = [sys.executable, "-m", "beeline"]


def run(command, **options):
    done = subprocess.run(command, capture_output=True, **options)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["fk", "panda", "--q", "0,0,0,-1,0,1,0", "--json"], 0),
        (["ik", "panda", "--pose", "0.4,0,0.5,3.14,0,0"], 0),
        (["ik", "rrr", "--pose", "100,0,0"], 1),
        (["fk", "panda", "--q", "0"], 2),
        (["fk", "no_such_arm", "--q", "0"], 2),
        (["fk", "missing.urdf", "--q", "0"], 3),
        (["--help"], 0),
        (["line", "--help"], 0),
        (["--version"], 0),
        ([], 2),
    ],
)
def test_output_and_exit_code_are_the_programs(build, words, code):
    done = run([*MODULE, *words])
    assert done == run([build / "beeline", *words])
    assert done[0] == code


def test_words_may_be_any_bytes(build):
    words = [b"fk", b"\xff\xfe.urdf", b"--q", b"0"]
    assert run([*MODULE, *words]) == run([build / "beeline", *words])


def test_output_that_cannot_be_written_is_an_error(build):
    words = ["fk", "panda", "--q", "0,0,0,-1,0,1,0"]
    with open("/dev/full", "wb") as full:
        module = subprocess.run([*MODULE, *words], stdout=full, stderr=subprocess.PIPE)
        program = subprocess.run([build / "beeline", *words], stdout=full, stderr=subprocess.PIPE)
    assert (module.returncode, module.stderr) == (program.returncode, program.stderr)


def test_an_interrupt_ends_the_command_with_what_it_found(tmp_path):
    rows = "x,y,z,roll,pitch,yaw\n" + "".join(
        f"0.{4 + i % 2},{0.3 * (-1) ** i},0.{3 + i % 3},3.14,0,0\n" for i in range(4000)
    )
    (tmp_path / "poses.csv").write_text(rows)
    words = ["line", "panda", "--through", "poses.csv", "--branches"]
    started = subprocess.Popen(
        [*MODULE, *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    maps = Path(f"/proc/{started.pid}/maps")
    while started.poll() is None and b"_core.abi3.so" not in maps.read_bytes():
        time.sleep(0.01)
    time.sleep(1.5)  # the other modules are imported
    os.kill(started.pid, signal.SIGINT)
    output = started.communicate()
    assert b"Traceback" not in output[1]
    assert started.returncode in (1, -signal.SIGINT), output


def test_a_second_call_in_one_process_has_no_flags_of_the_first(capfd):
    from beeline._core import _command_line

    first = [b"beeline", b"fk", b"rrr", b"--q", b"0,90,0", b"--degrees", b"--json"]
    assert _command_line(first) == 0
    assert capfd.readouterr().out.startswith("{")
    assert _command_line([b"beeline", b"fk", b"rrr", b"--q", b"0,1.5,0"]) == 0
    out = capfd.readouterr().out
    assert not out.startswith("{") and "deg" not in out
