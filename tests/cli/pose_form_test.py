"""--pose-form and --millimetres: poses are read and printed alike, typed and in files."""

import csv
import io

import numpy as np
import pytest

from arms import text

FORMS = ("rpy", "rotvec", "abc", "quaternion", "matrix")
JOINTS = "0.3,-1.1,0.9,0.4,-0.7,0.2"  # of ur5


def matrix_of(answer):
    assert answer.code == 0, answer.err
    return np.array(answer.json["pose"]["matrix"])


def typed(pose, form):
    """The numbers of a JSON pose as --pose takes them."""
    if form == "matrix":
        return text(np.ravel(pose["matrix"]))
    return text([*pose["translation"], *pose[form].values()])


def rows(out):
    return list(csv.reader(io.StringIO(out)))


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("units", [(), ("--millimetres",), ("--degrees", "--millimetres")])
def test_a_printed_pose_can_be_typed(beeline, form, units):
    scale = np.array([1000 if "--millimetres" in units else 1] * 3)
    q = text(np.degrees([float(v) for v in JOINTS.split(",")])) if "--degrees" in units else JOINTS
    plain = matrix_of(beeline("fk", "ur5", "--q", JOINTS, "--json"))
    answer = beeline("fk", "ur5", "--q", q, "--json", "--pose-form", form, *units)
    printed = matrix_of(answer)
    assert printed[:3, 3] == pytest.approx(plain[:3, 3] * scale, rel=1e-13)
    assert printed[:3, :3] == pytest.approx(plain[:3, :3], abs=1e-13)
    assert answer.json["units"].get("position") == ("mm" if "--millimetres" in units else None)
    pose = typed(answer.json["pose"], form)
    found = beeline("ik", "ur5", f"--pose={pose}", "--pose-form", form, *units, "--json")
    assert found.code == 0, found.err
    again = matrix_of(beeline("fk", "ur5", "--q", text(found.json["solutions"][0]), "--json", *units))
    assert again == pytest.approx(printed, rel=1e-8, abs=1e-8 * scale[0])


@pytest.mark.parametrize("form", FORMS)
def test_the_text_has_the_form_alone(beeline, form):
    out = beeline("fk", "kr6_r900", "--q", "0,-90,90,0,0,0", "--degrees", "--millimetres", "--pose-form", form).out
    assert ("quaternion" in out) == (form == "quaternion") and ("rpy" in out) == (form == "rpy")
    if form == "abc":
        assert out == ("tool in the world\n  position    x 525   y 0   z 890  mm\n"
                       "  abc         A 0   B 90   C 0  deg\n")


@pytest.mark.parametrize("form", FORMS)
def test_files_written_in_a_form_are_read_by_it(beeline, written, form):
    written("q.csv", "0.3,-1.1,0.9,0.4,-0.7,0.2\n0.35,-1.0,0.8,0.4,-0.7,0.2\n")
    units = ("--millimetres",)
    written_poses = beeline("batch", "fk", "ur5", "--in", "q.csv", "--out", "p.csv", "--pose-form", form, *units)
    assert written_poses.code == 0, written_poses.err
    # The header names the form, whatever --pose-form says.
    for others in ((), ("--pose-form", "abc")):
        line = beeline("line", "ur5", "--from", JOINTS, "--through", "p.csv", "--out", "m.csv", "--json", *units, *others)
        assert line.code == 0 and line.json["status"] == "reached", line.err
        checked = beeline("check", "ur5", "m.csv", "--through", "p.csv", *units, *others)
        assert checked.code == 0, checked.err
        back = beeline("batch", "ik", "ur5", "--in", "p.csv", "--out", "-", "--seed", JOINTS, *units, *others)
        assert np.array(rows(back.out)[1], float) == pytest.approx([float(v) for v in JOINTS.split(",")], abs=1e-8)
    plain = beeline("line", "ur5", "--from", JOINTS, "--through", "p.csv", "--json")
    assert plain.code == 1, "millimetres read as metres are out of reach"


def test_kukas_columns_are_read_by_all(beeline, written):
    written("k.csv", "X,Y,Z,A,B,C\n525,0,700,0,90,0\n")
    written("prog.csv", "motion,X,Y,Z,A,B,C\njoint,525,0,890,0,90,0\nline,525,0,700,0,90,0\n")
    start = ("--from", "0,-90,90,0,0,0", "--degrees", "--millimetres")
    for through in ("k.csv", "prog.csv"):
        line = beeline("line", "kr6_r900", *start, "--through", through, "--out", "m.csv", "--json")
        assert line.code == 0, line.err
    batch = beeline("batch", "ik", "kr6_r900", "--in", "k.csv", "--out", "-", "--degrees", "--millimetres")
    q = rows(batch.out)[1]
    tool = matrix_of(beeline("fk", "kr6_r900", "--q", ",".join(q), "--degrees", "--json"))
    assert tool[:3, 3] == pytest.approx([0.525, 0, 0.7], abs=1e-8)
    assert tool[:3, 2] == pytest.approx([1, 0, 0], abs=1e-8)


def test_frames_are_read_in_it_too(beeline):
    pose = ("fk", "ur5", "--q", JOINTS, "--json")
    metres = beeline(*pose, "--tcp", "0,0,0.1,0,0,1.5", "--mount", "0,0,0.7,0,0.5,0").json["pose"]["matrix"]
    a, b = np.degrees([1.5, 0.5])
    other = beeline(*pose, "--tcp", f"0,0,100,{a},0,0", "--mount", f"0,0,700,0,{b},0", "--pose-form", "abc",
                    "--millimetres").json["pose"]["matrix"]
    scaled = np.array(metres)
    scaled[:3, 3] *= 1000
    assert np.array(other) == pytest.approx(scaled, abs=1e-9)
    work = ("ik", "ur5", "--json", "--work")
    one = beeline(*work, "0.1,0.2,0.3,0,0,1", "--pose", "0.2,0.1,0.1,3,0,0")
    two = beeline(*work, "100,200,300,0,0,1", "--pose", "200,100,100,3,0,0", "--pose-form", "rotvec", "--millimetres")
    assert one.code == 0 and np.array(two.json["solutions"]) == pytest.approx(np.array(one.json["solutions"]), abs=1e-9)


def test_refusals_say_what_the_form_has(beeline, refused, written):
    ik = ("ik", "ur5", "--pose")
    refused(2, *ik, "0.4,0,0.4,0,0,0", "--pose-form", "matrix",
            says=["--pose: ", "has 6 numbers", "--pose-form matrix has m11,m12,...,m44"])
    refused(2, *ik, "0.4,0,0.4,1,0,0,0", "--pose-form", "abc", says=["has 7 numbers", "abc has x,y,z,A,B,C"])
    refused(2, *ik, "0.4,0,0.4,0,0,0", "--pose-form", "euler", says=["--pose-form", "rotvec"])
    refused(2, *ik, "1,0,0,0.4,0,1,0,0,0,0,-1,0.4", says=["--pose: ", "the determinant is -1"])
    refused(2, *ik, "1,0,0,0.4,0,1,0.2,0,0,0,1,0.4", says=["R R^T differs from the identity by 0.2"])
    written("p.csv", "0.4,0,0.4,0,0,0\n")
    refused(3, "batch", "ik", "ur5", "--in", "p.csv", "--out", "-", "--pose-form", "quaternion",
            says=["p.csv: rows of 6 numbers without a header are not of --pose-form quaternion"])
    refused(2, "batch", "fk", "ur5", "--in", "p.csv", "--out", "-", "--layout", "pose", "--pose-form", "abc",
            says=["--layout cannot be combined with --pose-form"])
    refused(2, "batch", "fk", "ur5", "--in", "p.csv", "--out", "-", "--layout", "planar", says=["planar arms"])
    long = beeline(*ik, "0.3,0.1,0.3,0,-180,0", "--pose-form", "rotvec", "--degrees")
    assert "a rotation vector of 180 rad is more than a revolution" in long.err


PLANAR = """<robot name="p"><link name="l0"/><link name="l1"/><link name="l2"/>
<joint name="j1" type="revolute"><parent link="l0"/><child link="l1"/><origin xyz="0 0 {0}"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint></robot>"""


def test_z_is_never_hidden(beeline, written):
    for height in ("0.25", "0"):
        arm = written("p.urdf", PLANAR.format(height))
        out = beeline("fk", arm, "--q", "0.1,0.2").out
        assert f"z {height}" in out and "yaw 0.3" in out
        assert out.count("\n") == 4
        everything = beeline("fk", arm, "--q", "0.1,0.2", "--all").out
        assert len([line for line in everything.splitlines() if line.split()[-1:] == [height]]) >= 3
        missed = beeline("ik", arm, "--pose", "9,9,0")
        assert missed.code == 1 and f", {height}, " in missed.out
    raised = beeline("fk", "rrr", "--q", "0,1,0", "--mount", "0,0,0.5,0,0,0").out
    assert "z 0.5 m" in raised and "theta 1 rad" in raised
    assert "z" not in beeline("fk", "rrr", "--q", "0,1,0").out


def test_planar_arms_have_planar_poses(beeline, written):
    written("q.csv", "0,1.57,0\n0.3,0.2,-0.1\n")
    batch = beeline("batch", "fk", "rrr", "--in", "q.csv", "--out", "-", "--layout", "planar", "--degrees")
    header, first, _ = rows(batch.out)
    assert header == ["x", "y", "theta"]
    plane = beeline("fk", "rrr", "--q", "0,1.57,0", "--degrees", "--json").json["pose"]["planar"]
    assert [float(v) for v in first] == pytest.approx(list(plane.values()), abs=1e-12)
    for task in ("110", "110000"):
        found = beeline("ik", "rrr", "--task", task, "--pose", "4,3", "--json")
        assert found.code == 0, found.err
        q = text(found.json["solutions"][0])
        reached = beeline("fk", "rrr", "--q", q, "--json").json["pose"]["planar"]
        assert (reached["x"], reached["y"]) == pytest.approx((4, 3), abs=1e-8)
    millimetres = beeline("ik", "rrr", "--pose", "4000,3000,0.5", "--millimetres", "--json")
    metres = beeline("ik", "rrr", "--pose", "4,3,0.5", "--json")
    assert millimetres.json["solutions"] == metres.json["solutions"]


def test_prismatic_joints_stay_in_metres(beeline):
    answer = beeline("fk", "rp", "--q", "0,0.5", "--millimetres", "--json")
    assert answer.json["pose"]["planar"]["x"] == pytest.approx(1500)
    assert "x 1500 mm" in beeline("fk", "rp", "--q", "0,0.5", "--millimetres").out


def test_what_else_than_names_gives_the_units_is_said(beeline, written):
    rows = "x,y,theta\n4500,5200,0\n4400,5100,10\n"
    path = written("p.csv", "# mm, deg\n" + rows)
    says = "p.csv: columns without a unit are read in deg, mm, as a comment says"
    answer = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", path, "--out", "m.csv")
    assert answer.code == 0 and says.replace("deg, ", "") in answer.err
    answer = beeline("batch", "ik", "rrr", "--in", path, "--out", "q.csv")
    assert answer.code == 0 and says in answer.err
    path = written("p.csv", "x,y,z,Rx(deg),Ry(deg),Rz(deg)\n0.45,0.25,0.45,180,0,20\n0.4,0.25,0.45,180,0,20\n")
    assert "are read as a rotation vector" in beeline("line", "ur5e", "--through", path, "--out", "m.csv").err


def test_a_speed_in_millimetres_per_second_gets_a_hint(beeline, written):
    path = written("p.csv", "x,y,z,roll,pitch,yaw,speed\n0.45,0.25,0.45,3.1,0,0,\n0.45,-0.25,0.35,3.1,0,0,250\n")
    answer = beeline("line", "ur5e", "--through", path, "--out", "m.csv")
    assert answer.code == 0 and "a speed of 250 m/s is probably in millimetres per second" in answer.err


def test_poses_that_may_be_in_millimetres_get_a_hint(beeline, written):
    def hints(*arguments):
        return [line for line in beeline(*arguments).err.splitlines() if "--millimetres" in line]

    (hint,) = hints("ik", "ur5", "--pose", "300,100,300,3.1,0,0")
    assert hint.startswith("beeline: warning: --pose: ")
    assert hints("ik", "ur5", "--pose", "300,100,300,3.1,0,0", "--millimetres") == []
    assert hints("ik", "ur5", "--pose", "3,1,3,3.1,0,0") == []
    poses = written("p.csv", "x,y,z,roll,pitch,yaw\n300,100,300,3.1,0,0\n300,0,300,3.1,0,0\n")
    (hint,) = hints("line", "ur5", "--through", poses)
    assert hint.startswith("beeline: warning: --through p.csv: ")


def test_every_verb_with_an_arm_takes_them(beeline):
    for verb in ("fk", "ik", "line", "check", "export", "show", "draw", "doctor", "retime", "replay", "jacobian"):
        out = beeline(verb, "--help").out
        assert "--pose-form" in out and "--millimetres" in out, verb
