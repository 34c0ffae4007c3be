"""What line, move, retime and replay write passes check, and plays again."""

import itertools
import os
import random

import pytest

from profiles import PROFILES
from random_cases import cases as number_of_cases

STARTS = {"panda": [0, 0.3, 0, -1.6, 0, 1.2, 0.785], "ur5": [0.2, -1.2, 1.5, -0.5, 1.2, 0],
          "puma560": [0.2, -0.6, 0.3, 0.4, 0.7, 0], "rrr": [1.0, -0.9, 0.4], "scara": [0.3, 0.5, 0.1, 0.1]}
PATHS = [[], ["--path", "spline", "--tolerance", "1e-3"], ["--blend", "0.02"], ["--path", "screw"]]
RATES = [[], ["--rate", "50"], ["--rate", "250"]]
INTERPOLATIONS = ["linear", "cubic", "quintic"]
# Each two of arm, interpolation and rate meet once in a third of the triples.
TRIPLES = [(arm, interpolation, rate)
           for (a, arm), (i, interpolation), (r, rate) in itertools.product(*map(enumerate, (STARTS, INTERPOLATIONS, RATES)))
           if (a + i + r) % 3 < number_of_cases(3)]
SEED = int(os.environ.get("BEELINE_SEED", "20240229"))


def listed(q):
    return ",".join(repr(float(x)) for x in q)


@pytest.fixture
def cases(beeline, tmp_path):
    """Random cases of an arm, with the file of poses w.csv through which its lines go."""

    class Cases(random.Random):
        def near(self, arm, size=0.1):
            return [x + self.uniform(-size, size) for x in STARTS[arm]]

        def poses(self, arm):
            rows = []
            for _ in range(self.randint(1, 3)):
                pose = beeline("fk", arm, "--q=" + listed(self.near(arm)), "--json").json["pose"]
                planar = "planar" in pose
                values = [pose["planar"][key] for key in ("x", "y", "theta")] if planar else [
                    *pose["translation"], *(pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz"))]
                rows.append(",".join(map(repr, values)) + "\n")
            header = "x,y,theta\n" if planar else "x,y,z,qw,qx,qy,qz\n"
            (tmp_path / "w.csv").write_text(header + "".join(rows))

    def make(*key):
        print("BEELINE_SEED", SEED)
        return Cases(f"{SEED} {key}")

    return make


@pytest.mark.parametrize("arm, interpolation, rate", TRIPLES)
def test_lines_and_their_replays_pass(beeline, cases, arm, interpolation, rate):
    case = cases(arm, interpolation, rate)
    reached = 0
    for path in PATHS:
        profile = case.choice(PROFILES)
        case.poses(arm)
        made = beeline("line", arm, "--from=" + listed(STARTS[arm]), "--through", "w.csv", "--profile", profile,
                       "--interpolation", interpolation, *path, *rate, "--out", "m.csv")
        if made.code == 1:
            continue
        assert made.code == 0, made.err
        reached += 1
        say = f"{arm} {interpolation} {path} {profile} {rate}: "
        check = beeline("check", arm, "m.csv", "--through", "w.csv", *path)
        assert check.code == 0, say + check.err
        options = case.choice([["--speed", repr(case.uniform(0.1, 1))],
                               ["--rate", case.choice(["60", "125", "1000"])],
                               ["--speed-at", "0:0.6,0.3:0,0.5:1", "--rate", "250"]])
        played = beeline("replay", arm, "m.csv", *options, "--out", "r.csv")
        if played.code == 1 and interpolation != "quintic" and len(options) > 1 and "--rate" in options:
            assert "joint" in played.err  # corners between finer samples
            continue
        assert played.code == 0, say + played.err
        # Samples at a rate are on the recording's path, the polynomials between them beside it.
        wide = [x for x in path if x not in ("--tolerance", "1e-3")]
        check = beeline("check", arm, "r.csv", "--through", "w.csv", *wide, "--tolerance", "2e-2",
                        "--orientation-tolerance", "2e-2")
        assert check.code == 0, say + f"{options} " + check.err
        again = beeline("replay", arm, "r.csv", "--speed", "0.8")
        assert again.code == 0 and not again.err, say + f"{options} " + again.err
    assert reached > 0


@pytest.mark.parametrize("arm", STARTS)
def test_moves_and_retimings_play_again(beeline, cases, arm):
    case = cases(arm, "move")
    for kind in ("move", "retime"):
        if kind == "move":
            made = beeline("move", arm, "--from=" + listed(STARTS[arm]), "--to=" + listed(case.near(arm, 0.5)),
                           "--method", "quickest", "--rate", case.choice(["50", "250", "1000"]), "--out", "m.csv")
        else:
            made = beeline("retime", arm, "m.csv", "--profile", case.choice(PROFILES), "--interpolation",
                           case.choice(["cubic", "quintic"]), "--out", "n.csv")
        if made.code == 1:  # limits of position
            break
        assert made.code == 0, made.err
        for options in (["--rate", "250"], ["--rate", "60"], ["--speed", "0.37"],
                        ["--speed-at", "0:1,0.1:0.3", "--from=" + listed(case.near(arm, 0.3))]):
            played = beeline("replay", arm, "m.csv" if kind == "move" else "n.csv", *options, "--out", "r.csv",
                             "--json")
            if played.code == 1:  # jumps of the acceleration of a cubic between finer samples
                assert kind == "retime" and "jerk" in played.err, played.err
                continue
            assert played.code == 0 and not played.err, f"{kind} {options} {played.err}"
            for name, use in played.json["limits"].items():
                assert use is None or use["fraction"] <= 1 + 1e-8 or (name == "jerk" and use["assumed"])
            again = beeline("replay", arm, "r.csv", "--speed", repr(case.uniform(0.1, 1)))
            assert again.code == 0 and not again.err, f"{kind} {options} {again.err}"
