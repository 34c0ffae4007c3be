"""Closed and full streams: stderr never changes the exit code, stdout that is lost is an error."""

import os
import pty
import subprocess

import pytest

FULL = pytest.param(">/dev/full", marks=pytest.mark.skipif(not os.path.exists("/dev/full"),
                                                            reason="needs /dev/full"))
WARNS = "fk panda --q 0,0,0,0,0,0,0"  # joint4 is outside its limits
NO = "ik rrr --pose 100,0,0"
USAGE = "fk rrr --q 1,2"
FILE = "show missing.json"


@pytest.fixture
def shell(build, tmp_path):
    def run(command):
        return subprocess.run(["bash", "-c", f"{build}/beeline {command}"], capture_output=True,
                              text=True, cwd=tmp_path)

    return run


@pytest.mark.parametrize("stream", [">&-", FULL])
@pytest.mark.parametrize("command, code", [(WARNS, 0), (NO, 1), (USAGE, 2), (FILE, 3)])
def test_stderr_never_changes_the_exit_code(shell, command, code, stream):
    process = shell(f"{command} 2{stream}")
    assert process.returncode == code
    assert process.stdout == shell(command).stdout


@pytest.mark.parametrize("stream", [">&-", FULL])
@pytest.mark.parametrize("command", ["arms", "arms --json", WARNS, NO, "--help", "man"])
def test_a_lost_stdout_is_an_error(shell, command, stream):
    process = shell(f"{command} {stream}")
    assert process.returncode == 3
    assert "beeline: stdout: cannot be written: " in process.stderr
    assert shell(f"{command} {stream} 2{stream}").returncode == 3


def test_a_stderr_closed_by_its_reader_never_changes_the_exit_code(build):
    process = subprocess.Popen([build / "beeline", *NO.split()], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    process.stderr.close()
    process.stdout.read()
    assert process.wait() == 1


@pytest.mark.parametrize("stream", [">&-", FULL])
def test_files_are_written_whole_beside_lost_streams(shell, tmp_path, stream):
    command = "move rrr --from 0,0,0 --to 1,1,1 --out move.csv"
    assert shell(command).returncode == 0
    whole = (tmp_path / "move.csv").read_bytes()
    (tmp_path / "move.csv").unlink()
    assert shell(f"{command} {stream} 2{stream}").returncode == 3
    assert (tmp_path / "move.csv").read_bytes() == whole


@pytest.mark.parametrize("stream", [">&-", FULL])
def test_rows_are_not_mixed_with_messages(shell, written, tmp_path, stream):
    written("q.csv", "0,0,0,0,0,0,0\n" * 3)  # outside the limits: a warning
    process = shell(f"batch fk panda --in q.csv --out p.csv 2{stream}")
    assert process.returncode == 0
    assert len((tmp_path / "p.csv").read_text().splitlines()) == 4
    rows = shell(f"batch fk panda --in q.csv --out - 2{stream}")
    assert rows.returncode == 0 and rows.stdout == (tmp_path / "p.csv").read_text()


def test_progress_is_shown_on_a_terminal_that_hangs_up(build, written, tmp_path):
    written("poses.csv", "x,y,theta\n4.5,5.2,0\n2,6,0.8\n5,3,-0.3\n")
    ours, theirs = pty.openpty()
    process = subprocess.Popen([build / "beeline", "line", "rrr", "--from", "0,1.5,0", "--through",
                                "poses.csv"], stdout=subprocess.PIPE, stderr=theirs, cwd=tmp_path)
    os.close(theirs)
    os.close(ours)
    assert process.stdout.read().startswith(b"reached")
    assert process.wait() == 0


def test_a_file_beyond_the_limit_of_the_shell_is_an_error(build, tmp_path):
    command = f"ulimit -f 1; {build}/beeline move rrr --from 0,0,0 --to 1,1,1 --out move.csv"
    process = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd=tmp_path)
    assert process.returncode == 3 and "move.csv" in process.stderr
    assert list(tmp_path.iterdir()) == []


def run_with_early_reader(build, tmp_path, *command, bytes_read=1):
    """(code, stderr) of a command whose reader closes the pipe after some bytes, as head does."""
    process = subprocess.Popen([build / "beeline", *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               cwd=tmp_path)
    process.stdout.read(bytes_read)
    process.stdout.close()
    errors = process.stderr.read()
    return process.wait(), errors


# The pipe holds 64 KiB: what is shorter may be written before the reader leaves.
@pytest.mark.parametrize("command", [("man",), ("help", "line"), ("arms",), ("--help",), ("completion", "bash"),
                                     ("show", "panda", "--json"), ("fk", "panda", "--q", "0,0,0,-1,0,1,0", "--all")])
def test_a_reader_that_leaves_ends_the_command_quietly(build, tmp_path, command):
    code, errors = run_with_early_reader(build, tmp_path, *command, bytes_read=0)
    assert code in (0, 141) and errors == b"", (code, errors)


def test_a_reader_of_rows_that_leaves_ends_the_command_quietly(build, written, tmp_path):
    written("q.csv", "joint1,joint2,joint3\n" + "1,2,0.123456789\n" * 20_000)
    code, errors = run_with_early_reader(build, tmp_path, "batch", "fk", "rrr", "--in", "q.csv", "--out", "-")
    assert code == 141 and errors == b"", (code, errors)
    # A reader that closes before the first byte.
    reader, writer = os.pipe()
    os.close(reader)
    ended = subprocess.run([build / "beeline", "arms", "--json"], stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert ended.stderr == b"" and ended.returncode == 141
