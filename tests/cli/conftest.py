"""Runs the command as a user would."""

import json
import subprocess

import pytest

from arms import text
from shaped_arm import planar_arm, trajectory


class Answer:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    @property
    def json(self):
        def refuse(constant):
            raise ValueError(f"JSON has no {constant}")

        return json.loads(self.out, parse_constant=refuse)


@pytest.fixture
def beeline(build, tmp_path):
    """beeline("fk", "rrr", ...) -> Answer, run in a folder of its own."""

    def run(*arguments, **options):
        command = [str(build / "beeline"), *map(str, arguments)]
        return Answer(
            subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, **options)
        )

    return run


@pytest.fixture
def refused(beeline):
    """Asserts one clear line on stderr, nothing on stdout, nothing written, and the exit code."""

    def check(code, *arguments, says=()):
        answer = beeline(*arguments)
        assert answer.code == code, (answer.code, answer.err)
        assert answer.out == ""
        lines = answer.err.strip().splitlines()
        assert len(lines) == 1, answer.err
        assert lines[0].startswith("beeline: ")
        for part in says:
            assert part in lines[0], lines[0]
        return lines[0]

    return check


@pytest.fixture
def written(tmp_path):
    """written("a.csv", text) -> its name, in the folder that the command runs in."""

    def write(name, text):
        (tmp_path / name).write_text(text)
        return name

    return write


@pytest.fixture
def matrix(beeline):
    """The tool's matrix at q, as a list of 16."""
    return lambda arm, q: sum(beeline("fk", arm, "--q", q, "--json").json["pose"]["matrix"], [])


@pytest.fixture
def pose_at(beeline):
    """The tool's pose at q in the form that --pose takes, exactly."""

    def pose(arm, q):
        document = beeline("fk", arm, "--q", q, "--json").json["pose"]
        if "planar" in document:
            return text(document["planar"][key] for key in ("x", "y", "theta"))
        quaternion = [document["quaternion"][key] for key in ("qw", "qx", "qy", "qz")]
        return text(document["translation"] + quaternion)

    return pose


@pytest.fixture
def ik(beeline):
    """ik("rrr", pose, ...) -> the JSON document, with the exit code and stderr that go with it."""

    def solve(arm, pose, *options):
        answer = beeline("ik", arm, "--pose", pose, "--json", *options)
        document = answer.json
        solved = document["status"] == "solved"
        assert answer.code == (0 if solved else 1)
        assert (document["solutions"] != []) == (document["nearest"] is None)
        ended = document["status"] in ("time_limit", "work_limit", "cancelled")
        assert ended or solved == (document["solutions"] != [])
        assert answer.err == ("" if solved else f"beeline: {document['reason']}\n")
        assert (document["reason"] != "") == (not solved or document["singular"])
        return document

    return solve


@pytest.fixture
def arm(written):
    """A planar arm whose links have shapes."""
    return written("arm.json", planar_arm())


@pytest.fixture
def motion(written):
    """The arm moves from the right to the left, slowly enough for the assumed limits."""
    return written("motion.csv", trajectory((0.0, 0.2, 0.4, 0.3), (4.0, 1.4, 0.4, 0.3)))
