"""Recordings of other programs: their names, units, separators and wrapped values, through all verbs that read them."""

import csv
import json
import math

import pytest

JOINTS = [f"joint{i}" for i in range(1, 7)]
ROS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
CONTINUOUS = """<robot name="c"><link name="b"/><link name="l1"/><link name="l2"/>
<joint name="j1" type="continuous"><parent link="b"/><child link="l1"/><axis xyz="0 0 1"/><limit effort="1" velocity="3"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" effort="1" velocity="3"/></joint></robot>
"""


def table(header, rows, separator=",", comma=False):
    lines = [separator.join(header)] if header else []
    for row in rows:
        line = separator.join(repr(float(x)) for x in row)
        lines.append(line.replace(".", ",") if comma else line)
    return "\n".join(lines) + "\n"


def motion(unit=1.0):
    """Times and the six joint values of a slow motion."""
    return [[0.1 * k] + [unit * (0.3 * j + 0.02 * k * (j - 2)) for j in range(6)] for k in range(20)]


def positions(path):
    rows = list(csv.DictReader(path.open()))
    return [[float(row[name]) for name in JOINTS] for row in rows]


@pytest.fixture
def wrapped(tmp_path):
    """Names of an arm whose first joint is continuous, and of a recording of it whose sensor wraps at pi."""
    (tmp_path / "c.urdf").write_text(CONTINUOUS)
    rows = [[0.05 * k, math.remainder(2.9 + 0.05 * k, 2 * math.pi), 0] for k in range(21)]
    (tmp_path / "wrap.csv").write_text(table(["t", "j1", "j2"], rows))
    return "c.urdf", "wrap.csv"


def test_a_wrapped_joint_is_unwrapped(beeline, wrapped, tmp_path):
    answer = beeline("replay", *wrapped, "--out", "out.csv", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["unwrapped"] == [{"joint": "j1", "wraps": 1, "first_time": 0.25}]
    assert ("beeline: warning: wrap.csv: the values of joint j1 wrap once, at 0.25 s; they are unwrapped, as only this "
            "keeps its velocity limit") in answer.err
    rows = list(csv.DictReader((tmp_path / "out.csv").open()))
    assert float(rows[-1]["j1"]) == pytest.approx(3.9, abs=1e-12)
    retimed = beeline("retime", *wrapped, "--json")
    assert retimed.code == 0 and retimed.json["unwrapped"] == answer.json["unwrapped"]
    assert retimed.json["duration"] < 1.5
    as_recorded = beeline("retime", *wrapped, "--no-unwrap", "--json")
    assert as_recorded.json["unwrapped"] == [] and as_recorded.json["duration"] > 2 * retimed.json["duration"]
    refused = beeline("replay", *wrapped, "--no-unwrap", "--json")
    assert refused.code == 1 and refused.json["status"] == "outside_limits"


def test_verbs_agree_on_a_wrapped_joint(beeline, wrapped, tmp_path):
    assert beeline("replay", *wrapped, "--out", "out.csv").code == 0
    compared = beeline("diff", *wrapped, "out.csv", "--json")
    assert compared.json["joints"][0]["largest"] < 1e-9 and "wrap once" in compared.err
    (tmp_path / "p.csv").write_text("x,y,z\n0.5,0,0\n")
    checked = beeline("check", *wrapped, "--through", "p.csv", "--task", "position")
    assert checked.code == 1 and "j1 wrap at 0.25 s, and the file is checked as it is" in checked.err
    exported = beeline("export", *wrapped, "--as", "ros2", "--out", "out.yaml")
    assert exported.code == 0 and "wrap once" in exported.err
    assert beeline("diff", "c.urdf", "out.csv", "out.yaml", "--json").json["joints"][0]["largest"] < 1e-9


def test_a_path_without_times_is_not_unwrapped(beeline, wrapped, tmp_path):
    (tmp_path / "path.csv").write_text("j1,j2\n3,0\n-3,0\n")
    answer = beeline("retime", "c.urdf", "path.csv", "--json")
    assert answer.code == 0 and answer.json["unwrapped"] == [] and answer.json["duration"] > 2


STYLES = {
    "time": dict(header=["time"] + JOINTS),
    "timestamp, names of ROS, blanks": dict(header=["timestamp"] + ROS, separator=" "),
    "semicolons and decimal commas": dict(header=["t"] + JOINTS, separator=";", comma=True),
    "tabs": dict(header=["Time (s)"] + ROS, separator="\t"),
    "a header in a comment": dict(header=["# t"] + JOINTS, separator=" "),
    "a text before all names": dict(header=["time"] + ["robot1/" + name for name in ROS]),
    "positions of joint states": dict(header=["__time"] + [f"/joint_states/{name}/position" for name in ROS]),
}


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("ending", ["csv", "txt"])
def test_tables_of_other_programs(beeline, tmp_path, style, ending):
    (tmp_path / f"log.{ending}").write_text(table(rows=motion(), **STYLES[style]))
    answer = beeline("replay", "ur5e", f"log.{ending}", "--out", "out.csv")
    assert answer.code == 0 and not answer.err, answer.err
    assert positions(tmp_path / "out.csv") == [row[1:] for row in motion()]


def test_a_table_without_a_header(beeline, tmp_path):
    (tmp_path / "log.txt").write_text(table(None, motion(), separator=" "))
    answer = beeline("replay", "ur5e", "log.txt", "--out", "out.csv")
    assert answer.code == 0, answer.err
    assert "log.txt has no header; its columns are read as t, joint1, joint2" in answer.err
    assert positions(tmp_path / "out.csv") == [row[1:] for row in motion()]


DIALECTS = {
    "upper case": ("{},{},{}\n", "4,1.5,0.25\n"),
    "semicolons and decimal commas": ("{};{};{}\n", "4;1,5;0,25\n"),
    "blanks": ("{} {}  {}\n", " 4   1.5 0.25\n"),
    "tabs, quotes, a mark, CRLF": ('\ufeff"{}"\t"{}"\t"{}"\r\n', '"4"\t1.5\t0.25\r\n'),
    "CR alone": ("{},{},{}\r", "4,1.5,0.25\r"),
    "the header in a comment": ("# by hand\n# {} {} {}\n", "4 1.5 0.25\n"),
    "a comment of MATLAB": ("%% by hand\n{},{},{}\n", "4,1.5,0.25\n%% the end\n"),
    "the separator for Excel": ("sep=;\n{};{};{}\n", "4;1,5;0,25\n"),
    "the separator for Excel, CRLF": ("sep=,\r\n{},{},{}\r\n", "4,1.5,0.25\r\n"),
    "no header": ("", "4 1,5 0,25\n"),
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_all_readers_have_the_same_dialects(beeline, tmp_path, dialect):
    """Poses of `line`, `check` and `batch ik`, configurations of `batch fk`, and recordings."""
    header, row = DIALECTS[dialect]

    def write(file, *names):
        names = [name.upper() for name in names] if dialect == "upper case" else names
        (tmp_path / file).write_bytes((header.format(*names) + row).encode())

    write("p.csv", "x", "y", "theta")
    line = beeline("line", "rrr", "--from", "0.2,0.3,0.4", "--through", "p.csv", "--out", "m.csv", "--json")
    assert line.code == 0, line.err
    assert beeline("check", "rrr", "m.csv", "--through", "p.csv").code == 0
    solved = beeline("batch", "ik", "rrr", "--in", "p.csv", "--out", "q.csv", "--json")
    assert solved.code == 0 and solved.json["solved"] == 1, solved.err
    write("q.csv", "joint1", "joint2", "joint3")
    placed = beeline("batch", "fk", "rrr", "--in", "q.csv", "--out", "-", "--layout", "planar")
    assert placed.code == 0, placed.err
    expected = beeline("fk", "rrr", "--q", "4,1.5,0.25", "--json").json["pose"]["translation"]
    assert [float(x) for x in placed.out.splitlines()[1].split(",")][:2] == pytest.approx(expected[:2], abs=1e-12)
    write("m.csv", "t", "joint1", "joint2")
    recorded = beeline("diff", "RR:1,1", "m.csv", "m.csv", "--json")
    assert recorded.code == 0, recorded.err


@pytest.mark.parametrize("unit, factor, options", [("time_ms", 1e3, ()), ("time", 1e3, ("--time-unit", "ms")), ("t_ns", 1e9, ())])
def test_units_of_times(beeline, tmp_path, unit, factor, options):
    rows = [[round(factor * row[0]), *row[1:]] for row in motion()]
    (tmp_path / "log.csv").write_text(table([unit] + ROS, rows))
    answer = beeline("replay", "ur5e", "log.csv", *options, "--json")
    assert answer.code == 0 and not answer.err, answer.err
    assert answer.json["duration"] == pytest.approx(1.9)


def test_a_time_unit_is_refused_where_the_format_has_one(beeline, refused, tmp_path):
    (tmp_path / "log.csv").write_text(table(["t"] + JOINTS, motion()))
    for form in ("out.yaml", "out.json"):
        assert beeline("replay", "ur5e", "log.csv", "--out", form).code == 0
        refused(3, "replay", "ur5e", form, "--time-unit", "ms", says=[form, "times in seconds and nanoseconds", "--time-unit"])
        assert beeline("replay", "ur5e", form, "--time-unit", "s").code == 0
    stamped = [[int(row[0]), round(1e9 * (row[0] % 1)), *row[1:]] for row in motion()]
    (tmp_path / "stamp.csv").write_text(table(["sec", "nanosec"] + JOINTS, stamped))
    refused(3, "replay", "ur5e", "stamp.csv", "--time-unit", "ms", says=["stamp.csv", "sec and nanosec are seconds and nanoseconds"])
    (tmp_path / "path.csv").write_text(table(JOINTS, [row[1:] for row in motion()]))
    refused(3, "retime", "ur5e", "path.csv", "--time-unit", "ms", says=["path.csv", "has no times"])
    (tmp_path / "ms.csv").write_text(table(["t"] + JOINTS, [[1000 * row[0], *row[1:]] for row in motion()]))
    for pair in (("ms.csv", "out.json"), ("out.json", "ms.csv")):
        assert beeline("diff", "ur5e", *pair, "--time-unit", "ms", "--tolerance", "1e-9").code == 0
    refused(3, "diff", "ur5e", "out.json", "out.yaml", "--time-unit", "ms", says=["out.yaml", "--time-unit"])


def test_epochs_of_messages_get_the_same_note(beeline, tmp_path):
    rows = [[1_700_000_000 + int(row[0]), round(1e9 * (row[0] % 1)), *row[1:]] for row in motion()]
    lines = [",".join(["sec", "nanosec"] + JOINTS)] + [",".join(map(repr, row)) for row in rows]
    (tmp_path / "epoch.csv").write_text("\n".join(lines) + "\n")
    answer = beeline("replay", "ur5e", "epoch.csv", "--json")
    assert answer.code == 0 and answer.json["duration"] == pytest.approx(1.9)
    assert "columns sec, nanosec have times since 1970 in s and ns, which count from the first sample" in answer.err


def test_times_in_another_unit_get_a_hint(beeline, tmp_path):
    epoch = [["time"] + ROS] + [[str(1_700_000_000_000_000_000 + round(1e9 * row[0])), *map(repr, row[1:])] for row in motion()]
    (tmp_path / "epoch.csv").write_text("\n".join(map(",".join, epoch)) + "\n")
    answer = beeline("replay", "ur5e", "epoch.csv", "--json")
    assert answer.code == 0 and answer.json["duration"] == pytest.approx(1.9)
    assert "column time has times since 1970 in ns, which count from the first sample" in answer.err
    (tmp_path / "t.csv").write_text((tmp_path / "epoch.csv").read_text().replace("time", "t", 1))
    assert "column t has times since 1970 in ns" in beeline("replay", "ur5e", "t.csv").err
    (tmp_path / "ms.csv").write_text(table(["time"] + ROS, [[1000 * row[0], *row[1:]] for row in motion()]))
    hint = beeline("replay", "ur5e", "ms.csv")
    assert hint.code == 0 and "100 s apart on average" in hint.err and "--time-unit reads ms" in hint.err


def test_ros_messages_in_yaml(beeline, tmp_path):
    (tmp_path / "log.csv").write_text(table(["t"] + JOINTS, motion()))
    for form in ("out.yaml", "out.yml", "out.json"):
        assert beeline("export", "ur5e", "log.csv", "--as", "ros2", "--out", form).code == 0
        assert beeline("diff", "ur5e", "log.csv", form, "--tolerance", "1e-12").code == 0
    assert beeline("replay", "ur5e", "log.csv", "--out", "again.yaml").code == 0
    assert beeline("diff", "ur5e", "again.yaml", "out.yaml", "--tolerance", "1e-12").code == 0
    points = "".join(f"  - positions: {row[1:]}\n    time_from_start: {{sec: {int(row[0])}, nanosec: {round(row[0] % 1 * 1e9)}}}\n" for row in motion())
    (tmp_path / "block.yaml").write_text(f"trajectory:\n  joint_names: {ROS}\n  points:\n{points}---\n")
    assert beeline("diff", "ur5e", "block.yaml", "log.csv", "--tolerance", "1e-12").code == 0


def test_joint_maps(beeline, tmp_path):
    names = ["time", "gripper", "f", "e", "d", "c", "b", "a"]
    rows = [[row[0], 7, *reversed(row[1:])] for row in motion()]
    for row in rows:
        row[6] = -row[6]  # of joint 2
    (tmp_path / "log.csv").write_text(table(names, rows))
    refused = beeline("replay", "ur5e", "log.csv")
    assert refused.code == 3 and "a joint map (joint_map, --joint-map) names the trajectory's joints in this order" in refused.err
    (tmp_path / "map.json").write_text(json.dumps(
        {**dict(zip(JOINTS, "abcdef")), "joint2": {"name": "b", "sign": -1}, "joint3": {"name": "c", "offset": 90, "unit": "deg"}}))
    for joint_map in ("a,-b,c,d,e,f", "map.json"):
        answer = beeline("replay", "ur5e", "log.csv", "--joint-map", joint_map, "--out", "out.csv")
        assert answer.code == 0, answer.err
        for found, row in zip(positions(tmp_path / "out.csv"), motion()):
            third = row[3] if joint_map[-1] == "f" else math.radians(row[3] + 90)
            assert found == pytest.approx([*row[1:3], third, *row[4:]], abs=1e-15)
    mapped = ("--joint-map", "a,-b,c,d,e,f")
    (tmp_path / "own.csv").write_text(table(["t"] + JOINTS, motion()))
    for pair in (("own.csv", "log.csv"), ("log.csv", "own.csv")):
        assert beeline("diff", "ur5e", *pair, *mapped, "--tolerance", "0").code == 0
    tracked = beeline("replay", "ur5e", "own.csv", "--measured", "log.csv", *mapped, "--json")
    assert tracked.json["tracking"]["joints"][2]["largest"] == 0
    assert beeline("retime", "ur5e", "log.csv", *mapped).code == 0
    assert beeline("export", "ur5e", "log.csv", *mapped, "--as", "urscript", "--out", "o.script").code == 0
    assert beeline("draw", "ur5e", "log.csv", *mapped, "--out", "o.svg").code == 0
    (tmp_path / "p.csv").write_text("x,y,z\n0,0,9\n")
    assert beeline("check", "ur5e", "log.csv", *mapped, "--through", "p.csv", "--task", "position").code == 1
    assert beeline("diff", "ur5e", "own.csv", "own.csv", *mapped).code == 3
    assert beeline("replay", "ur5e", "log.csv", "--joint-map", "a,b").code == 2
    twice = beeline("replay", "ur5e", "log.csv", "--joint-map", "a,b,c,d,-a,f")
    assert twice.code == 2 and twice.err.startswith("beeline: the --joint-map gives a to two joints")
    (tmp_path / "twice.json").write_text('{"joint1": "a",\n "joint3": {"name": "a"}}')
    twice = beeline("replay", "ur5e", "log.csv", "--joint-map", "twice.json")
    assert twice.code == 3 and 'twice.json:2: joint3 gives "a" to two joints' in twice.err
    assert beeline("replay", "ur5e", "log.csv", "--joint-map", "none.json").code == 3


READ_IN_RADIANS = ("beeline: warning: {} is read in radians: neither the names of its columns nor its values say that its angles are in "
                   "degrees; --angle-unit deg reads degrees\n")


def test_recordings_in_degrees(beeline, tmp_path):
    (tmp_path / "deg.csv").write_text(table(["t"] + JOINTS, motion(180 / math.pi)))
    (tmp_path / "rad.csv").write_text(table(["t"] + JOINTS, motion()))
    hint = beeline("replay", "ur5e", "deg.csv")
    assert hint.code == 1
    assert "deg.csv: joint joint1 is at" in hint.err and "but not in degrees; --degrees reads degrees" in hint.err
    read = beeline("replay", "ur5e", "deg.csv", "--degrees", "--out", "out.csv")
    assert read.code == 0 and "warning: deg.csv is read in degrees: joint joint1 is at" in read.err
    for found, row in zip(positions(tmp_path / "out.csv"), motion()):
        assert found == pytest.approx(row[1:], abs=1e-12)
    own = beeline("replay", "ur5e", "rad.csv", "--degrees", "--out", "out.csv")
    assert own.code == 0 and own.err == READ_IN_RADIANS.format("rad.csv")
    assert positions(tmp_path / "out.csv") == [row[1:] for row in motion()]
    assert beeline("diff", "ur5e", "deg.csv", "rad.csv", "--degrees", "--tolerance", "1e-12").code == 0


def test_joints_without_limits_may_turn_often(beeline, tmp_path):
    """Their values show no unit: radians are never taken for degrees, nor many revolutions for a wrap."""
    (tmp_path / "turns.csv").write_text("t,joint1,joint2\n0,0,0\n150,112,-20\n")
    for options in ((), ("--degrees",)):
        answer = beeline("replay", "RR:1,1", "turns.csv", "--out", "out.csv", "--json", *options)
        assert answer.json["status"] == "reached" and answer.json["unwrapped"] == []
        assert answer.err == (READ_IN_RADIANS.format("turns.csv") if options else "")
        last = (tmp_path / "out.csv").read_text().splitlines()[-1].split(",")
        assert [float(value) for value in last[1:3]] == pytest.approx([112, -20])


@pytest.mark.parametrize("rows", ["0,90,0\n50,112,-20\n", "0,170,0\n1,-95,0\n"], ids=["slow, far from zero", "fast"])
def test_degrees_of_joints_without_limits_get_a_hint(beeline, tmp_path, rows):
    (tmp_path / "deg.csv").write_text("t,joint1,joint2\n" + rows)
    for options in ((), ("--degrees",)):
        hint = beeline("replay", "RR:1,1", "deg.csv", "--out", "out.csv", *options)
        assert "rad, more than two revolutions, but degrees of one; --angle-unit deg reads degrees" in hint.err
    (tmp_path / "map.json").write_text('{"joint1": {"unit": "deg"}, "joint2": {"unit": "deg"}}')
    read = beeline("replay", "RR:1,1", "deg.csv", "--joint-map", "map.json", "--speed", "0.2", "--out", "out.csv")
    assert read.code == 0 and "degrees" not in read.err


def test_a_slow_recording_in_degrees_is_not_guessed(beeline, tmp_path):
    """A little beyond the limits in radians is a recording that leaves them; a joint map reads degrees."""
    (tmp_path / "slow.csv").write_text(table(["t"] + JOINTS, [[0, 6.5, 0, 0, 0, 0, 0], [1, 6.45, 0, 0, 0, 0, 0]]))
    for options in ((), ("--degrees",)):
        answer = beeline("replay", "ur5e", "slow.csv", *options)
        assert answer.code == 1
        assert "joint joint1 at 6.5 rad" in answer.err and "is read in degrees" not in answer.err
        assert (READ_IN_RADIANS.format("slow.csv") in answer.err) == bool(options)
    (tmp_path / "map.json").write_text(json.dumps({name: {"unit": "deg"} for name in JOINTS}))
    assert beeline("replay", "ur5e", "slow.csv", "--joint-map", "map.json").code == 0


def test_millimetres_get_a_hint(beeline, tmp_path):
    (tmp_path / "mm.csv").write_text("t,joint1,joint2,joint3,joint4\n0,0,0,0,100\n1,0.1,0,0,120\n")
    hint = beeline("replay", "scara", "mm.csv")
    assert "joint joint4 is at 120 m, which is out of range but not in millimetres; the unit mm" in hint.err
    (tmp_path / "map.json").write_text('{"joint4": {"unit": "mm"}}')
    assert beeline("replay", "scara", "mm.csv", "--joint-map", "map.json").code == 0
    (tmp_path / "poses.csv").write_text("x,y,z,roll,pitch,yaw\n400,200,300,3.1,0,0\n400,-200,300,3.1,0,0\n")
    answer = beeline("line", "ur5e", "--through", "poses.csv")
    assert answer.code == 1 and "--millimetres reads millimetres" in answer.err
    (tmp_path / "later.csv").write_text("x,y,z,roll,pitch,yaw\n0.4,0.2,0.3,3.1,0,0\n400,-200,300,3.1,0,0\n")
    (tmp_path / "program.csv").write_text("motion,x,y,z,roll,pitch,yaw\nline,400,200,300,3.1,0,0\n")
    (tmp_path / "rest.csv").write_text(table(["t"] + JOINTS, motion()))
    for command in (("line", "ur5e", "--through", "later.csv"), ("line", "ur5e", "--through", "program.csv"),
                    ("check", "ur5e", "rest.csv", "--through", "poses.csv"), ("check", "ur5e", "rest.csv", "--through", "program.csv"),
                    ("batch", "ik", "ur5e", "--in", "later.csv", "--out", "q.csv"),
                    ("ik", "ur5e", "--pose", "400,200,300,3.1,0,0"), ("fk", "ur5e", "--q", "0,0,0,0,0,0", "--tcp", "0,0,100"),
                    ("draw", "ur5e", "rest.csv", "--through", "poses.csv", "--out", "o.svg")):
        assert "--millimetres reads millimetres" in beeline(*command).err, command
    # Offsets count from their own frame, wherever the arm stands.
    relative = "motion,relative,x,y,z,roll,pitch,yaw\nline,,100.4,0.2,0.3,3.1,0,0\nline,previous,{},0,0,0,0,0\n"
    for offset, hinted in ((100, True), (-120, True), (0.1, False), (-0.05, False)):
        (tmp_path / "program.csv").write_text(relative.format(offset))
        answer = beeline("line", "ur5e", "--mount", "100,0,0", "--through", "program.csv", "--max-work", "1000")
        assert (f"a position {abs(offset)} m away is probably in millimetres; --millimetres" in answer.err) == hinted
    (tmp_path / "poses.csv").write_text("x,y,z,roll,pitch,yaw\n4,2,3,3.1,0,0\n")
    assert "millimetres" not in beeline("line", "ur5e", "--through", "poses.csv").err
