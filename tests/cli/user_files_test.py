"""Files of users: what Gazebo, Isaac Sim, SolidWorks and editors write, and what is left over in them."""

import json
import subprocess

import pytest

LINKS = '<link name="a"/><link name="b"/><link name="c"/>'


def joint(name, kind, parent, child, inside=""):
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f'<origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>{inside}</joint>\n')


def limit(lower, upper, velocity="1"):
    return f'<limit lower="{lower}" upper="{upper}" velocity="{velocity}" effort="-1"/>'


def robot(*elements):
    return '<robot name="r">\n' + "".join(elements) + "</robot>\n"


ARM = LINKS + joint("j1", "revolute", "a", "b", limit(-1, 1)) + joint("j2", "revolute", "b", "c", limit(-1, 1))


def warnings(answer):
    lines = answer.err.splitlines()
    assert all(line.startswith("beeline: warning: ") for line in lines), lines
    return [line.removeprefix("beeline: warning: ") for line in lines]


def test_arguments_of_xacro(beeline, written, tmp_path, monkeypatch):
    program = tmp_path / "xacrodoc"
    program.write_text("#!/bin/sh\ncase $* in *len:=*) ;; *) echo Undefined substitution argument len >&2; exit 1 ;; esac\n"
                       "/bin/cat <<END\n" + robot(ARM).replace('"r"', '"$2"', 1) + "END\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    written("r.urdf.xacro", robot("<xacro:arg name='len'/>"))
    answer = beeline("show", "r.urdf.xacro", "--json")
    assert answer.code == 3 and answer.err.endswith("argument len (NAME:=VALUE beside the file gives it a value; in Python xacro={NAME: VALUE})\n")
    for words in (["r.urdf.xacro", "len:=0.5"], ["len:=0.5", "r.urdf.xacro"], ["r.urdf.xacro", "len:=1", "len:=0.5"]):
        answer = beeline("show", *words, "--json")
        assert answer.code == 0 and answer.json["name"] == "len:=0.5"
    answer = beeline("show", "panda", "len:=0.5")
    assert answer.code == 2 and "len:= is an argument of a .xacro file, and no such file is given" in answer.err
    answer = beeline("show", "r.urdf.xacro", "a%:=1")
    assert answer.code == 2 and '"a%" is no name of an argument of xacro' in answer.err


@pytest.mark.parametrize("number", ["inf", "1.79769e+308", "1.8e308", "3.4e38", "1e16", "1e+16"])
def test_no_limit(beeline, written, number):
    written("r.urdf", robot(LINKS, joint("j1", "revolute", "a", "b", limit("-" + number, number, "-1.0")),
                            joint("j2", "revolute", "b", "c", limit(-1, 1))))
    answer = beeline("show", "r.urdf", "--json")
    assert answer.code == 0 and answer.err == ""
    limits = answer.json["joints"][0]["limits"]
    assert limits["lower"] is None and limits["upper"] is None and limits["velocity"] is None


def test_faults_beside_the_chain_are_warnings(beeline, written):
    written("r.urdf", robot(ARM, '<link name="w"/>', joint("wheel", "revolute", "a", "w", limit("low", "high", "-5")),
                            joint("camera", "fixed", "chassis", "lens"), '<xacro:include filename="gripper.xacro"/>'))
    answer = beeline("show", "r.urdf", "--tip", "c", "--json")
    assert answer.code == 0 and len(answer.json["joints"]) == 2
    malformed, xacro, unknown = sorted(warnings(answer), key=lambda text: ("xacro" in text, "unknown" in text))[0:1] + [
        next(text for text in warnings(answer) if "xacro" in text), next(text for text in warnings(answer) if "camera" in text)]
    assert malformed.startswith("r.urdf:") and '"low" is not a limit' in malformed and "left out" in malformed
    assert "<xacro:include> is left out; run xacro first" in xacro
    assert 'joint camera has an unknown parent link "chassis"' in unknown


def test_without_a_tip_a_chain_that_lost_a_joint_is_refused(beeline, written, refused):
    written("wheel.urdf", robot(ARM, '<link name="w"/>', joint("wheel", "continuous", "chassis", "w")))
    answer = beeline("show", "wheel.urdf", "--json")
    assert answer.code == 0 and len(answer.json["joints"]) == 2 and "chassis" in warnings(answer)[0]
    written("cut.urdf", robot(LINKS, joint("j1", "revolute", "a", "b"), joint("j2", "revolute", "bb", "c")))
    refused(3, "show", "cut.urdf", says=["joint j2", 'unknown parent link "bb"', 'did you mean "b"', "the option tip"])


def test_angles_of_more_than_a_revolution_are_warned_of(beeline, written):
    written("r.urdf", robot(ARM).replace('<origin xyz="0.3 0 0"/>', '<origin xyz="0.3 0 0" rpy="90 0 0"/>', 1))
    assert warnings(beeline("show", "r.urdf")) == [
        "r.urdf:2: joint j1: an angle of 90 rad is more than a revolution; angles are in radians"]
    rows = {"rows": [{"a": 1, "alpha": -90}, {"a": 1}], "convention": "standard"}
    turned = {"name": "j", "type": "revolute", "origin": {"rpy": [0, 0, 45]}}
    says = "an angle of {} rad is more than a revolution; angles are in radians"
    for arm, text in [({"dh": rows}, "joint joint1: " + says.format(-90)), ({"dh": {**rows, "degrees": True}}, ""),
                      ({"joints": [turned]}, "joint j: " + says.format(45)),
                      ({"joint_string": "RR", "tool": {"rpy": [7, 0, 0]}}, says.format(7)),
                      ({"joint_string": "RR", "tool": {"rpy": [6.28, 0, 0]}}, "")]:
        written("a.json", json.dumps({"name": "a", **arm}))
        assert warnings(beeline("show", "a.json")) == (["a.json:1: " + text] if text else [])
    written("a.json", json.dumps({"name": "a", "joints": [turned]}))
    assert "rpy 0 0 45 rad (line 1): degrees?" in beeline("doctor", "a.json").out


def test_a_floating_root_names_the_base(beeline, written):
    written("r.urdf", robot('<link name="world"/>', joint("root", "floating", "world", "a"), ARM))
    answer = beeline("show", "r.urdf", "--json")
    assert answer.code == 0 and len(answer.json["joints"]) == 2
    (warning,) = warnings(answer)
    assert warning == "the base is a, below joint root, which places the arm in the world; --base selects another"
    assert beeline("show", "r.urdf", "--base", "a").err == ""
    assert "(--base a) selects a chain without it" in beeline("show", "r.urdf", "--base", "world").err


def test_a_finger_is_not_a_joint_of_the_arm(beeline, written):
    written("r.urdf", robot(ARM, '<link name="stator"/><link name="mover"/>', joint("f", "fixed", "c", "stator"),
                            joint("jointGripper", "revolute", "stator", "mover", limit(-1, 0))))
    answer = beeline("show", "r.urdf", "--json")
    assert [each["name"] for each in answer.json["joints"]] == ["j1", "j2"]
    assert warnings(answer) == [
        "the tip is stator, before joint jointGripper, which moves a gripper; --tip mover includes it"]
    for tip, joints in {"mover": 3, "stator": 2}.items():
        answer = beeline("show", "r.urdf", "--tip", tip, "--json")
        assert answer.err == "" and len(answer.json["joints"]) == joints


def test_followers_of_a_leader_beside_the_chain(beeline, written):
    mimic = '<mimic joint="lead" multiplier="{}"/>'
    written("g.urdf", robot(
        LINKS, '<link name="l"/>', joint("lead", "revolute", "a", "l", limit(0, 0.7)),
        joint("one", "revolute", "a", "b", limit(-0.7, 0) + mimic.format(-1)),
        joint("two", "revolute", "b", "c", limit(0, 0.7) + mimic.format(1))))
    answer = beeline("show", "g.urdf", "--tip", "c")
    assert "2 joints, 1 degree of freedom" in answer.out
    moved = beeline("fk", "g.urdf", "--tip", "c", "--q", "-0.5", "--json").json["pose"]
    assert moved["quaternion"]["qw"] == pytest.approx(1)  # one turns by -0.5, two by 0.5


ENCODINGS = {"utf-16": "UTF-16", "utf-16-le": "UTF-16", "utf-16-be": "UTF-16", "utf-32": "UTF-32"}
FILES = {
    "r.urdf": (robot(ARM), ("show", "r.urdf")),
    "s.srdf": ('<robot name="r"><group name="g"><chain base_link="a" tip_link="c"/></group></robot>',
               ("show", "arm.urdf", "--srdf", "s.srdf", "--group", "g")),
    "a.json": (json.dumps({"name": "a", "joint_string": "RRR:1,1,1"}), ("show", "a.json")),
    "p.csv": ("x,y,theta\n2,1,0\n2,1.1,0\n", ("line", "rrr", "--through", "p.csv")),
    "m.csv": ("motion,x,y,theta\nline,6,1,0\nline,6,1.1,0\n", ("line", "rrr", "--through", "m.csv")),
    "l.yaml": ("joint_limits:\n  joint1: {max_velocity: 1}\n", ("show", "rrr", "--limits", "l.yaml")),
    "l.json": ('{"joint1": {"velocity": 1}}', ("show", "rrr", "--limits", "l.json")),
    "t.csv": ("t,joint1,joint2,joint3\n0,0,0,0\n1,0.1,0,0\n", ("replay", "rrr", "t.csv")),
    "t.json": (json.dumps({"joint_names": ["joint1", "joint2", "joint3"], "points": [
        {"positions": [0, 0, 0], "time_from_start": {"sec": 0, "nanosec": 0}},
        {"positions": [0.1, 0, 0], "time_from_start": {"sec": 1, "nanosec": 0}}]}), ("replay", "rrr", "t.json")),
    "q.csv": ("joint1,joint2,joint3\n0,0,0\n", ("batch", "fk", "rrr", "--in", "q.csv", "--out", "-")),
}


@pytest.mark.parametrize("name", FILES)
def test_encodings_and_pointers(beeline, written, name, tmp_path):
    text, words = FILES[name]
    written("arm.urdf", robot(ARM))
    path = tmp_path / name
    written(name, text)
    plain = beeline(*words)
    assert plain.code in (0, 1), plain.err
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    marked = beeline(*words)
    assert (marked.code, marked.out) == (plain.code, plain.out)
    for encoding, shown in ENCODINGS.items():
        path.write_bytes(text.encode(encoding))
        answer = beeline(*words)
        assert answer.code == 3 and f"{name}: is {shown}; save it as UTF-8" in answer.err, answer.err
    path.write_text("version https://git-lfs.github.com/spec/v1\noid sha256:12ab\nsize 4\n")
    answer = beeline(*words)
    assert answer.code == 3 and "pointer of Git LFS" in answer.err and "git lfs pull" in answer.err


def test_the_arm_comes_first(beeline, written, refused):
    written("t.csv", FILES["t.csv"][0])
    written("t.json", FILES["t.json"][0])
    written("a.json", FILES["a.json"][0])
    for words in [("t.csv", "rrr"), ("t.json", "rrr"), ("t.json", "RRR:1,1,1"), ("t.csv", "a.json")]:
        refused(2, "replay", *words, says=["the arm comes first"])
    written("stream", FILES["t.csv"][0])  # a file without an ending, such as a pipe
    assert beeline("replay", "a.json", "stream").code in (0, 1)
    assert beeline("replay", "a.json", "t.json").code in (0, 1)


ELBOW = json.dumps({"name": "elbow", "dh": {"convention": "standard", "degrees": True, "rows": [
    {"d": 0.3, "alpha": 90}, {"a": 0.4}, {"a": 0.3}]}})


@pytest.mark.parametrize("arm, text, task", [
    ("e.json", ELBOW, "position"), ("scara", "", "spatial"), ("px150", "", "spatial")])
def test_a_closed_form_names_joints_of_the_arm(beeline, written, arm, text, task):
    if text:
        written(arm, text)
    joints = len(beeline("show", arm, "--json").json["joints"])
    q = ",".join(["0.3", "0.5", "0.2", "0.7", "0.4"][:joints])
    pose = beeline("fk", arm, "--q", q, "--json").json["pose"]
    numbers = pose["translation"] if task == "position" else [
        *pose["translation"], *(pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz"))]
    method = beeline("ik", arm, "--task", task, "--pose=" + ",".join(map(str, numbers)), "--json").json["method"]
    assert method.startswith("closed form: three ") and method.endswith(")")
    named = method.split("(")[1].rstrip(")").replace("joints ", "").replace("joint ", "")
    numbers = [int(word) for word in named.split(" and ")[0].split(", ") if word.isdigit()]
    assert all(number <= joints for number in numbers), method
    assert len(numbers) == 3 or f"{3 - len(numbers)} virtual at the tool" in method


@pytest.mark.parametrize("hand", ["hand", "the hand", "it's", "-palm", "palm;ls", "$HOME", "`ls`", "a\\b", 'say "x"'])
def test_the_tip_that_a_refusal_names_works_when_it_is_pasted(beeline, build, written, tmp_path, hand):
    name = hand.replace("&", "&amp;").replace('"', "&quot;")
    hands = f'<link name="{name}"/><link name="finger1"/><link name="finger2"/>'
    written("r.urdf", robot(ARM, hands, joint("mount", "fixed", "c", name), joint("f1", "prismatic", name, "finger1"),
                            joint("f2", "prismatic", name, "finger2", '<mimic joint="f1"/>')))
    refusal = beeline("show", "r.urdf")
    assert refusal.code == 3
    option = refusal.err.split(" (")[-1].removesuffix(") ends before the gripper\n")
    assert option.startswith("--tip "), refusal.err
    pasted = subprocess.run(f"{build}/beeline show r.urdf {option} --json", shell=True, capture_output=True, text=True, cwd=tmp_path)
    assert pasted.returncode == 0 and len(json.loads(pasted.stdout)["joints"]) == 2, pasted.stderr


def markdown(text):
    header, *rows = ["| " + line.replace(",", " | ") + " |" for line in text.splitlines()]
    return "\n".join([header, "|---" * (header.count("|") - 1) + "|", *rows]) + "\n"


TABLES = {
    "pipes": lambda text: text.replace(",", "|"), "Markdown": markdown,
    "comments": lambda text: "// by hand\n%  more\n; last\n" + text,
    "commas at the ends": lambda text: text.replace("\n", ",,\n") + ",,,\n",
    "semicolons at the ends": lambda text: text.replace("\n", ";\n"),
    "decimal commas": lambda text: text.replace(",", ";").replace(".", ",").replace("\n", ";\n"),
    "the minus of Unicode": lambda text: text.replace("-", "\u2212"),
}


@pytest.mark.parametrize("habit", TABLES)
def test_tables_of_other_programs(beeline, written, tmp_path, habit):
    poses = "x,y,z,roll,pitch,yaw\n0.4,0,0.5,3.1,0,-0.2\n0.5,0.1,0.5,3.1,0.1,0\n"
    recording = "t,joint1,joint2,joint3\n0,0.1,0.2,-0.3\n0.5,0.2,0.3,-0.4\n"
    for arm, text, verb in [("panda", poses, ("batch", "ik", "panda", "--in")), ("rrr", recording, ("replay", "rrr"))]:
        outputs = []
        for name, content in [("plain.csv", text), ("other.csv", TABLES[habit](text))]:
            answer = beeline(*verb, written(name, content), "--out", "out.csv")
            assert answer.code == 0 and answer.err == "", (arm, answer.err)
            outputs.append((tmp_path / "out.csv").read_text())
        assert outputs[0] == outputs[1]


def test_a_comment_with_units_is_the_header(beeline, written, tmp_path):
    """MATLAB's comment above numbers; in another order than a header's, in prose, it is refused."""
    written("one.json", '{"name": "one", "joint_string": "R"}')
    written("m.txt", "%  joint1 t in s\n0.1 0\n0.2 0.5\n")
    answer = beeline("replay", "one.json", "m.txt", "--out", "out.csv")
    assert answer.code == 0 and answer.err == "", answer.err
    assert (tmp_path / "out.csv").read_text() == "t,joint1\n0,0.1\n0.5,0.2\n"
    written("m.txt", "% the angle joint1 over t\n0.1 0\n0.2 0.5\n")
    answer = beeline("replay", "one.json", "m.txt")
    assert answer.code == 3 and "read as t, joint1; the comment" in answer.err and "names them in another order" in answer.err


def test_every_row_of_a_path_is_retimed(beeline, written, tmp_path):
    numbers = [(0, -0.1), (1, -1), (1.5, -1.5), (2, 2), (3, 3)]
    for minus in "-", "\u2212":
        text = "joint1,joint2\n" + "".join(f"{a:g},{b:g}\n" for a, b in numbers).replace("-", minus)
        answer = beeline("retime", "RR:1,1", written("path.csv", text), "--out", f"{ord(minus)}.csv", "--json")
        assert answer.code == 0, answer.err
    assert (tmp_path / "45.csv").read_text() == (tmp_path / "8722.csv").read_text()
    for row, says in [("0x0,1", "n.csv:2: column joint1"), ("1,on", "n.csv:2: column joint2")]:
        answer = beeline("retime", "RR:1,1", written("n.csv", f"joint1,joint2\n{row}\n0,0\n1,1\n2,2\n"))
        assert answer.code == 3 and says in answer.err, answer.err


def test_an_index_of_pandas_with_semicolons_is_no_time(beeline, written, refused, tmp_path):
    written("one.json", '{"name": "one", "joint_string": "R"}')
    for separator in ",;":
        text = "\n".join([";joint1", "0;0.1", "1;0.2", "2;0.3", ""]).replace(";", separator)
        refused(3, "replay", "one.json", written("p.csv", text), says=["p.csv", "Unnamed: 0"])
    answer = beeline("replay", "one.json", written("p.csv", ";t;joint1\n0;0;0.1\n1;0.5;0.2\n"), "--out", "out.csv")
    assert answer.code == 0 and (tmp_path / "out.csv").read_text() == "t,joint1\n0,0.1\n0.5,0.2\n"


def test_prose_above_poses_is_no_header(beeline, written):
    for comment, code in [("x and y", 0), ("x, y and more", 0), ("time x y", 3), ("x, y, phi", 3)]:
        answer = beeline("batch", "ik", "rrr", "--in", written("p.csv", f"# {comment}\n1.5,0.2,0\n"), "--out", "out.csv")
        assert answer.code == code, (comment, answer.err)
    assert 'read as x, y, theta; the comment "x, y, phi" names other columns' in answer.err


def test_days_of_excel_are_refused(beeline, written):
    written("e.csv", "time,joint1,joint2,joint3\n45000.5,0,0,0\n45000.50001,0,0,0\n")
    answer = beeline("replay", "rrr", "e.csv")
    assert answer.code == 3 and "look like days, as Excel" in answer.err and "--time-unit" in answer.err
    assert beeline("replay", "rrr", "e.csv", "--time-unit", "s").code == 0


def test_poses_without_a_header_are_said_to_be_read_in_an_order(beeline, written):
    answer = beeline("batch", "ik", "panda", "--in", written("p.csv", "0.4,0,0.5,0,1,0,0\n"), "--out", "out.csv")
    assert answer.code == 0
    assert warnings(answer) == ["p.csv has no header; its columns are read as x, y, z, qw, qx, qy, qz"]
