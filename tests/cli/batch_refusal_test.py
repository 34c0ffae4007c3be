"""batch: bad input ends with one line, the documented exit code, and no file."""

import os
import subprocess

import numpy as np
import pytest

GOOD = "1,2,3\n"
FILES = [
    ("too few", "joint1,joint2,joint3\n1,2,3\n1,2\n", ["q.csv:3", "row 2", "2 items"]),
    ("too many", GOOD + "1,2,3,4\n", ["q.csv:2", "row 2", "4 items"]),
    ("no number", GOOD + "# remark\n1,two,3\n", ["q.csv:3", "row 2", "joint2", "two"]),
    ("missing", GOOD + "1,,3\n", ["q.csv:2", "joint2", "missing"]),
    ("nan", GOOD + "1,nan,3\n", ["q.csv:2", "joint2", "finite"]),
    ("inf", GOOD + "1,2,-inf\n", ["q.csv:2", "joint3", "finite"]),
    ("too large", GOOD + "1,2,1e400\n", ["q.csv:2", "joint3", "range"]),
    ("bad first row", "1,x,3\n", ["q.csv:1", "row 1", "joint2"]),
    ("other names", "q1,q2,q3\n1,2,3\n", ["q.csv:1", "q1, q2, q3", "joint1, joint2, joint3"]),
    ("name twice", "joint1,joint1,joint3\n1,2,3\n", ["q.csv:1", "joint1", "given twice"]),
    ("empty", "", ["q.csv", "empty"]),
    ("header alone", "joint1,joint2,joint3\n", ["q.csv", "no rows"]),
    ("comments", "# nothing\n\n", ["q.csv", "empty"]),
    ("binary", "\x00\x01\x02\n\x00,\x01,\x02\n", ["q.csv:1"]),
    ("no line", "1" * 2_000_000, ["q.csv", "longer than"]),
]


@pytest.mark.parametrize("_, content, says", FILES, ids=[case[0] for case in FILES])
@pytest.mark.parametrize("out", ["out.csv", "out.npy"])
def test_a_bad_csv_file(refused, written, tmp_path, _, content, says, out):
    refused(3, "batch", "fk", "rrr", "--in", written("q.csv", content), "--out", out, says=says)
    assert [path.name for path in tmp_path.iterdir()] == ["q.csv"]


def test_a_table_of_unknown_kind(refused, written):
    refused(3, "batch", "fk", "rrr", "--in", written("q.txt", GOOD), "--out", "p.csv",
            says=["q.txt", ".csv, .npy"])


def test_a_bad_row_late_in_a_long_file_leaves_the_old_results(refused, written, tmp_path):
    written("out.csv", "old")
    written("q.csv", GOOD * 200_000 + "1,2\n")
    refused(3, "batch", "fk", "rrr", "--in", "q.csv", "--out", "out.csv",
            says=["q.csv:200001", "row 200001"])
    assert (tmp_path / "out.csv").read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 2


def test_bad_rows_are_left_out_when_asked(beeline, written, tmp_path):
    written("q.csv", "1,2,3\n1,2\n0,0,0\n1,x,3\n")
    answer = beeline("batch", "fk", "rrr", "--in", "q.csv", "--out", "p.npy", "--skip-bad",
                     "--json")
    assert answer.code == 0 and answer.json["rows"] == 2 and answer.json["bad_rows"] == 2
    assert "2 bad rows" in answer.err and "q.csv:2: row 2" in answer.err
    assert np.load(tmp_path / "p.npy")[1][3] == 9


ARRAYS = [
    ("big endian", np.zeros((2, 3), ">f8"), [">f8", "astype"]),
    ("integers", np.zeros((2, 3), int), ["<i8", "astype"]),
    ("half", np.zeros((2, 3), "<f2"), ["<f2"]),
    ("complex", np.zeros((2, 3), complex), ["<c16"]),
    ("records", np.zeros(3, [("x", "<f8")]), ["records"]),
    ("columns", np.asfortranarray(np.zeros((2, 3))), ["fortran_order", "ascontiguousarray"]),
    ("width", np.zeros((2, 4)), ["rows of 4 numbers", "joint1, joint2, joint3"]),
    ("one row", np.zeros(3), ["rows of 1 number", "reshape(1, -1)"]),
    ("scalar", np.array(1.0), ["single number"]),
    ("no columns", np.zeros((3, 0)), ["rows of 0 numbers"]),
    ("nan", np.array([[0, 0, 0], [0, np.nan, 0]]), ["row 2", "joint2", "nan"]),
    ("inf", np.array([[0, 0, 0], [0, 0, np.inf]], "<f4"), ["row 2", "joint3", "inf"]),
]


@pytest.mark.parametrize("_, array, says", ARRAYS, ids=[case[0] for case in ARRAYS])
def test_a_bad_array(refused, tmp_path, _, array, says):
    np.save(tmp_path / "q.npy", array)
    refused(3, "batch", "fk", "rrr", "--in", "q.npy", "--out", "out.npy", says=["q.npy", *says])
    assert [path.name for path in tmp_path.iterdir()] == ["q.npy"]


def test_a_file_cut_off_anywhere(refused, tmp_path):
    np.save(tmp_path / "q.npy", np.zeros((10, 3)))
    whole = (tmp_path / "q.npy").read_bytes()
    for size in [0, 1, 7, 9, 10, 50, 127, 128, 129, len(whole) - 1]:
        (tmp_path / "q.npy").write_bytes(whole[:size])
        line = refused(3, "batch", "fk", "rrr", "--in", "q.npy", "--out", "o.npy", says=["q.npy"])
        assert size < 128 or ("10 rows of 3" in line and f"and has {(size - 128) // 24}" in line)
    (tmp_path / "q.npy").write_bytes(whole + b"more")
    refused(3, "batch", "fk", "rrr", "--in", "q.npy", "--out", "o.npy", says=["4 bytes after"])


POSES = [
    ("quaternion", "x,y,z,qw,qx,qy,qz\n0,0,0,1,1,0,0\n", ["p.csv:2", "row 1", "length"]),
    ("reflection", "1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1\n", ["p.csv:1", "right-handed"]),
    ("last row", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2\n", ["p.csv:1", "0, 0, 0, 1"]),
    ("header alone", "x,y,z,qw,qx,qy,qz\n", ["p.csv", "no rows"]),
    ("count", "1,2,3,4\n", ["p.csv:1", "4 numbers", "roll"]),
    ("planar", "x,y,theta\n1,2,3\n", ["p.csv:1", "x, y, theta", "qw"]),
]


@pytest.mark.parametrize("_, content, says", POSES, ids=[case[0] for case in POSES])
def test_a_bad_pose(refused, written, _, content, says):
    refused(3, "batch", "ik", "ur5", "--in", written("p.csv", content), "--out", "q.npy", says=says)


def test_a_pose_off_the_plane_of_a_planar_arm(refused, beeline, written):
    written("p.csv", "x,y,z,qw,qx,qy,qz\n4,3,0,1,0,0,0\n4,3,2,1,0,0,0\n")
    pose = ("batch", "ik", "rrr", "--in", "p.csv", "--out", "q.csv")
    refused(3, *pose, says=["p.csv:3", "row 2", "plane"])
    assert beeline(*pose, "--task", "planar").code == 0


def test_a_tool_out_of_the_numbers(refused, written):
    far = ("batch", "fk", "PP:0,0", "--in", written("q.csv", "0,0\n1e308,1e308\n"), "--out", "p.npy")
    refused(3, *far, says=["q.csv:2", "row 2", "range of numbers"])
    refused(3, "batch", "fk", "P", "--in", written("q.csv", "1\n1e300\n"), "--out", "p.npy",
            "--float", says=["q.csv:2", "row 2", "32 bits", "--float"])


def test_a_pipe_that_brings_more_than_its_header_says(build, tmp_path):
    np.save(tmp_path / "q.npy", np.zeros((10, 3)))
    os.mkfifo(tmp_path / "pipe.npy")
    command = [str(build / "beeline"), "batch", "fk", "rrr", "--in", "pipe.npy", "--out", "o.npy"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        (tmp_path / "pipe.npy").write_bytes((tmp_path / "q.npy").read_bytes() + b"more")
        _, err = process.communicate()
    assert process.returncode == 3 and "pipe.npy: has more than its 10 rows" in err
    assert not (tmp_path / "o.npy").exists()


def test_an_input_on_stdin_is_not_overwritten(build, written, tmp_path):
    written("q.csv", GOOD)
    command = [str(build / "beeline"), "batch", "fk", "rrr", "--in", "-", "--out", "q.csv"]
    with open(tmp_path / "q.csv") as file:
        process = subprocess.run(command, stdin=file, capture_output=True, text=True, cwd=tmp_path)
    assert process.returncode == 2 and "q.csv" in process.stderr
    assert (tmp_path / "q.csv").read_text() == GOOD


USAGE = [
    (("fkk", "rrr"), ["fkk", "fk, jacobian, ik"]),
    ((), ["needs a verb", "fk, jacobian, ik"]),
    (("fk", "rrr", "--in", "q.csv"), ["--out"]),
    (("fk", "rrr", "--in", "q.csv", "--out", ""), ["--out", "empty"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "p.json"), ["p.json", ".npy"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "q.csv"), ["q.csv", "input"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "p.csv", "--layout", "pse"), ["pse", "pose"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "p.csv", "--float"), ["32-bit", "p.csv"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "-", "--json"), ["--json", "stdout"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "p.csv", "--threads", "-1"), ["--threads"]),
    (("fk", "rrr", "--in", "q.csv", "--out", "p.csv", "--frame", "tool"), ["--frame"]),
    (("jacobian", "rrr", "--in", "q.csv", "--out", "p.csv", "--frame", "tol"), ["tol", "tool"]),
    (("jacobian", "rrr", "--in", "q.csv", "--out", "p.csv", "--task", "000000"), ["000000"]),
    (("ik", "rrr", "--in", "q.csv", "--out", "p.csv", "--seed", "1,2"), ["--seed"]),
    (("ik", "panda", "--in", "q.csv", "--out", "p.csv", "--lock", "joint9"), ["joint9", "joint7"]),
    (("ik", "panda", "--in", "q.csv", "--out", "-", "--lock", "joint1=5"), ["joint1"]),
    (("ik", "rrr", "--in", "q.csv", "--out", "p.csv", "--method", "magic"), ["magic"]),
    (("ik", "RRRRRRRR", "--in", "q.csv", "--out", "p.csv", "--method", "closed_form"),
     ["closed form"]),
    (("ik", "rrr", "--in", "q.csv", "--out", "p.csv", "--tolerance", "0"), ["tolerance"]),
]


@pytest.mark.parametrize("arguments, says", USAGE, ids=lambda value: " ".join(value)[:70])
def test_bad_usage(refused, written, tmp_path, arguments, says):
    written("q.csv", GOOD)
    refused(2, "batch", *arguments, says=says)
    assert [path.name for path in tmp_path.iterdir()] == ["q.csv"]


def test_files_that_are_not_there_or_cannot_be_written(refused, written, tmp_path):
    written("q.csv", GOOD)
    refused(3, "batch", "fk", "rrr", "--in", "none.npy", "--out", "p.csv", says=["none.npy"])
    refused(3, "batch", "fk", "rrr", "--in", "q.csv", "--out", "no/p.csv", says=["no/p.csv"])
    (tmp_path / "folder.csv").mkdir()
    refused(3, "batch", "fk", "rrr", "--in", "folder.csv", "--out", "p.csv", says=["folder"])
    refused(3, "batch", "fk", "rrr", "--in", "q.csv", "--out", "folder.csv", says=["folder"])
