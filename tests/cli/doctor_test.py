"""doctor: suspicious numbers of one model; what two descriptions of an arm have different."""

import json
import math
import re

import pytest
from shaped_arm import planar_arm

UR5 = {"a": [0, -0.425, -0.39225, 0, 0, 0], "d": [0.089159, 0, 0, 0.10915, 0.09465, 0.0823],
       "alpha": [math.pi / 2, 0, 0, math.pi / 2, -math.pi / 2, 0]}


def table(columns, convention="standard", **more):
    n = len(next(iter(columns.values())))
    rows = [{key: values[i] for key, values in columns.items()} for i in range(n)]
    return json.dumps({"name": "table", "dh": {"convention": convention, "rows": rows}, **more})


def changed(**columns):
    """UR5's table with other numbers: d={0: 0.1} is the first d."""
    rows = {key: list(values) for key, values in UR5.items()} | {"theta": [0] * 6}
    for key, numbers in columns.items():
        for row, value in numbers.items():
            rows[key][row] = value
    return rows


def test_equal_arms_exit_with_0(beeline, written):
    answer = beeline("doctor", "panda", "panda", "--json")
    assert answer.code == 0 and answer.err == ""
    assert answer.json["status"] == "same" and answer.json["differences"] == []


@pytest.mark.parametrize("columns, kind, joint, parameter", [
    ({"d": {0: 0.089459}}, "length", 1, "d"),
    ({"a": {1: 0.425}}, "length", 2, "a"),
    ({"a": {1: -425}}, "length", 2, "a"),
    ({"alpha": {3: -math.pi / 2}}, "angle", 4, "alpha"),
    ({"alpha": {4: -1.57}}, "angle", 5, "alpha"),
    ({"alpha": {0: 90}}, "angle", 1, "alpha"),
    ({"theta": {2: math.pi / 2}}, "joint_offset", 3, "offset"),
])
def test_one_wrong_number_is_named(beeline, written, columns, kind, joint, parameter):
    written("b.json", table(changed(**columns)))
    answer = beeline("doctor", "ur5", "b.json", "--json")
    assert answer.code == 1
    document = answer.json
    # Built-in limits are not in the table.
    assert [(d["kind"], d["joint"], d["parameter"]) for d in document["differences"]] == [
        (kind, joint, parameter)]
    assert document["explained"] and document["residual"]["position"] < 1e-9


def test_the_same_table_of_the_other_convention(beeline, written):
    written("b.json", table(UR5, "modified"))
    document = beeline("doctor", "ur5", "b.json", "--json").json
    assert document["status"] == "reconciled"
    assert [d["kind"] for d in document["differences"]] == ["convention"]
    assert "modified DH" in document["differences"][0]["what"]


def test_a_remedy_can_be_typed(beeline, written):
    written("b.json", table(UR5, base={"xyz": [0, 0, 0.67183]}, tool={"xyz": [0, 0, 0.1]}))
    document = beeline("doctor", "ur5", "b.json", "--json").json
    remedies = {d["kind"]: d["remedy"] for d in document["differences"]}
    assert remedies == {"mount": "--mount 0,0,0.67183", "tool": "--tcp 0,0,0.1"}
    again = beeline("doctor", "ur5", "b.json", "--json", *" ".join(remedies.values()).split())
    assert again.json["status"] == "same"


def test_the_text_is_aligned(beeline, written):
    written("b.json", table(changed(d={0: 0.089459})))
    answer = beeline("doctor", "ur5", "b.json")
    assert answer.code == 1
    lines = answer.out.splitlines()
    assert lines[0].startswith("not the same: d of joint 1 differs")
    assert "  joint 1  d 0.089159 m in A, 0.089459 m in B" in lines
    assert any("--mount 0,0,0.0003" in line for line in lines)


def test_bad_input(refused, written):
    refused(2, "doctor", "ur5", "ur55", says=['"ur5"'])
    refused(3, "doctor", "ur5", "missing.json", says=["missing.json"])
    refused(2, "doctor", "ur5", "ur5", "--tolerance", "0", says=["--tolerance"])


URDF = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j1" type="revolute"><parent link="a"/><child link="b"/>
<origin xyz="0 0 {height}" rpy="{roll} 0 0"/>{axis}<limit lower="{lower}" upper="{upper}" velocity="2"/></joint>
<joint name="j2" type="revolute"><parent link="b"/><child link="c"/>
<origin xyz="0.3 0 0" rpy="0 0 0"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="2"/></joint></robot>"""
RIGHT = {"height": "0.3", "roll": "0", "axis": '<axis xyz="0 0 1"/>', "lower": "-2", "upper": "2"}


def test_a_right_model_is_silent(beeline, written):
    written("r.urdf", URDF.format(**RIGHT))
    answer = beeline("doctor", "r.urdf", "--json")
    assert answer.code == 0 and answer.err == ""
    assert answer.json["status"] == "clear" and answer.json["findings"] == []


@pytest.mark.parametrize("wrong, kind, says", [
    ({"height": "300"}, "length_unit", "millimetres"),
    ({"roll": "1.5708"}, "rounded_angle", "pi/2 with 5 digits"),
    ({"roll": "90"}, "angle_unit", "degrees"),
    ({"axis": ""}, "missing_axis", "1 0 0"),
    ({"axis": '<axis xyz="0 0 2"/>'}, "axis_length", "length 2"),
    ({"lower": "-170", "upper": "170"}, "angle_unit", "degrees"),
    ({"lower": "0", "upper": "0"}, "no_range", "no motion"),
])
def test_a_wrong_number_is_found(beeline, written, wrong, kind, says):
    written("r.urdf", URDF.format(**RIGHT | wrong))
    answer = beeline("doctor", "r.urdf", "--json")
    assert answer.code == 1
    (finding,) = answer.json["findings"]
    assert finding["kind"] == kind and says in finding["what"]
    assert "j1" in finding["place"] or finding["joint"] == 1


@pytest.mark.parametrize("axis, says", [
    ('<Axis xyz="0 1 0"/><axis xyz="0 0 1"/>', 'unknown element "<Axis>"; did you mean "<axis>"?'),
    ('<axis xyz="0 0 1" XYZ="1 0 0"/>', 'unknown attribute of <axis> "XYZ"; did you mean "xyz"?'),
    ('<axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="2" min="-1"/>', 'unknown attribute of <limit> "min" (known: lower, upper,'),
    ('<axis xyz="0 0 1"/><axis xyz="0 1 0"/>', "joint j1 has 2 elements <axis>; the first one counts"),
    ('<axis xyz="0 0 1"/><mimic joint="j2" multiplier="0"/>', "mimics joint j2 with multiplier 0: it is constant at 0"),
])
def test_what_is_ignored_is_named_with_its_line(beeline, written, axis, says):
    written("r.urdf", URDF.format(**RIGHT | {"axis": axis}))
    findings = [finding for finding in beeline("doctor", "r.urdf", "--json").json["findings"] if says in finding["what"]]
    assert [(finding["kind"], finding["place"]) for finding in findings] == [("fault", "line 3")]
    shown = beeline("fk", "r.urdf", "--q", "0" if "mimic" in axis else "0,0")
    assert f"beeline: warning: r.urdf:3: joint j1" in shown.err and says in shown.err and shown.code == 0
    printed = beeline("doctor", "r.urdf")
    assert printed.code == 1 and printed.out.count("r.urdf") == 1
    assert "warning" not in printed.err


def test_the_same_advice_is_given_once(beeline, written):
    text = URDF.format(**RIGHT | {"roll": "90"})
    written("r.urdf", text.replace('rpy="0 0 0"', 'rpy="0 0 180"'))
    out = beeline("doctor", "r.urdf").out
    assert out.count("degrees?") == 2 and out.count("write radians") == 1
    written("r.urdf", text.replace("<link", "<xacro:a/><link", 1).replace('name="r">', 'name="r"><xacro:b/>', 1).replace('lower="-2"', 'lower="3"', 1))
    err = beeline("doctor", "r.urdf").err
    assert err.count("run xacro") == 1 and err.count("<xacro:") == 2


def test_degrees_in_a_table(beeline, written):
    written("t.json", table(changed(alpha={0: 90})))
    findings = beeline("doctor", "t.json", "--json").json["findings"]
    assert ("angle_unit", 1) in [(f["kind"], f.get("joint")) for f in findings]


def test_the_lost_method_is_named(beeline, written):
    written("t.json", table(changed(alpha={0: 1.5708, 3: 1.5708, 4: -1.5708}, d={4: 0.09465})))
    answer = beeline("doctor", "t.json")
    assert answer.code == 1
    assert "pi/2 with 5 digits" in answer.out and "write 1.5707963267948966" in answer.out


def test_swapped_limits_are_refused_where_the_file_is_read(refused, written):
    written("r.urdf", URDF.format(**RIGHT | {"lower": "2", "upper": "-2"}))
    refused(3, "doctor", "r.urdf", says=["j1", "lower limit 2 exceeds upper limit -2"])


def test_a_table_in_degrees_is_believed(beeline, written):
    written("t.json", json.dumps({"name": "elbow", "dh": {"convention": "standard", "degrees": True, "rows": [
        {"d": 0.3, "alpha": 90}, {"a": 0.4}, {"a": 0.3}]}}))
    answer = beeline("doctor", "t.json")
    assert answer.code == 0 and "nothing suspicious" in answer.out


def test_two_arms_have_no_order(beeline, written):
    written("b.json", table(changed(d={0: 0.089459})))
    for arms in [("ur5", "b.json"), ("b.json", "ur5"), ("b.json", "b.json"), ("RRR", "b.json"), ("b.json", "RRR")]:
        assert beeline("doctor", *arms).code in (0, 1), arms


def test_a_fault_beside_the_chain_is_a_finding(beeline, written):
    fault = '<joint name="camera" type="fixed"><parent link="nowhere"/><child link="c"/></joint></robot>'
    written("r.urdf", URDF.format(**RIGHT).replace("</robot>", fault))
    answer = beeline("doctor", "r.urdf", "--json")
    assert answer.code == 1
    (finding,) = answer.json["findings"]
    assert finding["kind"] == "fault" and "nowhere" in finding["what"] and finding["place"] == "line 5"
    assert "r.urdf: 1 fault" in beeline("doctor", "r.urdf").out


def test_all_faults_of_a_file_are_listed_where_its_chain_has_one(beeline, refused, written):
    text = URDF.format(**RIGHT | {"lower": "2", "upper": "-2"})
    lost = '<joint name="camera" type="fixed"><parent link="nowhere"/><child link="c"/></joint></robot>'
    written("r.urdf", text.replace("</robot>", lost))
    answer = beeline("doctor", "r.urdf", "--json")
    assert answer.code == 3 and answer.out == ""
    lines = answer.err.splitlines()
    assert len(lines) >= 4 and "r.urdf has" in lines[0] and lines[-1].endswith("lower limit 2 exceeds upper limit -2")
    assert any("nowhere" in line and "line 5" in line for line in lines[1:-1])
    written("r.urdf", text.replace("</robot>", '<joint name="x" type="ball"><parent link="b"/><child link="x"/></joint><link name="x"/></robot>'))
    assert "unknown type" in beeline("doctor", "r.urdf", "--tip", "b").err


def test_a_fault_beside_the_chain_is_said_once(beeline, written):
    ball = '<joint name="x" type="ball"><parent link="b"/><child link="x"/></joint><link name="x"/></robot>'
    written("r.urdf", URDF.format(**RIGHT).replace("</robot>", ball))
    answer = beeline("doctor", "r.urdf", "--tip", "c")
    assert answer.out.count("unknown type") == 1 and "unknown type" not in answer.err
    assert answer.out.count("r.urdf") == 1, "its lines name places of one file"


def test_no_number_is_minus_zero(beeline, written):
    written("a.json", table(changed(d={0: -0.0}, a={0: -0.0}), base={"xyz": [-0.0, 0, 0], "rpy": [0, 0, -0.0]}))
    written("b.json", table(changed(d={0: 0.2}, theta={1: -0.0}, a={2: -0.0})))
    written("r.urdf", URDF.format(**RIGHT | {"lower": "-0.0", "upper": "-0.0"}))
    for words in [("r.urdf",), ("panda", "iiwa14"), ("iiwa14", "panda"), ("panda", "ur5"), ("a.json", "b.json"), ("b.json", "a.json"), ("ur5", "a.json"), ("a.json", "ur5", "--degrees")]:
        text = beeline("doctor", *words).out
        assert not re.search(r"-0(?![.\d])", text), text


def test_exempted_pairs_that_collide_are_named(beeline, written):
    written("arm.json", planar_arm())
    post = {"name": "post", "shapes": [{"sphere": {"radius": 0.2}, "pose": {"xyz": [5, 0, 0]}}]}
    far = {"name": "far", "shapes": [{"sphere": {"radius": 0.2}, "pose": {"xyz": [20, 0, 0]}}]}
    written("cell.json", json.dumps({"obstacles": [post, far], "exempted_pairs": [
        ["post", "link3"], ["far", "link3"], ["link1", "link2"], ["post", "far"]]}))
    answer = beeline("doctor", "arm.json", "--scene", "cell.json", "--json")
    assert answer.code == 1 and answer.json["status"] == "suspicious" and answer.json["findings"] == []
    found = {tuple(one["bodies"]): one for one in answer.json["exemptions"]}
    statuses = [found[pair]["status"] for pair in (("post", "link3"), ("far", "link3"), ("link1", "link2"), ("post", "far"))]
    assert statuses == ["collides", "no_collision", "not_checked", "not_checked"]
    ended = beeline("doctor", "arm.json", "--scene", "cell.json", "--max-work", "0", "--json")
    assert ended.code == 1 and ended.json["status"] == "work_limit"
    assert [one["status"] for one in ended.json["exemptions"]] == ["work_limit", "work_limit", "not_checked", "not_checked"]
    ended = beeline("doctor", "arm.json", "--scene", "cell.json", "--time-limit", "0")
    assert ended.code == 1 and "not finished        2 pairs" in ended.out and "not finished" in ended.err
    q = ",".join(map(str, found["post", "link3"]["q"]))
    text = beeline("doctor", "arm.json", "--scene", "cell.json").out
    assert "1 exempted pair that collides" in text and "post and link3" in text
    # Without the exemption the same configuration is refused.
    written("cell.json", json.dumps({"obstacles": [post]}))
    written("there.csv", f"t,joint1,joint2,joint3\n0,{q}\n1,{q}\n")
    refused = beeline("check", "arm.json", "there.csv", "--scene", "cell.json", "--json")
    assert refused.code == 1 and refused.json["clearance"]["status"] == "collides"


def test_exemptions_without_shapes_are_not_examined(beeline, written):
    written("r.srdf", '<robot name="r"><disable_collisions link1="a" link2="b"/></robot>')
    answer = beeline("doctor", "rrr", "--srdf", "r.srdf")
    assert answer.code == 0 and "not examined" in answer.err


def test_a_scene_that_cannot_be_read_is_refused(beeline, written):
    answer = beeline("doctor", "ur5", "--scene", "none.json")
    assert answer.code == 3 and "none.json" in answer.err
    written("bad.json", '{"obstacles": [{}]}')
    assert beeline("doctor", "ur5", "--scene", "bad.json").code == 3


def test_options_of_scenes_need_one(beeline):
    assert beeline("doctor", "ur5", "--hold", "x=1").code == 2
    assert beeline("doctor", "ur5", "ur5", "--scene", "none.json").code == 2
