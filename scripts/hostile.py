#!/usr/bin/env python3
"""Runs the command on hostile input: mutated files, extreme numbers, odd options, lost streams.

scripts/hostile.py BEELINE [--count N] [--seed S] [--save FOLDER]

Each invocation must end without a signal, with an exit code from 0 to 3, within 15 s of CPU and
1 GB of memory; on 2 and 3 stdout is empty, and stderr is valid UTF-8 in lines shorter than 1000
bytes, of which one begins with "beeline: ". A failing case is saved with its command.
"""

import argparse
import collections
import functools
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CPU_SECONDS, WALL_SECONDS, MEGABYTES = 15, 120, 1000
EXTREME = ["0", "-0", "1e-320", "1e-12", "1e6", "1e7", "1e12", "-1e16", "1e100", "1e300", "-1e308", "1e400", "nan",
           "inf", "-inf", "", "x", "2147483648", "-1", "99999999999999999999", "0x10", "1e", "1,2", "\u00e9", " ",
           "0.1", "1", "2", "3", "100"]
JSON_ARM = """{"name": "a", "joints": [
 {"name": "j1", "type": "revolute", "axis": [0, 0, 1], "limits": {"lower": -3, "upper": 3, "velocity": 2}},
 {"name": "j2", "type": "revolute", "axis": [0, 1, 0], "origin": {"xyz": [0, 0, 0.3], "rpy": [0, 0, 0]}},
 {"name": "j3", "type": "prismatic", "axis": [1, 0, 0], "origin": {"xyz": [0.5, 0, 0], "rpy": [0, 0.1, 0]},
  "limits": {"lower": 0, "upper": 1}}], "tool": {"xyz": [0.1, 0, 0], "rpy": [0, 0, 0]}}
"""
DH_ARM = """{"name": "d", "dh": {"convention": "modified", "rows": [
 {"a": 0, "alpha": 0, "d": 0.3, "theta": 0, "type": "revolute"},
 {"a": 0.4, "alpha": 1.5707963267948966, "d": 0, "theta": 0, "type": "revolute"}]}}
"""
URDF = """<?xml version="1.0"?>
<robot name="u"><link name="l0"/><link name="l1"/><link name="l2"/><link name="tool0"/>
<joint name="j1" type="revolute"><parent link="l0"/><child link="l1"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="2" effort="1"/></joint>
<joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/><origin xyz="0.4 0 0" rpy="0 0 0"/>
<axis xyz="0 0 1"/></joint>
<joint name="f" type="fixed"><parent link="l2"/><child link="tool0"/><origin xyz="0.3 0 0"/></joint></robot>
"""
SRDF = '<robot name="u"><group name="g"><chain base_link="l0" tip_link="tool0"/></group></robot>\n'
YAML = "joint_limits:\n  joint1:\n    has_velocity_limits: true\n    max_velocity: 1.5\n"
POSES = "x,y,theta\n4,3,0\n4.5,3,0.2\n4.5,2.5,0.1\n"
POSES_6 = "x,y,z,roll,pitch,yaw\n0.4,0.1,0.5,3.1,0,0\n0.45,0.1,0.5,3.1,0,0.1\n"
PROGRAM = "x,y,theta,motion,blend\n4,3,0,line,0\n4.5,3,0.2,line,0.01\n4.5,2.5,0.1,line,0\n"
TRAJECTORY = "t,joint1,joint2,joint3\n0,0.1,0.2,0.3\n0.5,0.2,0.3,0.3\n1,0.3,0.3,0.4\n1.5,0.3,0.2,0.4\n"
FILES = {"a.json": JSON_ARM, "d.json": DH_ARM, "u.urdf": URDF, "u.srdf": SRDF, "l.yaml": YAML, "p.csv": POSES,
         "p6.csv": POSES_6, "prog.csv": PROGRAM, "t.csv": TRAJECTORY, "q.csv": "0.1,0.2,0.3\n1,1,1\n"}
ARMS = ["rrr", "rrr", "rrr", "rrr", "rrr", "panda", "panda", "ur5", "scara", "puma560", "iiwa14", "rp", "RRR:1,1e-300,1e300", "R" * 100, "R" * 2000,
        "RPHSCEU", "RRR:", "a.json", "a.json", "d.json", "u.urdf", "u.urdf", "pnada", "folder", "pipe", "/dev/null"]
Q = {"panda": "0,-0.8,0,-2.4,0,1.6,0.8", "iiwa14": "0.1,0.4,0,-1.4,0,0.6,0", "ur5": "0.2,-1.2,1.5,-0.5,1.2,0",
     "puma560": "0.1,0.2,0.3,0.4,0.5,0.6", "scara": "0.1,0.5,0.1,0.2", "rp": "0.4,1", "u.urdf": "0.1,0.4",
     "d.json": "0.1,0.4"}
OPTIONS = ["--tcp", "--mount", "--velocity", "--acceleration", "--jerk", "--speed", "--tolerance", "--rate", "--blend",
           "--max-samples", "--max-iterations", "--max-restarts", "--max-work", "--time-limit", "--seed", "--gain",
           "--max-steps", "--time-step", "--ki", "--kd", "--tool-speed", "--threads", "--work", "--task", "--limits",
           "--srdf", "--profile", "--path", "--method", "--redundancy", "--lock", "--tip", "--base", "--out", "--plot",
           "--draw", "--frame", "--through", "--q", "--from", "--pose"]
WORDS = ["planar", "spatial", "position", "000111", "quickest", "spline", "arc", "screw", "smooth", "quintic",
         "trapezoidal", "fastest", "nearest", "centred", "l.yaml", "u.srdf", "p.csv", "t.csv", "q.csv", "o.csv",
         "o.json", "o.svg", "o.npy", "folder", "folder/no/o.csv", "/dev/full", "/dev/null", "tool", "joint1=0.2", "l1"]
FLAGS = ["--json", "--all", "--degrees", "--branches", "--ignore-limits", "--complete"]


def text_mutated(chance, text):
    """One or several edits: of bytes, of numbers, of lines."""
    data = text.encode()
    for _ in range(chance.choice([0, 1, 1, 1, 2, 5])):
        kind, at = chance.randrange(8), chance.randrange(len(data) + 1)
        if kind == 0:
            data = data[:at]
        elif kind == 1:
            data = data[:at] + bytes([chance.randrange(256)]) + data[at + 1:]
        elif kind == 2:
            data = data[:at] + bytes(chance.randrange(256) for _ in range(chance.randrange(9))) + data[at:]
        elif kind in (3, 4):
            numbers = [i for i, c in enumerate(data) if chr(c).isdigit()]
            if numbers:
                at = chance.choice(numbers)
                end = at
                while end < len(data) and chr(data[end]) in "0123456789.e":
                    end += 1
                data = data[:at] + chance.choice(EXTREME).encode() + data[end:]
        elif kind == 5:
            end = min(len(data), at + chance.randrange(60))
            data = data[:end] + data[at:end] * chance.choice([1, 2, 300]) + data[end:]
        elif kind == 6:
            data = data[:at] + data[at + chance.randrange(60):]
        else:
            lines = data.splitlines(keepends=True)
            chance.shuffle(lines)
            data = b"".join(lines)
    special = chance.randrange(60)
    if special == 0:
        return b""
    if special == 1:
        return data + b"9" * 3_000_000
    if special == 2:
        return data + b"\0" * 1000
    if special == 3 and data.splitlines():
        return data + data.splitlines(keepends=True)[-1] * 30_000
    return data


def value(chance):
    kind = chance.randrange(4)
    if kind == 0:
        return chance.choice(WORDS)
    if kind == 1:
        return ",".join(chance.choice(EXTREME) for _ in range(chance.choice([2, 3, 3, 6, 7])))
    if kind == 2 and chance.randrange(5) == 0:
        return "7" * 100_000
    return chance.choice(EXTREME)


def command(chance, known):
    """A verb with what it needs, then odd options."""
    arm = chance.choice(ARMS)
    q = Q.get(arm, "0.1,0.2,0.3")
    pose = "4,3,0" if arm in ("rrr", "rp") else "0.4,0.2,0.1" if arm == "u.urdf" else "0.4,0.1,0.5,3.1,0,0"
    planar = arm in ("rrr", "rp", "u.urdf")
    through = chance.choice(["p.csv", "p.csv", "prog.csv"] * 3 if planar else ["p6.csv"] * 9)
    if chance.randrange(12) == 0:
        through = chance.choice(["p.csv", "p6.csv", "missing.csv", "folder", "pipe", "/dev/zero"])
    to = ",".join(str(round(float(x) + 0.1, 3)) for x in q.split(","))
    verbs = [
        ["fk", arm, "--q", q], ["show", arm], ["jacobian", arm, "--q", q], ["ik", arm, "--pose", pose],
        ["ik", arm, "--pose", pose, "--all"], ["ik", arm, "--pose", value(chance)],
        ["move", arm, "--from", q, "--to", to, "--out", "o.csv"],
        ["line", arm, "--through", through, "--out", "o.csv"],
        ["line", arm, "--from", q, "--through", through], ["check", arm, "t.csv", "--through", through],
        ["retime", arm, "t.csv", "--out", "o.csv"], ["replay", arm, "t.csv"], ["diff", arm, "t.csv", "t.csv"],
        ["batch", "fk", arm, "--in", "q.csv", "--out", "o.npy"], ["draw", arm, "--q", q, "--out", "o.svg"],
        ["batch", "ik", arm, "--in", through, "--out", "o.csv"], ["formula", arm], ["doctor", arm],
        ["doctor", arm, chance.choice(ARMS)], ["export", arm, "t.csv", "--as", "urscript", "--out", "o.script"],
        ["figure", "1.6", "--out", "o.svg"]]
    words = chance.choice(verbs)
    for _ in range(chance.choice([0, 0, 0, 1, 1, 2])):
        verb = " ".join(words[:2]) if words[0] == "batch" else words[0]
        option = chance.choice(known(verb) if chance.randrange(10) else OPTIONS)
        joined = chance.randrange(2)
        words += [f"{option}={value(chance)}"] if joined else [option, value(chance)]
    if chance.randrange(3) == 0:
        words.append(chance.choice(FLAGS))
    if chance.randrange(30) == 0:
        chance.shuffle(words)
    return words


def options_of(beeline):
    """known(verb) -> the options with a value that its help lists."""
    @functools.cache
    def known(verb):
        text = subprocess.run([beeline, *verb.split(), "--help"], capture_output=True, text=True).stdout
        return sorted(set(re.findall(r"^ +(--[a-z-]+) ?[A-Z]", text, re.M))) or OPTIONS

    return known


def prepare(chance, folder):
    for name, text in FILES.items():
        (folder / name).write_bytes(text_mutated(chance, text) if chance.randrange(4) == 0 else text.encode())
    (folder / "folder").mkdir()
    os.mkfifo(folder / "pipe")


def faults_of(process, spent, errors, answer, lost):
    faults = []
    if process.returncode not in (0, 1, 2, 3):
        faults.append(f"exit code {process.returncode}")
    if spent.ru_utime + spent.ru_stime > CPU_SECONDS:
        faults.append(f"{spent.ru_utime + spent.ru_stime:.1f} s of CPU")
    if spent.ru_maxrss > 1000 * MEGABYTES:
        faults.append(f"{spent.ru_maxrss // 1000} MB")
    if process.returncode in (2, 3) and answer:
        faults.append("stdout is not empty")
    try:
        lines = errors.decode().splitlines()
    except UnicodeDecodeError:
        return faults + ["stderr is not UTF-8"]
    if any(len(line.encode()) >= 1000 for line in lines):
        faults.append("a line of stderr is too long")
    said = [line for line in lines if line.startswith("beeline: ") and not line.startswith("beeline: warning: ")]
    if process.returncode in (2, 3) and len(said) != 1 and lost != "stderr":
        faults.append(f"{len(said)} messages on stderr")
    return faults


def invoke(beeline, words, folder, lost):
    """Runs the command; returns its process, what it spent, its stderr and its stdout."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS + 1, CPU_SECONDS + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
        streams = {"stdout": out, "stderr": err}
        if lost and os.path.exists("/dev/full"):
            streams[lost] = open("/dev/full", "wb")
        writer = os.open(folder / "pipe", os.O_RDWR | os.O_NONBLOCK)  # an empty pipe must end
        process = subprocess.Popen([beeline, *words], cwd=folder, stdin=subprocess.DEVNULL, preexec_fn=limited,
                                   **streams)
        time.sleep(0)
        os.write(writer, b"x,y,theta\n")
        deadline = time.monotonic() + WALL_SECONDS
        while True:
            pid, status, spent = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if writer is not None and time.monotonic() > deadline - WALL_SECONDS + 0.2:
                os.close(writer)
                writer = None
            if time.monotonic() > deadline:
                process.kill()
            time.sleep(0.002)
        if writer is not None:
            os.close(writer)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process, spent, (folder / "stderr").read_bytes(), (folder / "stdout").read_bytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("beeline")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--save", type=Path, default=Path("hostile-cases"))
    options = parser.parse_args()
    beeline = str(Path(options.beeline).resolve())
    known = options_of(beeline)
    print(f"seed {options.seed}")
    codes, failed, slowest, largest = collections.Counter(), 0, 0.0, 0
    for i in range(options.count):
        chance = random.Random(options.seed * 1_000_003 + i)
        with tempfile.TemporaryDirectory() as made:
            folder = Path(made)
            prepare(chance, folder)
            words = [word.replace("\0", "") for word in command(chance, known)]
            lost = chance.choice([None] * 20 + ["stdout", "stderr"])
            process, spent, errors, answer = invoke(beeline, words, folder, lost)
            codes[process.returncode] += 1
            slowest = max(slowest, spent.ru_utime + spent.ru_stime)
            largest = max(largest, spent.ru_maxrss // 1000)
            faults = faults_of(process, spent, errors, answer, lost)
            if faults:
                failed += 1
                kept = options.save / f"{options.seed}-{i}"
                os.unlink(folder / "pipe")
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(folder, kept)
                (kept / "command").write_text(repr(words) + f"\nlost: {lost}\n" + "\n".join(faults) + "\n")
                shown = " ".join(words)[:300]
                print(f"{kept}: {'; '.join(faults)}: beeline {shown}", flush=True)
    counts = ", ".join(f"{count} exit {code}" for code, count in sorted(codes.items()))
    print(f"{options.count} invocations: {counts}; {failed} failed; at most {slowest:.1f} s of CPU, {largest} MB")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
