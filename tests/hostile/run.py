#!/usr/bin/env python3
"""Runs the command with hostile arguments and files, and reports each run that ends otherwise than it may.

    tests/hostile/run.py COMMAND [--count N] [--seed S] [--keep FOLDER]

Every run ends by itself with exit code 0 to 3, within 15 s of CPU and 1 GB of memory; with codes 2 and 3 stdout is empty and stderr has one
line that begins with "beeline: ", besides warnings. What fails is kept in FOLDER with its files.
"""

import argparse
import contextlib
import os
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import inputs

CPU, MEMORY, LONGEST = 15, 1_000_000, 1000  # seconds, kB, bytes of a line


@contextlib.contextmanager
def fed(pipe):
    """A FIFO into which somebody writes poses, again for each reader."""
    os.mkfifo(pipe)
    ended = threading.Event()

    def feed():
        while not ended.is_set():
            try:
                with open(pipe, "wb") as end:
                    end.write(inputs.PLANAR)
            except BrokenPipeError:
                pass
            time.sleep(0.05)

    writer = threading.Thread(target=feed)
    writer.start()
    yield
    ended.set()
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)  # ends the writer's open()
    writer.join()
    os.close(reader)


def run(command, arguments, changed, stream, folder):
    """Runs one command line in the folder, with the valid files and those that were changed; returns what is wrong, or None."""
    for name, data in {**inputs.valid_files(command), **changed}.items():
        (folder / name).write_bytes(data)
    (folder / "folder").mkdir()
    out, err = folder / ".out", folder / ".err"
    line = shlex.join([command, *arguments])
    redirections = {"closed out": f"{line} >&- 2>.err", "closed err": f"{line} >.out 2>&-", "full": f"{line} >/dev/full 2>.err"}
    with open(out, "wb") as stdout, open(err, "wb") as stderr:
        with fed(folder / "pipe") if "pipe" in arguments else contextlib.nullcontext():
            process = subprocess.Popen(
                ["/bin/sh", "-c", "exec " + redirections[stream]] if stream in redirections else [command, *arguments],
                cwd=folder, stdin=subprocess.DEVNULL, stdout=stdout, stderr=stderr,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (CPU, CPU + 5)))
            _, status, usage = os.wait4(process.pid, 0)
    if os.WIFSIGNALED(status):
        return f"signal {os.WTERMSIG(status)} after {usage.ru_utime + usage.ru_stime:.1f} s"
    code = os.WEXITSTATUS(status)
    if code not in (0, 1, 2, 3):
        return f"exit code {code}"
    if usage.ru_maxrss > MEMORY:
        return f"{usage.ru_maxrss} kB of memory"
    text = err.read_bytes()
    try:
        lines = text.decode().splitlines()
    except UnicodeDecodeError:
        return "stderr is not UTF-8"
    if any(len(each.encode()) >= LONGEST for each in lines):
        return f"a line of {max(map(len, lines))} characters on stderr"
    if code in (2, 3) and not stream:
        errors = [each for each in lines if each.startswith("beeline: ") and not each.startswith("beeline: warning: ")]
        if out.read_bytes():
            return f"exit code {code} with output"
        if len(errors) != 1 or not all(each.startswith("beeline: ") for each in lines):
            return f"exit code {code} with {len(errors)} reasons in {len(lines)} lines"
    return None


def invocation(command, seed):
    """Runs the invocation of a seed. Returns what is wrong, or None; the arguments; the files that were mutated."""
    rng = inputs.generator(seed)
    arguments, changed = inputs.command(rng, inputs.valid_files(str(command)))
    stream = rng.choice([""] * 17 + ["closed out", "closed err", "full"])
    with tempfile.TemporaryDirectory() as name:
        return run(str(command), arguments, changed, stream, pathlib.Path(name)), arguments + [stream], changed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1, help="of the first; the others follow")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")
    given = parser.parse_args()
    failed = 0
    for seed in range(given.seed, given.seed + given.count):
        fault, arguments, changed = invocation(given.command.resolve(), seed)
        if fault is None:
            continue
        failed += 1
        print(f"seed {seed}: {fault}: beeline {shlex.join(arguments)[:300]}", flush=True)
        if given.keep:
            folder = given.keep / str(seed)
            folder.mkdir(parents=True, exist_ok=True)
            for name, data in {**inputs.valid_files(str(given.command.resolve())), **changed}.items():
                (folder / name).write_bytes(data)
    print(f"{given.count} invocations from seed {given.seed}, {failed} failed")
    return failed != 0


if __name__ == "__main__":
    sys.exit(main())
