"""Recordings whose columns say their units and quantities, or say neither, through all verbs that read them."""

import csv
import json
import math

import pytest

JOINTS = [f"joint{i}" for i in range(1, 7)]
ROS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
READ_IN_RADIANS = ("beeline: warning: {} is read in radians: neither the names of its columns nor its values say that its angles are in "
                   "degrees; --angle-unit deg reads degrees\n")


def table(header, rows, separator=","):
    return "".join(separator.join(map(str, row)) + "\n" for row in ([header] if header else []) + rows)


def motion(unit=1.0):
    """Times and the six joint values of a slow motion."""
    return [[0.1 * k] + [unit * (0.3 * j + 0.02 * k * (j - 2)) for j in range(6)] for k in range(20)]


def positions(path):
    return [[float(row[name]) for name in JOINTS] for row in csv.DictReader(path.open())]


def small_degrees(folder, header, name="small.csv"):
    """A recording in degrees whose values are possible in radians too."""
    (folder / name).write_text(table(header, motion(1.5)))
    return name


def verbs_of(recording, folder):
    """Commands of all verbs that read a recording of the ur5e, with --degrees."""
    (folder / "far.csv").write_text("x,y,z\n0,0,9\n")
    yield ("replay", "ur5e", recording, "--degrees")
    yield ("retime", "ur5e", recording, "--degrees")
    yield ("check", "ur5e", recording, "--through", "far.csv", "--task", "position", "--degrees")
    yield ("diff", "ur5e", recording, recording, "--degrees")
    yield ("export", "ur5e", recording, "--as", "urscript", "--out", "o.script", "--degrees")
    yield ("draw", "ur5e", recording, "--out", "o.svg", "--degrees")


def test_no_verb_reads_small_angles_in_radians_silently(beeline, tmp_path):
    plain = small_degrees(tmp_path, ["t"] + JOINTS)
    said = small_degrees(tmp_path, ["t"] + [f"{name}_deg" for name in JOINTS], "said.csv")
    for command in verbs_of(plain, tmp_path):
        assert READ_IN_RADIANS.format(plain) in beeline(*command).err, command
        for unit in ("deg", "rad"):
            assert "read in" not in beeline(*command, "--angle-unit", unit).err, command
    for command in verbs_of(said, tmp_path):
        err = beeline(*command).err
        assert "columns joint1_deg, joint2_deg, joint3_deg" in err and "are read in deg, as their names say" in err
        assert "is read in radians" not in err
    for form in ("o.json", "o.yaml"):
        assert beeline("replay", "ur5e", plain, "--out", form).code == 0
        assert READ_IN_RADIANS.format(form) in beeline("replay", "ur5e", form, "--degrees").err


DEGREE_NAMES = ["{}_deg", "{} (deg)", "{}[deg]", "{} [°]", "{}°", "{} (degrees)", "{}_DEG", "robot/{}_deg", "{}/position (deg)", "position_{}_deg"]


@pytest.mark.parametrize("style", DEGREE_NAMES)
@pytest.mark.parametrize("names", [JOINTS, ROS], ids=["own names", "names of ROS"])
def test_names_of_columns_give_units(beeline, tmp_path, style, names):
    small_degrees(tmp_path, ["t"] + [style.format(name) for name in names])
    for options in ((), ("--degrees",), ("--angle-unit", "rad")):
        answer = beeline("replay", "ur5e", "small.csv", "--out", "out.csv", *options)
        assert answer.code == 0 and "are read in deg, as their names say" in answer.err
        for found, row in zip(positions(tmp_path / "out.csv"), motion(1.5)):
            assert found == pytest.approx(list(map(math.radians, row[1:])), abs=1e-12)


def test_angle_unit(beeline, refused, tmp_path):
    plain = small_degrees(tmp_path, ["t"] + JOINTS)
    said = small_degrees(tmp_path, ["t"] + [f"{name}_rad" for name in JOINTS], "said.csv")
    (tmp_path / "map.json").write_text(json.dumps({name: {"unit": "rad"} for name in JOINTS}))
    for command, unit in (((plain, "--angle-unit", "deg"), "deg"), ((plain, "--angle-unit", "rad"), "rad"), ((said, "--angle-unit", "deg"), "rad"),
                          ((plain, "--angle-unit", "deg", "--joint-map", "map.json"), "rad")):
        assert beeline("replay", "ur5e", *command, "--out", "out.csv").code == 0
        for found, row in zip(positions(tmp_path / "out.csv"), motion(1.5)):
            assert found == pytest.approx(row[1:] if unit == "rad" else list(map(math.radians, row[1:])), abs=1e-12)
    refused(2, "replay", "ur5e", plain, "--angle-unit", "grad", says=["rad, deg"])
    refused(3, "replay", "ur5e", small_degrees(tmp_path, ["t", "joint1_mm"] + JOINTS[1:]), says=['"joint1_mm" is in mm, but joint joint1 turns: rad or deg'])


def test_what_a_verb_writes_is_read_alike_with_and_without_degrees(beeline, tmp_path):
    (tmp_path / "in.csv").write_text(table(["t"] + JOINTS, motion()))
    for options in ((), ("--degrees",)):
        for form in ("out.csv", "out.json", "out.yaml"):
            assert beeline("replay", "ur5e", "in.csv", "--out", form, *options).code == 0
            for reading in ((), ("--degrees",)):
                assert beeline("diff", "ur5e", "in.csv", form, "--tolerance", "1e-12", *reading).code == 0


RATE_NAMES = ["{}_velocity", "{}/velocity", "{}.velocity", "velocity_{}", "{}_speed", "{}_Vel", "{}_vel (rad/s)", "{} (rad/s)"]


@pytest.mark.parametrize("style", RATE_NAMES)
def test_rates_of_other_programs(beeline, tmp_path, style):
    extra = [f"{name}_effort" for name in JOINTS]
    rows = [row + [0.2 * (j - 2) for j in range(6)] + [7] * 6 for row in motion()]
    (tmp_path / "log.csv").write_text(table(["t"] + JOINTS + [style.format(name) for name in JOINTS] + extra, rows))
    for options in ((), ("--joint-map", ",".join(JOINTS))):
        assert beeline("replay", "ur5e", "log.csv", "--out", "out.csv", *options).code == 0
        read = list(csv.DictReader((tmp_path / "out.csv").open()))
        assert [[float(row[f"{name}_vel"]) for name in JOINTS] for row in read] == [row[7:13] for row in rows]


def test_a_comment_is_a_header_only_if_it_names_the_joints(beeline, tmp_path):
    rows = table(None, [row[:4] for row in motion()], separator=" ")
    for comment in ("# measured at t 5", "# t is in", "# t t1 t2 t3"):
        (tmp_path / "log.txt").write_text(comment + "\n" + rows)
        answer = beeline("replay", "rrr", "log.txt", "--json")
        assert answer.code == 0 and "log.txt has no header" in answer.err, comment
    for comment in ("# t joint1 joint2 joint3", "% Time Joint1 Joint2 Joint3", "#t,joint1,joint2,joint3"):
        (tmp_path / "log.txt").write_text(comment + "\n" + rows)
        answer = beeline("replay", "rrr", "log.txt", "--json")
        assert answer.code == 0 and not answer.err, comment
    (tmp_path / "log.txt").write_text("# t A1 A2 A3\n" + rows)
    mapped = beeline("replay", "rrr", "log.txt", "--joint-map", "a3,-a2,A1", "--out", "out.csv")
    assert mapped.code == 0 and not mapped.err
    assert [float(x) for x in (tmp_path / "out.csv").read_text().splitlines()[2].split(",")][1:] == [motion()[1][3], -motion()[1][2], motion()[1][1]]


def test_batch_knows_the_names_of_descriptions_for_ros(beeline, tmp_path):
    q = motion()[5][1:]
    (tmp_path / "own.csv").write_text(table(JOINTS, [q]))
    (tmp_path / "ros.csv").write_text(table(ROS[::-1], [q[::-1]]))
    for kind in ("fk", "jacobian"):
        own, ros = (beeline("batch", kind, "ur5e", "--in", file, "--out", "-") for file in ("own.csv", "ros.csv"))
        assert own.code == 0 and ros.code == 0 and own.out == ros.out
