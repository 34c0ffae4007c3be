"""ik: every option, and what it refuses."""

import math

import pytest

from arms import Q, joints, text

PANDA = ("ik", "panda", "--pose", "0.4,0.1,0.5,180,0,0", "--degrees")


def test_closed_form_and_numerical_find_the_same(ik, pose_at):
    pose = pose_at("ur5", Q["ur5"])
    closed = ik("ur5", pose, "--all", "--method", "closed_form")["solutions"]
    met = ik("ur5", pose, "--all", "--method", "numerical", "--max-restarts", "2000")["solutions"]
    assert len(closed) == len(met) == 8
    for a, b in zip(closed, met):
        assert a == pytest.approx(b, abs=1e-6)


def test_an_arm_without_closed_form_is_refused_one(refused):
    refused(2, "ik", "panda", "--pose", "0.4,0.1,0.5,3,0,0", "--task", "position", "--method",
            "closed_form", says=["panda", "closed form", "numerical"])


def test_a_time_limit_ends_a_search(ik, pose_at):
    pose = pose_at("ur5", Q["ur5"])
    endless = ("--method", "numerical", "--all", "--max-restarts", "2000000000")
    answer = ik("ur5", pose, *endless, "--time-limit", "0.05")
    assert answer["restarts"] < 2000000000
    assert answer["status"] == "time_limit" and not answer["complete"]
    assert "the time limit ended the search" in answer["reason"]
    assert ik("ur5", pose, "--time-limit", "3600") == ik("ur5", pose)


def test_redundancy_chooses_among_infinitely_many(ik, beeline):
    limits = [joint["limits"] for joint in beeline("show", "panda", "--json").json["joints"]]
    seed = [0.2, -0.6, 0.1, -2.2, 0.1, 1.7, 0.4]

    def answer(redundancy):
        return ik("panda", "0.4,0.1,0.5,3.1,0.1,0", "--seed", text(seed), "--redundancy",
                  redundancy)["solutions"][0]

    def margin(q):
        return min(min(value - limit["lower"], limit["upper"] - value)
                   / (limit["upper"] - limit["lower"]) for value, limit in zip(q, limits))

    first, nearest, centred = map(answer, ("any", "nearest", "centred"))
    assert math.dist(nearest, seed) < min(math.dist(first, seed), math.dist(centred, seed))
    assert margin(centred) > max(margin(first), margin(nearest))


def test_grid_is_the_number_of_values_of_the_redundant_joint(ik):
    def values(grid):
        solutions = ik("panda", "0.4,0.1,0.5,3.1,0.1,0", "--all", "--grid", grid)["solutions"]
        return {round(q[6], 9) for q in solutions}

    few, many = values(4), values(40)
    assert 1 <= len(few) <= 4 < len(many) <= 40


@pytest.mark.parametrize("arm, name, k, value, shown", [
    ("rrr", "joint2", 1, "0.9", 0.9),
    ("panda", "joint7", 6, "0.9", 0.9),  # the redundant joint of the closed form
    ("panda", "joint1", 0, "0.3", 0.3),
    ("iiwa14", "joint3", 2, "0.1", 0.1),
    ("scara", "joint4", 3, "0.1", 0.1),  # a slide
])
def test_a_locked_joint_keeps_its_value(ik, pose_at, arm, name, k, value, shown):
    pose = pose_at(arm, Q[arm])
    answer = ik(arm, pose, "--all", "--lock", f"{name}={value}")
    assert answer["status"] == "solved"
    assert all(q[k] == shown for q in answer["solutions"])
    assert min(math.dist(q, joints(Q[arm])) for q in answer["solutions"]) < 1e-6
    same = ik(arm, pose, "--all", "--lock", name, "--seed", Q[arm])  # the seed's value is the same
    assert all(q[k] == joints(Q[arm])[k] for q in same["solutions"])
    assert len(same["solutions"]) == len(answer["solutions"])


def test_a_lock_sets_the_seed_in_the_unit_of_the_command(beeline, ik):
    def locked(*options):
        document = beeline(*PANDA, "--json", "--all", *options).json
        return {q[6] for q in document["solutions"]}

    assert locked("--lock", "joint7=45") == {45}
    assert locked("--lock", "joint7=45", "--seed", "0,0,0,-90,0,90,10") == {45}
    assert locked("--lock", "joint7", "--seed", "0,0,0,-90,0,90,10") == {10}
    assert locked("--lock", "joint7") == {0}  # the middle of its limits
    slide = ik("scara", "0.4,0.1,0.287,180,0,0", "--degrees", "--lock", "joint4=0.1")
    assert slide["solutions"][0][3] == 0.1
    no = ik("scara", "0.4,0.1,0.287,180,0,0", "--degrees", "--lock", "joint4=0.2")
    assert no["status"] == "unreachable" and no["residual"] == pytest.approx(0.1)


@pytest.mark.parametrize("lock, says", [
    ("elbow", ["elbow", "joint1", "joint7"]),
    ("elbow=3", ['"elbow"', "joint1", "joint7"]),
    ("=3", ["joint1"]),
    ("7=1", ["--lock: joints have names, not numbers; joint 7 is joint7 (known: joint1,"]),
    ("7", ["joint 7 is joint7"]),
    ("8=1", ["unknown joint", '"8"', "joint7"]),
    ("joint7=", ["--lock joint7", "number"]),
    ("joint7=up", ["--lock joint7", "up"]),
    ("joint7=nan", ["--lock joint7", "nan"]),
    ("joint7=1e999", ["--lock joint7", "1e999"]),
    ("joint4=10", ["joint4", "its limits are"]),
    ("", ["--lock"]),
])
def test_an_invalid_lock(refused, lock, says):
    refused(2, *PANDA, "--lock", lock, says=says)


def test_only_one_joint_is_locked(refused):
    refused(2, *PANDA, "--lock", "joint1", "--lock", "joint2", says=["--lock"])
    refused(2, "ik", "R:1", "--pose", "1,0,0", "--lock", "joint1", says=["lock", "no joint"])


def test_every_turn_within_limits(ik, matrix, pose_at, refused):
    pose = pose_at("scara", Q["scara"])
    once = ik("scara", pose, "--all")["solutions"]
    turns = ik("scara", pose, "--all", "--every-turn")["solutions"]
    assert len(once) == 2 and len(turns) == 4  # joint 3 turns by 2 pi to either side
    for q in turns:
        assert matrix("scara", text(q)) == pytest.approx(matrix("scara", Q["scara"]), abs=1e-9)
        assert min(abs(q[2] - p[2]) % (2 * math.pi) for p in once) == pytest.approx(0, abs=1e-9)
    refused(2, "ik", "scara", "--pose", pose, "--every-turn", says=["--every-turn", "--all"])


def test_the_same_seed_gives_the_same_answer(beeline):
    arguments = ("ik", "panda", "--pose", "0.3,0.2,0.5,3,0.1,0.2", "--json", "--method",
                 "numerical", "--random-seed")
    for seed in ("0", "7", "18446744073709551615"):
        assert beeline(*arguments, seed).out == beeline(*arguments, seed).out


@pytest.mark.parametrize("option, values", [
    ("--method", ["fast", "closed-form", "1"]),
    ("--redundancy", ["centered", "0"]),
    ("--grid", ["0", "1", "-4", "nan", "many", "2.5", "99999999999"]),
    ("--time-limit", ["-1", "nan", "soon"]),
    ("--max-work", ["-1", "nan", "1.5", "99999999999999999999"]),
    ("--max-restarts", ["-1", "nan", "1.5", "99999999999"]),
    ("--max-iterations", ["-1", "ten", "99999999999999999999"]),
    ("--random-seed", ["-1", "1.5", "nan", "18446744073709551616", "99999999999999999999999"]),
    ("--tolerance", ["0", "-1", "nan", "inf", "small"]),
])
def test_an_invalid_value(refused, option, values):
    word = option[2:].replace("-", " ")
    for value in values:
        line = refused(2, *PANDA, f"{option}={value}", says=[value.split(".")[0]])
        assert word in line.replace("-", " "), line
