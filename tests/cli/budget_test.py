"""--time-limit, --max-work and Ctrl-C: a verb ends with what it has found, and writes no file."""

import signal
import subprocess
import time

import pytest

POSES = "x,y,z,roll,pitch,yaw\n0.5,-0.2,0.5,180,0,0\n0.5,0.2,0.4,180,0,20\n0.4,0.1,0.5,180,0,0\n"
PANDA = "0,-0.8,0,-2.4,0,1.6,0.8"


@pytest.fixture
def files(beeline, tmp_path):
    """The files that the verbs below read."""
    (tmp_path / "poses.csv").write_text(POSES)
    (tmp_path / "path.csv").write_text("joint1,joint2,joint3\n0,1,0\n0.5,0.8,-0.3\n1,0,0.2\n")
    (tmp_path / "q.csv").write_text("0,1,0\n1,0,0.2\n")
    (tmp_path / "goals.csv").write_text("x,y,theta\n4,3,0\n4.5,5.2,0.3\n")
    (tmp_path / "p.csv").write_text("x,y,theta\n4.5,5.2,0\n2,6,45\n")
    made = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", "p.csv", "--out",
                   "made.csv")
    assert made.code == 0
    return tmp_path


VERBS = {
    "ik": ["ik", "panda", "--pose", "0.4,0.1,0.5,3.1,0,0", "--all", "--method", "numerical"],
    "line": ["line", "panda", "--degrees", "--through", "poses.csv", "--out", "x.csv"],
    "line, branches": ["line", "ur5", "--degrees", "--through", "poses.csv", "--branches", "--out",
                       "x.csv"],
    "line by control": ["line", "rrr", "--from", "0,90,0", "--degrees", "--through", "p.csv",
                        "--method", "inverse-jacobian", "--out", "x.csv"],
    "move": ["move", "panda", "--from", PANDA, "--to", "0.5,0,0,-2,0,2,0", "--out", "x.csv"],
    "move, quickest": ["move", "panda", "--from", PANDA, "--to", "0.5,0,0,-2,0,2,0", "--method",
                       "quickest", "--rate", "1000", "--out", "x.csv"],
    "retime": ["retime", "rrr", "path.csv", "--out", "x.csv"],
    "check": ["check", "rrr", "made.csv", "--degrees", "--through", "p.csv"],
    "replay": ["replay", "rrr", "made.csv", "--rate", "1000", "--out", "x.csv"],
    "batch fk": ["batch", "fk", "rrr", "--in", "q.csv", "--out", "x.csv"],
    "batch jacobian": ["batch", "jacobian", "rrr", "--in", "q.csv", "--out", "x.csv"],
    "batch ik": ["batch", "ik", "rrr", "--in", "goals.csv", "--out", "x.csv"],
}


@pytest.mark.parametrize("verb", VERBS)
def test_time_zero_ends_a_verb(beeline, files, verb):
    answer = beeline(*VERBS[verb], "--time-limit", "0", "--json")
    assert answer.code == 1
    assert answer.json["status"] == "time_limit"
    assert "the time limit ended the search" in answer.err and "allow more time" in answer.err
    assert "Traceback" not in answer.err and len(answer.err.splitlines()) == 1
    assert not (files / "x.csv").exists()
    plain = beeline(*VERBS[verb], "--time-limit", "0")
    assert plain.code == 1 and plain.err == answer.err
    assert plain.out == "" or "time_limit" in plain.out or verb.startswith("batch")


def test_time_zero_permits_an_answer_by_closed_form(beeline):
    for arm, pose in (("ur5", "0.4,0.1,0.3,3.1,0,0"), ("panda", "0.4,0.1,0.5,3.1,0,0"), ("rrr", "4,3,0.2")):
        free, limited = (beeline("ik", arm, "--pose", pose, "--json", *limit).json for limit in ((), ("--time-limit", "0")))
        assert free["method"].startswith("closed form") and limited == free
    for verb in ("ik", "line", "batch ik", "retime"):
        assert "With 0 a search ends at its first check" in " ".join(beeline(*verb.split(), "--help").out.split()), verb


@pytest.mark.parametrize("verb", VERBS)
def test_an_ample_limit_changes_nothing(beeline, files, verb):
    free = beeline(*VERBS[verb], "--json")
    written = (files / "x.csv").read_bytes() if "--out" in VERBS[verb] else None
    limited = beeline(*VERBS[verb], "--json", "--time-limit", "3600")
    assert free.code == limited.code == 0, free.err
    if not verb.startswith("batch"):  # which says how long it took
        assert free.out == limited.out
    if written is not None:
        assert (files / "x.csv").read_bytes() == written


@pytest.mark.parametrize("verb", ["ik", "line", "line by control", "move", "retime"])
def test_a_limit_of_work_ends_a_verb_the_same_each_time(beeline, files, verb):
    for work in ("0", "3"):
        answers = [beeline(*VERBS[verb], "--max-work", work, "--json") for _ in range(2)]
        assert answers[0].out == answers[1].out and answers[0].err == answers[1].err
        assert answers[0].code == 1 and answers[0].json["status"] == "work_limit"
        assert "allow more work" in answers[0].err


ENDLESS = {
    "ik": ["ik", "ur5", "--pose", "0.4,0.2,0.3,3.14,0,0", "--method", "numerical", "--all",
           "--max-restarts", "2000000000"],
    "move": ["move", "panda", "--from", PANDA, "--to", "0.5,0,0,-2,0,2,0", "--kp", "1e-9",
             "--max-steps", "10000000", "--out", "x.csv"],
}


def catches_interrupts(process):
    """Whether a process has a handler for SIGINT, as a verb has from its search on."""
    with open(f"/proc/{process.pid}/status") as status:
        caught = next(line.split()[1] for line in status if line.startswith("SigCgt:"))
    return int(caught, 16) >> (signal.SIGINT - 1) & 1


def interrupted(build, folder, verb):
    """Runs a verb, and interrupts its search."""
    # What a shell starts in the background ignores SIGINT, and so would the verb.
    process = subprocess.Popen([build / "beeline", *verb, "--json"], cwd=folder,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    while process.poll() is None and not catches_interrupts(process):
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate()
    return process.returncode, out, err


@pytest.mark.parametrize("verb", ENDLESS)
def test_an_interrupt_ends_a_verb_with_its_answer(build, files, verb):
    code, out, err = interrupted(build, files, ENDLESS[verb])
    assert code == 1 and '"cancelled"' in out
    assert "the search was cancelled" in err
    assert not (files / "x.csv").exists()
    assert sorted(path.name for path in files.iterdir()) == [
        "goals.csv", "made.csv", "p.csv", "path.csv", "poses.csv", "q.csv"]


def test_an_interrupt_ends_a_batch_without_a_file(build, files):
    row = "0.4,0.2,0.3,3.14,0.1,0.2\n"
    (files / "many.csv").write_text("x,y,z,roll,pitch,yaw\n" + row * 200_000)
    code, out, err = interrupted(build, files, ["batch", "ik", "ur5", "--in", "many.csv", "--out",
                                                "x.csv", "--threads", "1", "--method", "numerical",
                                                "--tolerance", "1e-300"])
    assert code == 1 and '"cancelled"' in out
    assert "no file is written" in err
    assert not (files / "x.csv").exists()
    assert not [path for path in files.iterdir() if "part" in path.name]
