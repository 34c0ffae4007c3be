"""--scene of ik, batch ik and line: solutions and branches that keep the clearance, and what the others hit."""

import json
import math
import random
import re

import pytest

from shaped_arm import LENGTHS

SEED = 11
RADIUS = 0.1  # of the links


def joints(q):
    """The ends of the links in the plane."""
    points, x, y, angle = [(0.0, 0.0)], 0.0, 0.0, 0.0
    for length, value in zip(LENGTHS, q):
        angle += value
        x, y = x + length * math.cos(angle), y + length * math.sin(angle)
        points.append((x, y))
    return points


def distance(q, ball, radius):
    """Of the links' capsules from a ball in the plane."""
    least = math.inf
    points = joints(q)
    for (ax, ay), (bx, by) in zip(points, points[1:]):
        dx, dy = bx - ax, by - ay
        s = max(0.0, min(1.0, ((ball[0] - ax) * dx + (ball[1] - ay) * dy) / (dx * dx + dy * dy)))
        least = min(least, math.hypot(ax + s * dx - ball[0], ay + s * dy - ball[1]))
    return least - RADIUS - radius


def scene(ball, radius):
    return json.dumps({"obstacles": [{"name": "ball", "shapes": [
        {"sphere": {"radius": radius}, "pose": {"xyz": [*ball, 0]}}]}]})


def pose_of(q):
    x, y = joints(q)[-1]
    return x, y, math.remainder(sum(q), 2 * math.pi)


def text_of(pose):
    return ",".join(map(repr, pose))


def test_each_solution_is_free_or_blocked_by_its_distance(beeline, arm, written):
    rng = random.Random(SEED)
    counts = {"free": 0, "blocked": 0, "none": 0}
    for _ in range(12):
        q = [rng.uniform(-2, 2) for _ in range(3)]
        pose = "--pose=" + text_of(pose_of(q))
        ball = [a + rng.uniform(-0.3, 0.3) for a in joints(q)[rng.randrange(1, 3)]]
        cell = written("cell.json", scene(ball, 0.3))
        options = ("--scene", cell, "--no-self", "--clearance", "0.05", "--json")
        every = beeline("ik", arm, pose, "--all", "--json").json["solutions"]
        answer = beeline("ik", arm, pose, "--all", *options)
        found = answer.json
        assert sorted(found["solutions"] + [one["q"] for one in found["blocked"]]) == sorted(every)
        for free in found["solutions"]:
            assert distance(free, ball, 0.3) >= 0.05 - 1e-9, (SEED, free)
        for one in found["blocked"]:
            near = distance(one["q"], ball, 0.3)
            assert near <= 0.05 + 1e-9 and one["fields"]["other_body"] == "ball"
            assert one["code"] == ("bodies_collide" if near <= 0 else "bodies_too_close")
            if near > 0:
                assert one["fields"]["distance"] == pytest.approx(near, abs=1e-6)
        assert found["scene"]["obstacles"] == ["ball"] and not found["scene"]["nothing_checked"]
        first = beeline("ik", arm, pose, *options)
        if found["solutions"]:
            assert answer.code == first.code == 0 and found["status"] == first.json["status"] == "solved"
            assert first.json["solutions"] == found["solutions"][:1]
            counts["free"] += 1
            counts["blocked"] += bool(first.json["blocked"])
        else:
            assert answer.code == first.code == 1 and found["status"] == first.json["status"] == "blocked"
            assert found["code"] == first.json["code"] == "all_solutions_blocked"
            assert "ball" in answer.err and "every solution is blocked" in first.err
            counts["none"] += 1
    assert all(counts.values()), (SEED, counts)


def test_the_text_names_the_pair_and_its_distance(beeline, arm, written):
    q = (0.3, 0.9, 0.4)
    cell = written("cell.json", scene(joints(q)[1], 0.2))
    answer = beeline("ik", arm, "--pose=" + text_of(pose_of(q)), "--all", "--scene", cell)
    assert answer.code == 0, answer.err
    assert "1 free solution and 1 blocked, all that exist," in answer.out
    assert re.search(r"blocked: 0.3, 0.9, 0.4; link[12] and ball: 0.3 m deep\n", answer.out) and "may touch" in answer.out


def test_a_redundant_arm_moves_along_its_self_motion(beeline, arm, written):
    rng = random.Random(SEED)
    moved = tried = 0
    for _ in range(10):
        q = [rng.uniform(-1, 1) for _ in range(3)]
        x, y, _ = pose_of(q)
        request = (f"--pose={x!r},{y!r}", "--task", "position", "--json", "--seed=" + text_of(q))
        found = beeline("ik", arm, *request).json["solutions"][0]
        ball = joints(found)[1]
        cell = written("cell.json", scene(ball, 0.2))
        answer = beeline("ik", arm, *request, "--scene", cell, "--no-self")
        assert answer.code == 0, (SEED, answer.err)
        free = answer.json["solutions"][0]
        assert distance(free, ball, 0.2) >= 0.001 - 1e-9
        assert math.dist(pose_of(free)[:2], (x, y)) < 1e-9
        moved += bool(answer.json["blocked"])
        everywhere = written("shut.json", scene((x, y), 0.2))
        shut = beeline("ik", arm, *request, "--scene", everywhere, "--no-self")
        assert shut.code == 1 and shut.json["status"] == "blocked" and shut.json["code"] == "solutions_blocked"
        tried += len(shut.json["blocked"])
    assert moved == 10 and tried > 100, "the samples of the self-motion that were tried"


def test_rows_of_a_batch_have_a_status(beeline, arm, written, tmp_path):
    rng = random.Random(SEED)
    rows = [[rng.uniform(-2, 2) for _ in range(3)] for _ in range(40)]
    ball = joints(rows[0])[-1]
    cell = written("cell.json", scene(ball, 1.0))
    poses = written("poses.csv", "x,y,theta\n" + "".join(text_of(pose_of(q)) + "\n" for q in rows))
    report = beeline("batch", "ik", arm, "--in", poses, "--out", "q.csv", "--status", "--scene", cell, "--no-self", "--json")
    assert report.code == 1 and report.json["scene"]["obstacles"] == ["ball"]
    names = beeline("batch", "ik", "--help").out
    number = int(re.search(r"(\d+)\s+blocked\)", names)[1])
    lines = (tmp_path / "q.csv").read_text().splitlines()
    assert lines[0].split(",")[3:] == ["status", "residual"]
    for q, line in zip(rows, lines[1:]):
        *values, status, _ = map(float, line.split(","))
        single = beeline("ik", arm, "--pose=" + text_of(pose_of(q)), "--scene", cell, "--no-self", "--json").json
        assert int(status) == (0 if single["status"] == "solved" else number) or single["status"] not in ("solved", "blocked")
        if status == 0:
            assert values == single["solutions"][0] and distance(values, ball, 1.0) >= 0.001 - 1e-9
        else:
            assert all(map(math.isnan, values))
    statuses = report.json["statuses"]
    assert statuses["blocked"] > 0 and statuses["solved"] == report.json["solved"] > 0
    text = beeline("batch", "ik", arm, "--in", poses, "--out", "q.csv", "--status", "--scene", cell, "--no-self")
    assert f"blocked       {statuses['blocked']}\n" in text.out


def test_a_line_takes_a_branch_that_is_free_for_the_whole_path(beeline, arm, written):
    q, to = (0.4, 0.9, -0.3), (0.5, 0.8, -0.2)
    poses = written("poses.csv", "x,y,theta\n" + "".join(text_of(pose_of(p)) + "\n" for p in (q, to)))
    best = beeline("line", arm, "--through", poses, "--out", "best.csv", "--branches", "--json").json
    starts = [branch["start"] for branch in best["branches"]]
    assert len(starts) == 2
    cell = written("cell.json", scene(joints(starts[0])[1], 0.2))
    line = ("line", arm, "--through", poses, "--out", "motion.csv", "--scene", cell)
    answer = beeline(*line, "--json")
    assert answer.code == 0, answer.err
    report = answer.json
    assert report["clearance"]["status"] == "clear" and len(report["blocked"]) == 1
    blocked = report["blocked"][0]
    assert blocked["start"] == starts[0] and blocked["status"] == "collides"
    assert blocked["fields"]["other_body"] == "ball" and "time" in blocked["fields"]
    assert beeline("check", arm, "motion.csv", "--scene", cell).code == 0
    printed = re.search(r"blocked       --from=(.*): at \S+ s link[12] and ball collide", beeline(*line).out)
    assert list(map(float, printed[1].split(","))) == starts[0]
    # That start itself, and a ball that both branches meet.
    assert beeline(*line, "--from=" + text_of(starts[0])).code == 1
    shut = written("shut.json", scene(pose_of(q)[:2], 0.2))
    answer = beeline(*line[:-1], shut, "--json")
    assert answer.code == 1 and answer.json["status"] == "collides"
    assert [one["start"] for one in answer.json["blocked"]] == starts


def test_a_line_moves_aside_or_suggests_another(beeline, written):
    def post(x, y, z, size):
        return json.dumps({"obstacles": [{"name": "post", "shapes": [{"box": {"size": size}, "pose": {"xyz": [x, y, z]}}]}]})

    poses = written("poses.csv", "x,y,z,roll,pitch,yaw\n0.394,0.4,0.555,180,0,-45\n")
    line = ("line", "panda", "--from=0,-30,0,-130,0,100,45", "--degrees", "--through", poses, "--out", "motion.csv", "--scene")
    aside = written("post.json", post(0.1, 0.2, 0.75, [0.06, 0.06, 1.5]))
    answer = beeline(*line, aside, "--json")
    assert answer.code == 0 and answer.json["clearance"]["status"] == "clear", answer.err
    assert [one["fields"]["other_body"] for one in answer.json["blocked"]] == ["post"]
    assert beeline("check", "panda", "motion.csv", "--scene", aside).code == 0
    # At the goal, which nothing can reach then.
    wall = written("wall.json", post(0.4, 0.4, 0.55, [0.3, 0.05, 0.3]))
    answer = beeline(*line, wall, "--json")
    assert answer.code == 1 and answer.json["status"] == answer.json["clearance"]["status"] == "collides"
    assert answer.json["nearby"]
    printed = beeline(*line, wall).out
    assert "would work    with every waypoint moved by" in printed and "kept at all times" not in printed


# Between the work with which no motion is planned yet and the work with which the search ends.
def test_a_search_aside_that_ends_early_says_so(beeline, written):
    wall = written("wall.json", json.dumps({"obstacles": [
        {"name": "wall", "shapes": [{"box": {"size": [0.3, 0.05, 0.3]}, "pose": {"xyz": [0.4, 0.4, 0.55]}}]}]}))
    poses = written("poses.csv", "x,y,z,roll,pitch,yaw\n0.394,0.4,0.555,180,0,-45\n")
    line = ("line", "panda", "--from=0,-30,0,-130,0,100,45", "--degrees", "--through", poses, "--scene", wall)
    work = 100
    while work < 1e7:
        report = (answer := beeline(*line, "--json", f"--max-work={work}")).json
        if report["status"] == "collides" and report["fields"].get("search_ending") == "work_limit":
            break
        work = work * 5 // 4
    assert "the limit of work ended the search for another motion" in report["reason"]
    assert report["reason"] in answer.err
    assert report["clearance"]["fields"]["search_ending"] == "work_limit"


@pytest.mark.parametrize("options, says", [
    (("--clearance", "0.1"), "--clearance"),
    (("--scene", "none.json"), "none.json"),
    (("--self", "--no-self"), "--no-self"),
])
def test_bad_options_are_refused(refused, arm, written, options, says):
    code = 3 if "none.json" in options else 2
    refused(code, "ik", arm, "--pose=4,4,0", *options, says=[says])
    poses = written("poses.csv", "x,y,theta\n4,4,0\n")
    refused(code, "batch", "ik", arm, "--in", poses, "--out", "q.csv", *options, says=[says])


def test_an_arm_without_shapes_is_refused(refused, written):
    cell = written("cell.json", scene((1, 1), 0.1))
    refused(2, "ik", "rrr", "--pose=4,4,0", "--scene", cell, says=["--scene", "no shapes"])
