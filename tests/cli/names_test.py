"""Names: arms in any case, and suggestions for wrong ones."""

import pytest

SWAPPED = [
    (("check", "move.csv", "panda", "--through", "p.csv"), ["check ARM FILE", "move.csv panda"]),
    (("retime", "move.csv", "panda"), ["retime ARM FILE"]),
    (("replay", "move.json", "panda"), ["replay ARM FILE"]),
    (("replay", "move.csv", "robot.json"), ["replay ARM FILE"]),
    (("diff", "a.csv", "b.csv", "panda"), ["diff ARM A B"]),
    (("diff", "a.json", "b.json", "robot.urdf"), ["diff ARM A B"]),
]


@pytest.mark.parametrize("arguments, says", SWAPPED, ids=lambda value: " ".join(value)[:60])
def test_the_arm_comes_first(refused, arguments, says):
    refused(2, *arguments, says=says)


SUGGESTED = [
    (("retiem",), ['"retime"', "beeline --help"]),
    (("ik", "rrr", "--pose", "1,2,0", "--tol", "1"), ['did you mean "--tolerance"']),
    (("fk", "rrr", "--q", "0,0,0", "--deg"), ['did you mean "--degrees"']),
    (("ik", "rrr", "--pose", "1,2,0", "--ignore"), ['did you mean "--ignore-limits"']),
    (("batch", "jacobain"), ['"jacobian"', "beeline batch --help"]),
    (("line", "rrr", "--trough", "p.csv"), ['"--trough"', '"--through"', "beeline line --help"]),
    (("fk", "rrr", "-q", "0,0,0"), ['"-q"', '"--q"', "beeline fk --help"]),
    (("fk", "PANDAA", "--q", "0"), ['"panda"', "beeline fk --help"]),
    (("retime", "panda", "m.csv", "--profile", "scurve"), ["--profile", '"s-curve"']),
    (("ik", "panda", "--pose", "0,0,0,0,0,0", "--lock", "joint77"), ["--lock", '"joint7"']),
]


@pytest.mark.parametrize("arguments, says", SUGGESTED, ids=lambda value: " ".join(value)[:60])
def test_the_nearest_name_is_suggested(refused, arguments, says):
    refused(2, *arguments, says=says)


@pytest.mark.parametrize("arguments", [
    ("fk", "rrr", "--q", "0,0,0", "--seed", "1"), ("fk", "rrr", "--q", "0,0,0", "--frame", "base"),
    ("line", "rrr", "--through", "p.csv", "--grid", "4"), ("fk", "rrr", "--version"),
], ids=lambda value: " ".join(value))
def test_another_word_is_no_suggestion(refused, arguments):
    assert "did you mean" not in refused(2, *arguments, says=["unknown option"])


def test_the_option_at_fault_is_named(refused, written):
    says = refused(2, "move", "panda", "--from", "0,0,0,0,0,0,0", "--to", "0,0,0,-1,0,1,0")
    assert says.startswith("beeline: --from: the motion cannot start")
    written("t.json", '{"name": "a", "joints": [{"name": "t", "type": "revolute"}]}')
    says = refused(2, "move", "t.json", "--from", "0", "--to", "1", "--out", "m.csv")
    assert says.startswith('beeline: --out: joint "t" cannot be written')
    written("m.csv", "t,joint1,joint2,joint3\n0,0,0,0\n1,1,0,0\n")
    says = refused(2, "replay", "rrr", "m.csv", "--speed-at", "0:1,2:0")
    assert says.startswith("beeline: --speed-at: the replay pauses")
    says = refused(2, "retime", "rrr", "m.csv", "--rate=-1")
    assert says.startswith("beeline: --rate must be at least 0.001")


def test_replay_takes_one_kind_of_speed(refused, written):
    written("m.csv", "t,joint1,joint2,joint3\n0,0,0,0\n1,1,0,0\n")
    refused(2, "replay", "rrr", "m.csv", "--speed-at", "0:1", "--speed", "0.5",
            says=["--speed-at cannot be combined with --speed"])


NAMED = [
    (("fk", "rrr"), ["--q Q is missing"]),
    (("fk",), ["ARM is missing", "beeline fk --help"]),
    (("check", "rrr", "--through", "p.csv"), ["FILE is missing"]),
    (("fk", "rrr", "--q"), ["--q needs a value"]),
    (("fk", "rrr", "--q", "0,0,0", "--q", "0,0,0"), ["--q is given 2 times"]),
    (("fk", "rrr", "--q", "0,", "-1,", "2"), ["-1,", "without blanks"]),
    (("fk", "rrr", "panda", "--q", "0,0,0"), ['unexpected argument "panda"']),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "x"), ["--gain", '"x"']),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--kp", "0"), ["--kp"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "0"), ["--gain"]),
    (("ik", "rrr", "--pose", "1,2,0", "--grid", "1"), ["--grid", "beeline ik --help"]),
    (("ik", "rrr", "--pose", "1,2,0", "--tolerance", "0"), ["--tolerance"]),
    (("ik", "rrr", "--pose", "1,2,0", "--max-restarts", "-1"), ["--max-restarts", "-1"]),
    (("line", "rrr", "--through", "p.csv", "--tool-speed", "-1"), ["--tool-speed", "-1"]),
    (("line", "rrr", "--through", "p.csv", "--max-samples", "1"), ["--max-samples"]),
    (("line", "rrr", "--through", "p.csv", "--orientation-tolerance", "-1"),
     ["--orientation-tolerance"]),
    (("batch", "fk", "rrr", "--in", "p.csv"), ["--out FILE is missing", "beeline batch fk --help"]),
]


@pytest.mark.parametrize("arguments, says", NAMED, ids=lambda value: " ".join(value)[:60])
def test_an_error_names_the_option_and_the_help(refused, written, arguments, says):
    written("p.csv", "x,y,theta\n4,3,0\n3,4,0.5\n")
    refused(2, *arguments, says=says)


@pytest.mark.parametrize("name", ["Panda", "PANDA", "UR5", "Puma560", "Rrr", "IIWA14"])
def test_arms_are_found_in_any_case(beeline, name):
    assert beeline("show", name).out == beeline("show", name.lower()).out


def test_a_joint_string_is_not_a_name(beeline):
    assert beeline("show", "RRR", "--json").json["name"] == "RRR"
