"""batch: fk, jacobian and ik of the rows of files."""

import io
import json
import os
import subprocess

import numpy as np
import pytest

from arms import Q, text

UR5 = [f"joint{i}" for i in range(1, 7)]


@pytest.fixture
def rows(seed):
    """rows(n, k) -> n random rows of k numbers, the same in every run."""
    random = np.random.default_rng(seed)
    return lambda n, k, size=1.0: random.uniform(-size, size, (n, k))


@pytest.fixture
def batch(beeline, tmp_path):
    """batch("fk", "ur5", array or name, ...) -> what was written, and the JSON document."""

    def run(kind, arm, given, *options, out="out.npy", code=0):
        if not isinstance(given, str):
            np.save(tmp_path / "in.npy", given)
            given = "in.npy"
        answer = beeline("batch", kind, arm, "--in", given, "--out", out, "--json", *options)
        assert code is None or answer.code == code, answer.err
        document = answer.json
        assert document["out"] == out and document["rows_per_second"] >= 0
        if out.endswith(".npy"):
            values = np.load(tmp_path / out)
        else:
            header, *lines = (tmp_path / out).read_text().splitlines()
            assert header.split(",") == document["columns"]
            values = np.array([[float(item) for item in line.split(",")] for line in lines])
            values = values.reshape(len(lines), len(document["columns"]))
        assert values.shape == (document["rows"], len(document["columns"]))
        document["err"] = answer.err
        return values, document

    return run


def write_csv(path, values, header=()):
    lines = [",".join(header)] if header else []
    lines += [text(row) for row in np.asarray(values).tolist()]
    path.write_text("\n".join(lines) + "\n")
    return path.name


@pytest.mark.parametrize("arm", sorted(Q))
def test_fk_is_what_fk_says(beeline, batch, rows, arm):
    q = rows(5, Q[arm].count(",") + 1)
    matrices, document = batch("fk", arm, q)
    poses, _ = batch("fk", arm, q, "--layout", "pose")
    assert document["columns"][:4] == ["m11", "m12", "m13", "m14"]
    for row, matrix, pose in zip(q.tolist(), matrices, poses):
        one = beeline("fk", arm, "--q", text(row), "--json").json["pose"]
        np.testing.assert_allclose(matrix.reshape(4, 4), one["matrix"], atol=1e-13)
        quaternion = np.array([one["quaternion"][key] for key in ("qw", "qx", "qy", "qz")])
        np.testing.assert_allclose(pose[:3], one["translation"], atol=1e-13)
        sign = np.sign(quaternion @ pose[3:])  # of a half turn both are right
        assert pose[3] >= 0 and (sign > 0 or pose[3] < 1e-13)
        np.testing.assert_allclose(pose[3:], sign * quaternion, atol=1e-13)


@pytest.mark.parametrize("arm", sorted(Q))
@pytest.mark.parametrize("frame", ["base", "tool", "space"])
def test_jacobians_are_what_jacobian_says(beeline, batch, rows, arm, frame):
    q = rows(3, Q[arm].count(",") + 1)
    found, document = batch("jacobian", arm, q, "--frame", frame)
    assert document["frame"] == frame
    for row, numbers in zip(q.tolist(), found):
        one = beeline("jacobian", arm, "--q", text(row), "--frame", frame, "--json").json
        np.testing.assert_allclose(numbers.reshape(len(one["rows"]), -1), one["jacobian"],
                                   atol=1e-13)
        assert document["columns"] == [f"{r}_{c}" for r in one["rows"] for c in one["columns"]]


@pytest.mark.parametrize("arm", ["rrr", "ur5", "panda", "scara"])
@pytest.mark.parametrize("layout", ["matrix", "pose"])
def test_ik_leads_back(batch, rows, arm, layout):
    dof = Q[arm].count(",") + 1
    q = np.array([float(x) for x in Q[arm].split(",")]) + rows(50, dof, 0.05)
    poses, _ = batch("fk", arm, q, "--layout", layout)
    solutions, document = batch("ik", arm, poses)
    assert document["solved"] == 50 and document["unsolved"] == 0
    again, _ = batch("fk", arm, solutions, "--layout", layout)
    np.testing.assert_allclose(again, poses, atol=1e-9)


def test_csv_and_npy_say_the_same(batch, rows, tmp_path):
    q = rows(3000, 6, 3)
    name = write_csv(tmp_path / "q.csv", q, UR5)
    expected, _ = batch("fk", "ur5", q)
    for given, out in [(name, "a.csv"), (name, "a.npy"), (q, "a.csv")]:
        np.testing.assert_array_equal(batch("fk", "ur5", given, out=out)[0], expected)
    mixed = write_csv(tmp_path / "m.csv", q[:, ::-1], UR5[::-1])
    np.testing.assert_array_equal(batch("fk", "ur5", mixed)[0], expected)
    bare = write_csv(tmp_path / "b.csv", q)
    np.testing.assert_array_equal(batch("fk", "ur5", bare)[0], expected)


def test_results_are_the_same_for_any_number_of_threads(batch, rows):
    q = rows(30_000, 7, 2)
    one, _ = batch("jacobian", "panda", q, "--threads", "1")
    for threads in ("2", "3", "8"):
        np.testing.assert_array_equal(batch("jacobian", "panda", q, "--threads", threads)[0], one)


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 32767, 32768, 70_001])
def test_any_number_of_rows(batch, rows, count):
    q = rows(count, 3)
    poses, document = batch("fk", "rrr", q)
    assert document["rows"] == count and document["bad_rows"] == 0
    angles = q.sum(axis=1)
    np.testing.assert_allclose(poses[:, 0], np.cos(angles), atol=1e-14)


def test_what_numpy_writes_is_read(batch, rows, tmp_path):
    q = rows(4, 6)
    expected, _ = batch("fk", "ur5", q)
    single, _ = batch("fk", "ur5", q.astype("<f4"))
    np.testing.assert_allclose(single, expected, atol=1e-6)
    np.testing.assert_allclose(batch("fk", "ur5", np.asfortranarray(q[:1]))[0], expected[:1],
                               atol=1e-15)
    for version in [(1, 0), (2, 0), (3, 0)]:
        with open(tmp_path / "v.npy", "wb") as file:
            np.lib.format.write_array(file, q, version=version)
        np.testing.assert_array_equal(batch("fk", "ur5", "v.npy")[0], expected)
    line, _ = batch("fk", "R", q[:, 0])  # of shape (4,)
    assert line.shape == (4, 16)
    matrices, _ = batch("ik", "ur5", expected.reshape(-1, 4, 4))
    assert matrices.shape == (4, 6)


def test_numpy_reads_what_is_written(batch, rows, tmp_path):
    q = rows(100, 6)
    double, _ = batch("fk", "ur5", q, out="d.npy")
    single, _ = batch("fk", "ur5", q, "--float", out="f.npy")
    assert double.dtype == "<f8" and single.dtype == "<f4"
    np.testing.assert_array_equal(single, double.astype("<f4"))
    mapped = np.load(tmp_path / "d.npy", mmap_mode="r")
    assert mapped.flags["C_CONTIGUOUS"] and mapped.offset % 64 == 0
    batch("fk", "ur5", q, out="d.csv")
    table = np.genfromtxt(tmp_path / "d.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["m14"], double[:, 3])


def test_degrees_go_both_ways_and_leave_metres_alone(batch):
    poses, _ = batch("fk", "rp", np.array([[90, 0.5]]), "--degrees", "--layout", "pose")
    np.testing.assert_allclose(poses[0, :2], [0, 1.5], atol=1e-14)
    found, _ = batch("ik", "rp", poses, "--degrees", "--task", "110000")
    np.testing.assert_allclose(found, [[90, 0.5]], atol=1e-9)
    found, _ = batch("ik", "rrr", np.array([[5.64838, 2.00510, -75]]), "--degrees", "--seed",
                     "50,-50,-80")
    np.testing.assert_allclose(found, [[60, -45, -90]], atol=1e-3)


def test_poses_in_each_form(batch, beeline, tmp_path):
    pose = beeline("fk", "ur5", "--q", Q["ur5"], "--json").json["pose"]
    quaternion = [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")]
    matrix = np.array(pose["matrix"])
    yaw, pitch = np.arctan2(matrix[1, 0], matrix[0, 0]), -np.arcsin(matrix[2, 0])
    roll = np.arctan2(matrix[2, 1], matrix[2, 2])
    forms = {
        "x,y,z,qw,qx,qy,qz": pose["translation"] + quaternion,
        "x,y,z,roll,pitch,yaw": pose["translation"] + [roll, pitch, yaw],
        ",".join(f"m{i}{j}" for i in range(1, 5) for j in range(1, 5)): list(matrix.ravel()),
    }
    answers = []
    for header, numbers in forms.items():
        for names in (header.split(","), ()):
            name = write_csv(tmp_path / "p.csv", [numbers], names)
            answers.append(batch("ik", "ur5", name, "--seed", Q["ur5"])[0][0])
    np.testing.assert_allclose(answers, [[float(x) for x in Q["ur5"].split(",")]] * 6, atol=1e-7)


def test_a_pose_without_solution_is_nan_and_counted(batch):
    poses = np.array([[4, 3, 0], [100, 0, 0], [3, 4, 0.5]])
    for out in ("out.npy", "out.csv"):
        found, document = batch("ik", "rrr", poses, out=out, code=1)
        assert document["solved"] == 2 and document["unsolved"] == 1
        assert np.isnan(found[1]).all() and np.isfinite(found[[0, 2]]).all()
        assert document["err"].endswith(f"beeline: {document['reason']}\n")
        assert document["code"] == "poses_unsolved" and document["fields"] == {"count": 1, "of": 3}
        assert "statuses" not in document
    _, document = batch("ik", "rrr", poses, "--status", code=1)
    assert document["statuses"] == {"solved": 2, "unreachable": 1}
    _, document = batch("ik", "rrr", poses[[0, 2]])
    assert (document["reason"], document["code"], document["fields"]) == ("", None, {})


def test_limits_are_respected_unless_ignored(batch, rows):
    q = rows(20, 4)
    q[:, 3] = 0.6  # joint4 slides no farther than 0.17
    poses, document = batch("fk", "scara", q)
    assert document["outside_limits"] == 20 and "outside the arm's limits" in document["err"]
    _, strict = batch("ik", "scara", poses, code=1)
    _, free = batch("ik", "scara", poses, "--ignore-limits")
    assert strict["solved"] == 0 and free["solved"] == 20


def test_a_locked_joint_keeps_its_value(batch, rows):
    poses, _ = batch("fk", "panda", rows(20, 7))
    q, _ = batch("ik", "panda", poses, "--lock", "joint7=0.5", "--ignore-limits", code=None)
    solved = q[~np.isnan(q[:, 0])]
    assert len(solved) > 0 and np.all(solved[:, 6] == 0.5)


def test_a_pipe_on_both_sides(build, batch, rows, tmp_path):
    q = rows(5000, 6)
    write_csv(tmp_path / "q.csv", q)
    command = [str(build / "beeline"), "batch", "fk", "ur5", "--in", "-", "--out", "-"]
    with open(tmp_path / "q.csv") as file:
        process = subprocess.run(command, stdin=file, capture_output=True, text=True, check=True)
    found = np.loadtxt(io.StringIO(process.stdout), delimiter=",", skiprows=1)
    np.testing.assert_array_equal(found, batch("fk", "ur5", q)[0])
    assert "5000 rows" in process.stderr


def test_a_pipe_by_its_path_is_csv(build, tmp_path):
    command = f"{build}/beeline batch fk rrr --in <(printf '0,0,0\\n') --out - --layout pose"
    process = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd=tmp_path)
    assert process.returncode == 0 and process.stdout.splitlines()[1].startswith("9,")


def test_the_report_says_how_fast(beeline, tmp_path, rows):
    np.save(tmp_path / "q.npy", rows(10, 6))
    answer = beeline("batch", "jacobian", "ur5", "--in", "q.npy", "--out", "j.csv")
    assert answer.code == 0 and answer.err == ""
    assert "10 rows in" in answer.out and "rows/s" in answer.out and "base" in answer.out
    assert (tmp_path / "j.csv").read_text().startswith("vx_joint1,vx_joint2,")


@pytest.mark.skipif("-fsanitize=address" in os.environ.get("BEELINE_CXX_FLAGS", ""),
                    reason="the sanitizer keeps freed memory")
def test_memory_stays_the_same_for_any_number_of_rows(build, tmp_path, rows):
    def most_memory(count):
        np.save(tmp_path / "q.npy", rows(count, 6))
        code = ("import json, resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True);"
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)")
        command = [str(build / "beeline"), "batch", "fk", "ur5", "--in", "q.npy", "--out", "p.npy",
                   "--float", "--json"]
        run = subprocess.run([__import__("sys").executable, "-c", code, *command], cwd=tmp_path,
                             capture_output=True, text=True, check=True)
        return json.loads(run.stdout.splitlines()[-1])  # KiB

    few, many = most_memory(100_000), most_memory(1_000_000)  # 48 MB come in, 64 go out
    assert many < few + 8000


@pytest.mark.parametrize("row", [",,", ", ,", "--- --- ---", "nan,,", ";;"])
@pytest.mark.parametrize("header", ["", "x,y,theta\n"])
def test_a_row_without_data_is_a_bad_row(beeline, batch, tmp_path, row, header):
    separator = " " if "---" in row else ","
    text = header + "\n".join(["1,0,0", row, "0.5,0.5,0"]) + "\n"
    text = text.replace(",", separator)
    (tmp_path / "rows.csv").write_text(text)
    answer = beeline("batch", "ik", "rrr", "--in", "rows.csv", "--out", "out.csv")
    line = 3 if header else 2
    assert answer.code == 3 and f"rows.csv:{line}: row 2: " in answer.err, answer.err
    _, document = batch("ik", "rrr", "rows.csv", "--skip-bad", code=None)
    assert document["rows"] == 2 and document["bad_rows"] == 1
