"""Lines that the arm can follow and that earlier versions refused, or answered late."""

from pathlib import Path

import pytest

CASES = Path(__file__).parent / "motion_cases"
BAXTER, XARM, GEN3 = (CASES / f"{name}.json" for name in ("baxter_left", "xarm7", "gen3"))

# The seven joints at the start are found, and so is the motion of the redundant joint.
FEASIBLE = {
    "baxter": (BAXTER, "3_110_p.csv", ("--profile", "quintic")),
    "baxter from a configuration": (
        BAXTER, "3_110_p.csv",
        ("--profile", "quintic", "--from=-0.3417240089214426,0.6591036596323093,-2.75782429151796,"
         "1.580886384170059,0.12026141231270028,0.6967481489792515,-2.5722816642585475")),
    "xarm": (XARM, "3_315_p.csv", ()),
    "xarm from a configuration": (
        XARM, "3_315_p.csv",
        ("--from=-3.3414730872790672,-1.6513911294289467,1.3654883970425884,2.305297566243337,"
         "-2.1221911775780296,1.7482684539218063,1.4911910588622403",)),
    "iiwa": ("iiwa14", "4_75_p.csv", ()),
    "gen3": (GEN3, "3_6_p.csv", ()),
}


@pytest.mark.parametrize("case", FEASIBLE)
def test_a_feasible_line_is_planned(beeline, case):
    arm, poses, options = FEASIBLE[case]
    answer = beeline("line", arm, "--through", CASES / poses, *options, "--out", "m.csv", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["limit_margin"] > 0.05
    checked = beeline("check", arm, "m.csv", "--through", CASES / poses)
    assert checked.code == 0, checked.err


def test_a_motion_is_replayed_at_a_finer_rate(beeline):
    assert beeline("line", GEN3, "--through", CASES / "3_6_p.csv", "--out", "m.csv").code == 0
    answer = beeline("replay", GEN3, "m.csv", "--speed-at", "0:1", "--rate", "1000", "--out", "r.csv")
    assert answer.code == 0, answer.err


def test_a_spline_is_checked_as_it_was_made(beeline):
    path = ("--through", CASES / "3_255_p.csv", "--path", "spline", "--tolerance", "0.001")
    made = beeline("line", "rrr", *path, "--tool-speed", "0.1", "--out", "s.csv", "--from",
                   "0.5163193671107278,0.6510234143033649,1.2485277069274998")
    assert made.code == 0, made.err
    checked = beeline("check", "rrr", "s.csv", *path)
    assert checked.code == 0, checked.err


def test_a_motion_next_to_a_limit_is_refused_for_its_rate_only(beeline):
    line = ("line", "panda", "--through", CASES / "3_112_p.csv", "--tolerance", "1e-6", "--blend",
            "0.05", "--from=0.03016255434593962,0.09511285887957799,-2.1829910366531307,"
            "-2.6082674295077295,-2.2807543932705037,2.699197592308826,0.49841229319967484")
    refused = beeline(*line, "--rate", "40", "--json")
    assert refused.code == 1 and refused.json["status"] == "not_proved"
    assert "or a rate of 100, or 0.5 times the speed" in refused.json["reason"]
    for options in (("--rate", "100"), ("--rate", "40", "--speed", "0.5")):
        answer = beeline(*line, *options, "--out", "m.csv")
        assert answer.code == 0, answer.err


def test_another_start_is_suggested_where_it_works(beeline):
    line = ("line", XARM, "--through", CASES / "3_91_p.csv", "--tolerance", "1e-6", "--profile",
            "trapezoidal", "--json")
    refused = beeline(*line, "--from=-3.8492889627284392,1.038235133016312,-4.038304936755049,"
                      "3.67508263932233,-2.8586993992031875,0.9838679142478723,2.583656615621238")
    assert refused.code == 1 and refused.json["status"] == "outside_limits"
    start = next(nearby["start"] for nearby in refused.json["nearby"] if "start" in nearby)
    answer = beeline(*line, "--from=" + ",".join(map(repr, start)))
    assert answer.code == 0, answer.err
