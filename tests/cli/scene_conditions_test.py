"""What a proof of clearance leaves out: reports and exported files say so."""

import json
import math

from scene_test import MOVING, URDF, ball, check, scene, words_of
from shaped_arm import trajectory


def test_reports_list_what_does_not_count(beeline, arm, motion, written):
    far = written("far.json", scene(ball("far", (-5, -5, 0))))
    text = beeline("check", arm, motion, *MOVING, "--scene", far).out
    assert "may touch     at a joint: link1 and link2, link2 and link3\n" in text
    proof = check(beeline, arm, motion, "--scene", far)["clearance"]
    assert proof["self_collision"] and proof["neighbour_pairs"] == [["link1", "link2"], ["link2", "link3"]]
    assert f"; each of the {proof['pairs']} pairs that count keeps at least " in text
    assert not proof["nothing_checked"] and proof["pairs"] + proof["apart_pairs"] == 4
    text = beeline("check", arm, motion, *MOVING, "--scene", far, "--no-self").out
    assert "may touch     by --no-self: all pairs of links\n" in text and "at a joint" not in text
    assert "each of the 3 pairs that count keeps at least " in text
    assert not check(beeline, arm, motion, "--scene", far, "--no-self")["clearance"]["self_collision"]
    allowed = [option for i in (1, 2) for option in ("--allow", f"link{i},far")]
    text = beeline("check", arm, motion, *MOVING, "--scene", far, "--no-self", *allowed).out
    assert "; the pair that counts keeps at least " in text


def test_a_check_of_no_pair_warns(beeline, written):
    bodies = [{"joint": f"joint{i}", "shapes": [{"sphere": {"radius": 0.6}}]} for i in (1, 2)]
    arm = written("arm.json", json.dumps({"name": "arm", "joint_string": "RRR:1,1,1", "shapes": bodies}))
    motion = written("motion.csv", trajectory((0.0, 0.0, 0.0, 0.0), (10.0, 1.0, 1.0, 0.0)))
    warned = "warning: no pair of bodies counts: nothing was checked\n"
    answer = beeline("check", arm, motion, *MOVING, "--self")
    assert answer.code == 0 and warned in answer.err
    assert "clearance     nothing was checked: no pair of bodies counts\npairs         0 of " in answer.out
    assert "kept at all times" not in answer.out
    answer = beeline("check", arm, motion, *MOVING, "--self", "--json")
    assert answer.json["clearance"]["nothing_checked"] and warned in answer.err
    moved = beeline("move", arm, "--from", "0,0,0", "--to", "1,1,0", "--self", "--out", "out.csv")
    assert moved.code == 0 and warned in moved.err


def test_a_pair_that_meets_only_outside_the_limits(beeline, written, tmp_path):
    bodies = [{"name": "base", "shapes": [{"sphere": {"radius": 0.1}}]},
              {"name": "tip", "joint": "joint3", "shapes": [{"sphere": {"radius": 0.1}}]}]
    arm = written("arm.json", json.dumps({"name": "arm", "joint_string": "RRR:1,1,1", "shapes": bodies}))
    written("limits.json", json.dumps({f"joint{i}": {"lower": -1, "upper": 1} for i in (2, 3)}))
    limits = ("--limits", "limits.json")
    fold = written("fold.csv", trajectory((0.0, 0.0, 0.0, 0.0), (10.0, 0.0, 2 * math.pi / 3, 2 * math.pi / 3)))
    answer = beeline("check", arm, fold, *MOVING, "--self", *limits, "--plot", "fold.svg")
    assert answer.code == 1 and "tip" in answer.err and "base" in answer.err
    assert "pairs         1 of 2 links and 0 obstacles; 1 of them only outside the joint limits, which the motion " \
           "leaves\n" in answer.out and "never meet" not in answer.out
    assert ">required<" in words_of((tmp_path / "fold.svg").read_text())
    report = check(beeline, arm, fold, "--self", *limits)["clearance"]
    assert (report["pairs"], report["apart_pairs"]) == (1, 0)
    inside = written("inside.csv", trajectory((0.0, 0.0, 0.0, 0.0), (10.0, 0.0, 0.9, 0.9)))
    answer = beeline("check", arm, inside, *MOVING, "--self", *limits)
    assert answer.code == 0 and "nothing was checked" not in answer.out + answer.err
    assert "clearance     kept at all times, proved; no pair of bodies meets within the joint limits\n" in answer.out
    assert "0 of 2 links and 0 obstacles; 1 more never meet within the joint limits, proved\n" in answer.out


def test_an_export_lists_the_conditions_of_its_proof(beeline, written, tmp_path):
    arm = written("arm.urdf", URDF.replace('<link name="finger">', """<link name="cable"><visual><geometry>
<sphere radius="0.1"/></geometry></visual></link><joint name="tie" type="fixed"><parent link="hand"/><child link="cable"/>
</joint><link name="finger">"""))
    written("still.csv", "t,j1,j2\n0,0,0\n1,0,0\n")
    written("far.json", scene(ball("far", (-5, -5, 0)), allowed_pairs=[["far", "base"]]))
    answer = beeline("export", arm, "still.csv", "--tip", "hand", "--as", "ros2", "--out", "out.yaml", "--scene", "far.json",
                     "--hold", "grip=0.1")
    assert answer.code == 0, answer.err
    assert "warning: links without shapes are not checked: cable\n" in answer.err
    comments = [line[2:] for line in (tmp_path / "out.yaml").read_text().splitlines() if line.startswith("# ")]
    assert {"May touch: far and base", "May touch: at a joint: base and upper, upper and hand", "Held: grip at 0.1",
            "No shapes: cable"} <= set(comments), comments
    (kept,) = [line for line in comments if line.startswith("Clearance of 0.001 m")]
    assert "pairs that count keeps at least" in kept and "bodies" not in kept
