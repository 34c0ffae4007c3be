"""Ctrl-C and exceptions of callbacks end long work, also while other threads compute."""

import signal
import subprocess
import sys
import textwrap
import threading
import time

import beeline
import numpy as np
import pytest

PANDA = beeline.arms.panda()

# Each lasts for seconds.
WORK = {
    "retime": """
rng = np.random.default_rng(1)
q = arm.middle + rng.uniform(-0.5, 0.5, (2000, 7))
beeline.retime(arm, beeline.Trajectory(arm.joint_names, range(len(q)), q))""",
    "move_along": """
tool = beeline.forward_kinematics(arm, arm.middle)
up = np.array(tool); up[2, 3] += 0.1
beeline.move_in_lines(arm, None, [tool, up] * 2500, max_samples=2**31 - 1)""",
    "control_joints": """
beeline.control_joints(arm, arm.middle, arm.middle + 0.1, kp=1e-9, max_steps=10**7)""",
    "batch_inverse": """
tool = beeline.forward_kinematics(arm, arm.middle)
beeline.batch_inverse(arm, np.broadcast_to(tool, (2_000_000, 4, 4)))""",
    "reach_map": """
beeline.reach_map(arm, resolution=0.03)""",
    "refined": """
q = arm.middle + np.random.default_rng(1).uniform(-0.5, 0.5, (2000, 7))
path = beeline.joint_spline(q, beeline.chord_length(q))
while True:
    beeline.refined(path, max_parts=4000, max_change=1e-4, min_steps=1_000_000)""",
}


@pytest.mark.parametrize("work", WORK)
def test_ctrl_c_raises_keyboard_interrupt(work):
    program = "import beeline, numpy as np\narm = beeline.arms.panda()\nprint('ready', flush=True)" + WORK[work]
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(1)
    assert child.poll() is None, child.stderr.read()
    began = time.monotonic()
    child.send_signal(signal.SIGINT)
    _, errors = child.communicate()
    print(f"{work}: ended {1000 * (time.monotonic() - began):.0f} ms after Ctrl-C")
    assert child.returncode == -signal.SIGINT and errors.strip().endswith("KeyboardInterrupt"), errors


# A thread that never ends its work by itself.
DAEMONS = WORK | {
    "with progress": """
tool = beeline.forward_kinematics(arm, arm.middle)
up = np.array(tool); up[2, 3] += 0.1
beeline.move_in_lines(arm, None, [tool, up] * 2500, max_samples=2**31 - 1, progress=lambda done: time.sleep(1e-3))""",
    "short calls": """
tool = beeline.forward_kinematics(arm, arm.middle)
while True:
    beeline.inverse_kinematics(arm, tool)""",
    "an argument's Python code": """
class Slow:
    def __array__(self, *args, **keywords):
        while True:
            time.sleep(1e-3)
beeline.forward_kinematics(arm, Slow())""",
    "not impressed by exceptions": """
while True:
    try:
        beeline.control_joints(arm, arm.middle, arm.middle + 0.1, kp=1e-9, max_steps=10**7)
    except BaseException:
        pass""",
}


@pytest.mark.parametrize("work", DAEMONS)
def test_a_daemon_thread_does_not_abort_the_end_of_the_process(work):
    program = f"""import threading, time
import beeline, numpy as np
arm = beeline.arms.panda()
def work():
{textwrap.indent(DAEMONS[work].strip(), "    ")}
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
"""
    child = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (child.returncode, child.stderr) == (0, "")


def test_beeline_computes_after_its_own_exit_hook():
    """Functions registered before beeline was imported run after the hook."""
    program = """import atexit
atexit.register(lambda: print(len(beeline.control_joints(arm, arm.middle, arm.middle).trajectory.times)))
import beeline
arm = beeline.arms.panda()
"""
    child = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (child.returncode, child.stdout, child.stderr) == (0, "1\n", "")


class Stop(Exception):
    pass


def test_an_exception_of_the_progress_callback_ends_the_work():
    tool = beeline.forward_kinematics(PANDA, PANDA.middle)
    up = np.array(tool)
    up[2, 3] += 0.1
    seen = []

    def stop(fraction):
        seen.append(fraction)
        if len(seen) == 3:
            raise Stop

    with pytest.raises(Stop):
        beeline.move_in_lines(PANDA, None, [tool, up] * 2500, max_samples=2**31 - 1, progress=stop)
    assert len(seen) == 3 and 0 <= min(seen) and max(seen) < 1


def test_other_threads_run_meanwhile():
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    beeline.control_joints(PANDA, PANDA.middle, PANDA.middle + 0.1, kp=1e-9, max_steps=300_000)
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 1


def test_threads_compute_at_once(seed):
    rng = np.random.default_rng(seed)
    q = PANDA.middle + rng.uniform(-0.3, 0.3, (6, 7))
    waypoints = beeline.Trajectory(PANDA.joint_names, range(6), q)
    expected = beeline.retime(PANDA, waypoints)
    results = []
    threads = [threading.Thread(target=lambda: results.append(beeline.retime(PANDA, waypoints))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [expected] * 4
