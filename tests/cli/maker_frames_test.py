"""Programs of Universal Robots, ABB and KUKA: their targets are the tool's poses in the controller's root frame,
by the forward kinematics of this file and the parsers of makers.py."""

import json
import math
import zlib

import numpy as np
import pytest

from makers import FORMS, about, by_quaternion, translation
from random_cases import cases


def rpy(roll=0.0, pitch=0.0, yaw=0.0):
    return about("z", yaw) @ about("y", pitch) @ about("x", roll)


def placed(pose):
    """A pose of an arm file."""
    return translation(*pose.get("xyz", (0, 0, 0))) @ rpy(*pose.get("rpy", (0, 0, 0)))


def along(axis, point, angle):
    """A rotation about an axis through a point."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    w, s = math.cos(angle / 2), math.sin(angle / 2)
    return translation(*point) @ by_quaternion(w, s * x, s * y, s * z) @ translation(*-np.array(point, float))


class Table:
    """An arm of beeline/model/arms, from its file. Its root frame is the world of the file."""

    def __init__(self, document):
        self.document = document
        rows = document["dh"]["rows"] if "dh" in document else document["joints"]
        unit = math.pi / 180 if document.get("dh", {}).get("degrees") else 1
        limits = [row.get("limits", {}) for row in rows]
        self.lower = np.array([unit * limit.get("lower", -math.inf) for limit in limits])
        self.upper = np.array([unit * limit.get("upper", math.inf) for limit in limits])
        self.six_revolute = len(rows) == 6 and all(row.get("type", "revolute") == "revolute" for row in rows)

    def flange(self, q):
        pose = placed(self.document.get("base", {}))
        if "dh" not in self.document:
            for joint, value in zip(self.document["joints"], q, strict=True):
                axis, point = joint.get("axis", (0, 0, 1)), joint.get("point", (0, 0, 0))
                pose = pose @ placed(joint.get("origin", {})) @ along(axis, point, value)
        else:
            table = self.document["dh"]
            unit = math.pi / 180 if table.get("degrees") else 1
            for row, value in zip(table["rows"], q, strict=True):
                a, alpha, d, theta = (row.get(key, 0) for key in ("a", "alpha", "d", "theta"))
                x = translation(a, 0, 0) @ about("x", unit * alpha)
                z = about("z", unit * theta + value) @ translation(0, 0, d)
                pose = pose @ (z @ x if table["convention"] == "standard" else x @ z)
        return pose @ placed(self.document.get("tool", {}))

    def configuration(self, rng):
        lower, upper = np.maximum(self.lower, -2.5), np.minimum(self.upper, 2.5)
        return rng.uniform(lower + 0.2 * (upper - lower), upper - 0.2 * (upper - lower))


@pytest.fixture(scope="module")
def tables(root):
    files = sorted((root / "beeline" / "model" / "arms").glob("*.json"))
    return {file.stem: Table(json.loads(file.read_text())) for file in files}


def text_of(pose):
    """x,y,z,qw,qx,qy,qz of a pose."""
    m = pose[:3, :3]
    candidates = np.array([[1 + m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
                           [m[2, 1] - m[1, 2], 1 + m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[0, 2] + m[2, 0]],
                           [m[0, 2] - m[2, 0], m[1, 0] + m[0, 1], 1 - m[0, 0] + m[1, 1] - m[2, 2], m[2, 1] + m[1, 2]],
                           [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[2, 1] + m[1, 2], 1 - m[0, 0] - m[1, 1] + m[2, 2]]])
    q = max(candidates, key=np.linalg.norm)
    return ",".join(repr(float(x)) for x in [*pose[:3, 3], *(q / np.linalg.norm(q))])


def random_frame(rng):
    angles = rng.uniform(-math.pi, math.pi, 3) * (1, 0.5, 1)
    return translation(*rng.uniform(-0.8, 0.8, 3)) @ rpy(*angles)


class Program:
    """A program whose waypoints are poses of random configurations near each other, and what it must command."""

    def __init__(self, table, form, rng):
        self.frames = {name: random_frame(rng) for name in ("mount", "work", "tcp") if rng.random() < 0.6}
        mount, work, tcp = (self.frames.get(name, np.eye(4)) for name in ("mount", "work", "tcp"))
        q = table.configuration(rng)
        rows = ["motion,x,y,z,qw,qx,qy,qz,q,speed"]
        self.expected = []  # (joints, pose or via, root_T_tool)

        def add(motion, kind, joints="", step=0.06):
            nonlocal q
            q = q + rng.uniform(-step, step, 6)
            tool = table.flange(q) @ tcp
            pose = ",,,,,," if joints else text_of(np.linalg.inv(work) @ mount @ tool)
            values = '"' + ",".join(map(repr, map(float, q))) + '"' if joints else ""
            rows.append(f"{motion},{pose},{values},")
            self.expected.append((kind, tool))

        self.start = ",".join(map(repr, map(float, q)))
        add("joint", "joints")
        add("line", "pose")
        add("joint", "joints", joints=True, step=0.3)
        if form == "krl" and rng.random() < 0.5:
            for _ in range(3):
                add("spline", "pose")
        elif rng.random() < 0.5:
            add("via", "via")
            add("arc", "pose")
        add("line", "pose")
        self.text = "\n".join(rows) + "\n"
        self.options = [f"--{name}={text_of(frame)}" for name, frame in self.frames.items()]


def check_targets(table, program, moves):
    tool = program.frames.get("tcp", np.eye(4))
    np.testing.assert_allclose(moves.tool, tool, atol=2e-9)
    assert (moves.work is not None) == ("work" in program.frames)
    if moves.work is not None:  # relative to the root frame, which stands at the mount
        mount = program.frames.get("mount", np.eye(4))
        np.testing.assert_allclose(moves.work, np.linalg.inv(mount) @ program.frames["work"], atol=2e-9)
    commanded = moves.moves[1:]  # after the move to the first configuration
    assert len(commanded) == len(program.expected)
    for (kind, value), (meant, expected) in zip(commanded, program.expected, strict=True):
        assert (kind == "joints") == (meant == "joints")
        if kind == "joints":
            value = table.flange(value) @ tool
        columns = slice(3, 4) if meant == "via" else slice(0, 4)  # an arc passes a position
        np.testing.assert_allclose(value[:, columns], expected[:, columns], atol=2e-8)


ARMS = ["cr5", "crx10ia", "crx10ial", "gen3_lite", "gp8", "hc10", "irb120", "irb6700", "jaco2", "kr210_r2700",
        "kr6_r900", "lite6", "lrmate200id", "m1013", "m710ic", "nova5", "parol6", "piper", "puma560", "tm5_900", "ur10",
        "ur10e", "ur12e", "ur15", "ur16e", "ur20", "ur3", "ur30", "ur3e", "ur5", "ur5e", "ur7e", "widowx250s", "xarm6",
        "z1"]


def test_the_arms_of_six_revolute_joints_are_these(tables):
    assert [name for name, table in tables.items() if table.six_revolute] == ARMS


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("arm", ARMS)
def test_targets_are_the_forward_kinematics_in_the_root_frame(beeline, written, tables, tmp_path, arm, form):
    ending, read = FORMS[form]
    planned, table = 0, tables[arm]
    rng = np.random.default_rng(zlib.crc32(f"{arm} {form}".encode()))
    for _ in range(20 * cases(3)):
        program = Program(table, form, rng)
        written("p.csv", program.text)
        answer = beeline("export", arm, "p.csv", "--as", form, "--out", f"p.{ending}", f"--from={program.start}",
                         "--time-limit", "5", *program.options)
        assert answer.code in (0, 1), answer.err
        if answer.code == 1:  # such as a line through a singularity
            continue
        check_targets(table, program, read((tmp_path / f"p.{ending}").read_text()))
        planned += 1
        if planned == cases(3):
            return
    raise AssertionError(f"{planned} programs of {cases(3)} were possible")


def exported(beeline, tmp_path, arm, form, program, *options):
    ending, read = FORMS[form]
    answer = beeline("export", arm, program, "--as", form, "--out", f"p.{ending}", *options)
    assert answer.code == 0, answer.err
    moves = read((tmp_path / f"p.{ending}").read_text())
    moves.note = next(line for line in answer.err.splitlines() if line.startswith("note"))[14:]
    assert moves.note in moves.comments
    return moves


HEAD = "motion,x,y,z,roll,pitch,yaw\n"
UP = HEAD + "joint,0.525,0,0.6,0,90,0\nline,0.525,0,0.7,0,90,0\n"


def test_a_kuka_has_its_root_frame_on_the_floor(beeline, written, tmp_path):
    written("p.csv", UP)
    exported(beeline, tmp_path, "kr6_r900", "krl", "p.csv", "--degrees")
    lines = (tmp_path / "p.src").read_text().splitlines()
    assert "$BASE=$ROBROOT" in lines
    (line,) = [line for line in lines if line.startswith("LIN ")]
    values = [round(float(item.split()[1]), 6) for item in line.removeprefix("LIN {").removesuffix("}").split(",")]
    assert values == [525, 0, 700, 0, 90, 0]


# What the makers' controllers show for the flange: KUKA's home position, ABB's calibration position, and the tables
# of Universal Robots at zero.
@pytest.mark.parametrize("arm, form, joints, shown", [
    ("kr6_r900", "krl", [0, -90, 90, 0, 0, 0], translation(0.525, 0, 0.89) @ about("y", math.pi / 2)),
    ("kr210_r2700", "krl", [0, -90, 90, 0, 0, 0], translation(1.765, 0, 1.91) @ about("y", math.pi / 2)),
    ("irb120", "rapid", [0, 0, 0, 0, 0, 0], translation(0.374, 0, 0.63) @ about("y", math.pi / 2)),
    ("irb6700", "rapid", [0, 0, 0, 0, 0, 0], translation(1.6625, 0, 2.105) @ about("y", math.pi / 2)),
    ("ur5e", "urscript", [0, 0, 0, 0, 0, 0], translation(-0.8172, -0.2329, 0.0628) @ about("x", math.pi / 2)),
])
def test_poses_are_those_that_the_controller_shows(tables, arm, form, joints, shown):
    np.testing.assert_allclose(tables[arm].flange(np.radians(joints)), shown, atol=1e-12)


def test_a_file_has_the_frames_of_the_options(beeline, written, tmp_path):
    written("p.csv", HEAD + "joint,0.3,0.1,0.5,0,90,0\nline,0.35,0.1,0.5,0,90,0\n")
    options = ("--mount", "0.1,-0.2,0.3,0.2,0,1", "--tcp", "0.01,0.02,0.1,0,0.3,0", "--degrees")
    assert beeline("show", "irb120", "--out", "arm.json", *options).code == 0
    for form, (ending, _) in FORMS.items():
        exported(beeline, tmp_path, "irb120", form, "p.csv", *options)
        text = (tmp_path / f"p.{ending}").read_text()
        exported(beeline, tmp_path, "arm.json", form, "p.csv", "--degrees")
        assert (tmp_path / f"p.{ending}").read_text() == text


def assumed_in(note):
    """The frames of the controller that a note says are assumed."""
    clauses = [clause for clause in note.split("; ") if "assumed" in clause]
    return {frame for clause in clauses for frame, words in
            (("root", "that frame is assumed to be the world"), ("flange", "the flange")) if words in clause}


def assert_assumptions(note, *, root, flange):
    assert assumed_in(note) == {frame for frame, assumed in (("root", root), ("flange", flange)) if assumed}, note


def own_arm(tables, **keys):
    return json.dumps({"name": "own", "dh": tables["irb120"].document["dh"], **keys})


def test_an_arm_file_states_the_root_frame_and_the_flange(beeline, written, tables, tmp_path):
    target = translation(0.35, 0.1, 0.5) @ about("y", math.pi / 2)
    root = {"xyz": [0.1, 0, -0.2], "rpy": [0, 0, 0.5]}
    flange = {"xyz": [0, 0.01, 0], "rpy": [0.1, 0, 0]}
    for keys, frame, mounted in (({}, {}, {}), ({"base": root}, {}, root),
                                 ({"base": root, "controller_base": root}, root, root),
                                 ({"controller_base": root, "flange": flange}, root, {})):
        written("arm.json", own_arm(tables, **keys))
        place = placed(mounted)  # the waypoint is at the same joint values
        poses = [text_of(place @ translation(x, 0, 0) @ target) for x in (-0.05, 0)]
        written("p.csv", f"motion,x,y,z,qw,qx,qy,qz\njoint,{poses[0]}\nline,{poses[1]}\n")
        for form in FORMS:
            moves = exported(beeline, tmp_path, "arm.json", form, "p.csv")
            np.testing.assert_allclose(moves.moves[-1][1], np.linalg.inv(placed(frame)) @ place @ target, atol=2e-8)
            np.testing.assert_allclose(moves.tool, np.linalg.inv(placed(keys.get("flange", {}))), atol=2e-9)
            assert_assumptions(moves.note, root="controller_base" not in keys, flange="flange" not in keys)


def urdf_of(table, links):
    """A URDF of a standard DH table: joint j0 moves link m0, to which l1 is fixed, and so on up to l6; `links` are
    further ones, by name: the link that they are fixed to, xyz and rpy."""
    names, parts = ["l0", *links], []

    def joint(name, kind, parent, child, xyz=(0, 0, 0), angles=(0, 0, 0), inside=""):
        xyz, angles = (" ".join(map(repr, map(float, values))) for values in (xyz, angles))
        parts.append(f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
                     f'<origin xyz="{xyz}" rpy="{angles}"/>{inside}</joint>')

    for i, row in enumerate(table.document["dh"]["rows"]):
        names += [f"m{i}", f"l{i + 1}"]
        limits = f'lower="{table.lower[i]}" upper="{table.upper[i]}" velocity="1" effort="1"'
        joint(f"j{i}", "revolute", f"l{i}", f"m{i}", inside=f'<axis xyz="0 0 1"/><limit {limits}/>')
        joint(f"f{i}", "fixed", f"m{i}", f"l{i + 1}", (row["a"], 0, row["d"]), (math.radians(row["alpha"]), 0, 0))
    for name, (parent, xyz, angles) in links.items():
        joint(f"to_{name}", "fixed", parent, name, xyz, angles)
    return "<robot name='r'>" + "".join(f"<link name='{name}'/>" for name in names) + "".join(parts) + "</robot>"


HALF_TURN = {"base": ("l0", (0, 0, 0), (0, 0, math.pi))}
FLANGE = {"tool0": ("l6", (0, 0, -0.1), (0, 0.2, 0))}
ELSEWHERE = {"base": ("m1", (0, 0, 0), (0, 0, 1)), "tool0": ("m2", (0, 0, 1), (0, 1, 0))}


@pytest.mark.parametrize("links", [{}, HALF_TURN, FLANGE, HALF_TURN | FLANGE, ELSEWHERE], ids=repr)
def test_a_urdf_states_them_by_its_links_base_and_tool0(beeline, written, tables, tmp_path, links):
    written("p.csv", HEAD + "joint,0.4,-0.3,0.4,2.9,0.1,0.2\nline,0.4,-0.2,0.4,2.9,0.1,0.2\n")
    target = translation(0.4, -0.2, 0.4) @ rpy(2.9, 0.1, 0.2)
    root = about("z", math.pi) if HALF_TURN.items() <= links.items() else np.eye(4)
    flange = translation(0, 0, -0.1) @ about("y", 0.2) if FLANGE.items() <= links.items() else np.eye(4)
    written("r.urdf", urdf_of(tables["ur5e"], links))
    for form in FORMS:
        moves = exported(beeline, tmp_path, "r.urdf", form, "p.csv", "--tip", "l6")
        np.testing.assert_allclose(moves.moves[-1][1], np.linalg.inv(root) @ target, atol=2e-8)
        np.testing.assert_allclose(moves.tool, np.linalg.inv(flange), atol=2e-9)
        assert_assumptions(moves.note, root=not HALF_TURN.items() <= links.items(),
                           flange=not FLANGE.items() <= links.items())
        note = moves.note
        options = ("--tip", "l6", "--mount", "0.05,0,-0.05,0,0,0.2", "--tcp", "0,0,0.02")
        assert beeline("show", "r.urdf", *options, "--out", "r.json").code == 0
        assert_assumptions(exported(beeline, tmp_path, "r.json", form, "p.csv", "--mount=0,0,-0.05").note,
                           root="root" in assumed_in(note), flange="flange" in assumed_in(note))


def test_a_trajectory_sets_the_tool_that_is_not_the_flange(beeline, written, tmp_path):
    names = ",".join(f"joint{i}" for i in range(1, 7))
    written("t.csv", f"t,{names}\n0,0,0,0,0,0.5,0\n1,0,0,0,0,0.5,1\n")
    for form in FORMS:
        moves = exported(beeline, tmp_path, "irb120", form, "t.csv", "--tcp", "0.01,0,0.1,0.2,0,0", "--mount", "1,1,1")
        np.testing.assert_allclose(moves.tool, translation(0.01, 0, 0.1) @ about("x", 0.2), atol=2e-9)
        assert "its load is not" in moves.note
        moves = exported(beeline, tmp_path, "irb120", form, "t.csv")
        assert moves.tool is None or (moves.tool == np.eye(4)).all()
        assert "load" not in moves.note


@pytest.mark.parametrize("form", FORMS)
def test_other_arms_are_refused_with_the_reason(refused, written, tables, form):
    written("p.csv", UP)
    out = f"p.{FORMS[form][0]}"
    for name, table in tables.items():
        if not table.six_revolute:
            refused(2, "export", name, "p.csv", "--as", form, "--out", out, says=[form, "six revolute joints"])
    follower = {"name": "b", "type": "revolute", "mimic": {"joint": "a1"}}
    joints = [{"name": f"a{i}", "type": "revolute"} for i in range(6)]
    written("m.json", json.dumps({"name": "m", "joints": [*joints, follower]}))
    refused(2, "export", "m.json", "p.csv", "--degrees", "--as", form, "--out", out, says=['"b" follows "a1"'])
