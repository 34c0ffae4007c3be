"""doctor: two descriptions of an arm, and what is different."""

import json
import math

import pytest

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
