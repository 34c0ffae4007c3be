"""reach: maps of what an arm can do, computed in parts, joined and queried."""

import json
import math
import os
import resource
import signal
import subprocess
import time

import numpy
import pytest

MAP = ["reach", "map", "puma560", "--resolution", "0.1", "--directions", "45", "--degrees"]


@pytest.fixture
def puma(beeline, tmp_path):
    path = tmp_path / "puma.h5"
    assert beeline(*MAP, "--out", path).code == 0
    return path


def test_a_map_says_what_it_is_of(beeline, puma):
    totals = beeline("reach", "query", puma, "--json").json
    assert totals["status"] == "complete" and totals["arm"] == "puma560"
    assert totals["resolution"] == 0.1 and totals["cells"] == totals["cells_here"]
    assert totals["cells"] == totals["positions"] * totals["directions"]
    reach = json.loads(beeline("show", "puma560", "--json").out)["reach"]["radius"]
    assert 0.5 < totals["volume"] / (4 / 3 * math.pi * reach**3) < 1


def test_a_map_without_hdf5(beeline, written, tmp_path):
    """The loader finds a file of that name that is no library."""
    names = ["libhdf5_serial.so.103", "libhdf5_serial.so.310"]  # of Debian 12 and 13
    for name in names:
        written(name, "no library\n")
    refused = beeline(*MAP, "--out", "map.h5", env=os.environ | {"LD_LIBRARY_PATH": str(tmp_path)})
    if refused.code == 0:
        pytest.skip("this build loads HDF5 by another name")
    assert refused.code == 2 and "install HDF5" in refused.err and len(refused.err.splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == names


def test_the_answer_for_a_centre_equals_ik(beeline, puma, tmp_path):
    # One orientation, so that a cell is a pose.
    path = tmp_path / "down.h5"
    options = ["--resolution", "0.1", "--orientation", "180,0,0", "--degrees"]
    assert beeline("reach", "map", "puma560", *options, "--out", path).code == 0
    reached = 0
    for x in (0.31, 0.55, 0.9):
        answer = beeline("reach", "query", path, "--pose", f"{x},0.1,0.2,180,0,0", "--degrees", "--json")
        centre = ",".join(map(repr, answer.json["centre"]["translation"])) + ",180,0,0"
        ik = beeline("ik", "puma560", "--pose", centre, "--degrees", "--all", "--json")
        assert answer.code == ik.code
        assert answer.json["branches"] == len(ik.json.get("solutions", []))
        reached += answer.code == 0
    assert 0 < reached < 3


def test_a_pose_a_position_and_a_point_outside(beeline, puma):
    pose = beeline("reach", "query", puma, "--pose", "0.5,0.1,0.3,180,0,0", "--degrees")
    assert pose.code == 0 and "the pose itself reached" in pose.out
    position = beeline("reach", "query", puma, "--pose", "0.5,0.1,0.3", "--json")
    assert position.code == 0 and 0.5 < position.json["directions"] <= 1
    inside = beeline("reach", "query", puma, "--pose", "0,0,0,0,0,0", "--json")
    assert inside.code == 1 and inside.json["status"] == "not_reached"
    outside = beeline("reach", "query", puma, "--pose", "9,0,0", "--json")
    assert outside.code == 1 and outside.json["status"] == "outside_map"


def test_parts_make_the_map(beeline, puma, tmp_path):
    parts = [tmp_path / f"part{k}.h5" for k in (1, 2)]
    for k, part in enumerate(parts, 1):
        answer = beeline(*MAP, "--shard", f"{k}/2", "--threads", k, "--out", part, "--json")
        assert answer.code == 0 and answer.json["status"] == "incomplete"
    missing = beeline("reach", "merge", parts[1], "--out", tmp_path / "joined.h5")
    assert missing.code == 2 and "option incomplete" in missing.err and "lack" in missing.err
    joined = beeline("reach", "merge", *parts, "--out", tmp_path / "joined.h5", "--json")
    assert joined.code == 0 and joined.json["status"] == "complete"
    whole = beeline("reach", "query", puma, "--json").json
    assert joined.json["cells_reached"] == whole["cells_reached"]


def test_parts_are_of_one_map_wherever_the_controllers_root_frame_is(beeline, tmp_path):
    part = lambda k, arm: beeline("reach", "map", arm, "--resolution", "0.6", "--shard", f"{k}/2", "--out",
                                  tmp_path / f"{arm}{k}.h5").code
    assert beeline("show", "irb120", "--out", "a.json").code == 0
    arm = json.loads((tmp_path / "a.json").read_text())
    (tmp_path / "b.json").write_text(json.dumps(arm | {"controller_base": {"xyz": [0, 0, 1]}}))
    (tmp_path / "c.json").write_text(json.dumps(arm | {"base": {"xyz": [0, 0, 0.1]}}))
    assert [part(1, "a.json"), part(2, "b.json"), part(2, "c.json")] == [0, 0, 0]
    assert beeline("reach", "merge", "a.json1.h5", "b.json2.h5", "--out", "m.h5").code == 0
    refused = beeline("reach", "merge", "a.json1.h5", "c.json2.h5", "--out", "n.h5")
    assert refused.code == 3 and "as it is described now" in refused.err


def test_more_parts_than_slabs_make_the_map(beeline, puma, tmp_path):
    slabs = beeline("reach", "query", puma, "--json").json["slabs"]
    count = slabs + 2
    parts = [tmp_path / f"part{k}.h5" for k in range(1, count + 1)]
    for k, part in enumerate(parts, 1):
        answer = beeline(*MAP, "--shard", f"{k}/{count}", "--out", part, "--json")
        assert answer.code == 0 and answer.json["slabs_here"] == (k <= slabs)
    joined = beeline("reach", "merge", *parts, "--out", tmp_path / "joined.h5", "--json")
    assert joined.code == 0 and joined.json["status"] == "complete"


def test_what_else_is_in_the_folder_of_parts_stays(beeline, puma, tmp_path):
    parts = tmp_path / "map.h5.parts"
    parts.mkdir()
    mine = {"notes.txt", "slab-notes.h5", "map.h5.bak"}
    for name in mine:
        (parts / name).write_text("mine")
    assert beeline(*MAP, "--out", tmp_path / "map.h5").code == 0
    assert {file.name for file in parts.iterdir()} == mine
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "other.h5.parts").symlink_to(elsewhere)
    assert beeline(*MAP, "--out", tmp_path / "other.h5").code == 0
    assert not list(elsewhere.iterdir()) and (tmp_path / "other.h5").read_bytes() == puma.read_bytes()


def test_an_ended_map_says_how_it_continues(beeline, tmp_path):
    answer = beeline(*MAP, "--max-work", "10", "--out", tmp_path / "map.h5")
    assert answer.code == 1 and "with a larger limit" in answer.err


@pytest.fixture(scope="module")
def uninterrupted(build, tmp_path_factory):
    path = tmp_path_factory.mktemp("uninterrupted") / "map.h5"
    subprocess.run([build / "beeline", "reach", "map", "ur5", "--resolution", "0.08", "--out", path],
                   check=True, capture_output=True)
    return path.read_bytes()


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL])
def test_an_interrupted_map_is_continued(beeline, build, uninterrupted, tmp_path, end):
    path = tmp_path / "map.h5"
    command = [build / "beeline", "reach", "map", "ur5", "--resolution", "0.08", "--out", path]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        parts = tmp_path / "map.h5.parts"
        while process.poll() is None and len(list(parts.glob("slab-*.h5"))) < 2:
            time.sleep(0.01)
        process.send_signal(end)
        process.wait()
    if end == signal.SIGINT:
        assert process.returncode == 1
    assert not path.exists() and len(list(parts.glob("slab-*.h5"))) >= 2
    assert beeline(*map(str, command[1:])).code == 0
    assert path.read_bytes() == uninterrupted
    assert not parts.exists()


@pytest.mark.parametrize("arguments, code, message", [
    (["map", "puma560", "--out", "/dev/full"], 3, "needs a file, not a pipe or device"),
    (["map", "puma560", "--out", "/none/map.h5"], 3, "No such file or directory"),
    (["map", "puma560", "--out", "OUT", "--resolution", "1e-9"], 2, "cells along an axis"),
    (["map", "puma560", "--out", "OUT", "--lower", "1,2"], 2, "--lower: 2 numbers given"),
    (["map", "puma560", "--out", "OUT", "--lower", "1,0,0", "--upper", "0,1,1"], 2, "its lower x is 1"),
    (["map", "puma560", "--out", "OUT", "--directions", "30"], 2, "--directions"),
    (["map", "puma560", "--out", "OUT", "--shard", "3/2"], 2, "--shard"),
    (["map", "puma560", "--out", "OUT", "--shard", "half"], 2, "such as 1/4"),
    (["map", "rrr", "--out", "OUT", "--rolls", "1"], 2, "no rolls"),
    (["map", "px150", "--out", "OUT"], 2, "5 joints"),
    (["map", "panda", "--out", "OUT", "--azimuths", "0.5"], 2, "without azimuths"),
    (["map", "gantry", "--out", "OUT", "--azimuths", "0.5"], 2, "does not turn it about"),
    (["map", "puma560", "--out", "OUT", "--azimuths", "0.5", "--lower", "1,2,3"], 2, "two with --azimuths"),
    (["map", "puma560", "--out", "OUT", "--any-orientation"], 2, "--by sampling"),
    (["map", "puma560", "--out", "OUT", "--samples", "100"], 2, "--by sampling"),
    (["map", "puma560", "--out", "OUT", "--by", "luck"], 2, "sampling"),
    (["compare", "MAP", "MAP", "--at", "y=0"], 2, "needs both"),
    (["slice", "MAP", "--at", "z", "--out", "x.svg"], 2, "is no plane"),
    (["slice", "MAP", "--at", "z=0.2", "--out", "x.txt"], 2, ".pdf or .csv"),
    (["map", "puma560", "--out", "OUT", "--orientation", "0,0"], 2, "--orientation: 2 numbers given"),
    (["map", "puma560", "--out", "OUT", "--orientation", "nan,0,0"], 2, "item 1"),
    (["map", "puma560", "--out", "OUT", "--resolution", "0.3", "--lower", "1e12,0,0", "--upper", "1e12,1,1"], 2, "told apart"),
    (["map", "puma560", "--out", "OUT", "--directions", "0.01", "--rolls", "0.01"], 2, "orientations, at most"),
    (["compare", "MAP", "/none"], 3, "No such file"),
    (["query", "/etc/passwd"], 3, "not a reach map"),
    (["query", "MAP", "--pose", "1,2"], 2, "planar"),
    (["merge", "MAP", "--out", "MAP"], 2, "is an input as well"),
    (["merge", "--out", "OUT"], 2, "PART is missing"),
])
def test_a_mistake_gets_one_line(beeline, puma, tmp_path, arguments, code, message):
    names = {"OUT": tmp_path / "out.h5", "MAP": puma}
    answer = beeline("reach", *[names.get(word, word) for word in arguments])
    assert answer.code == code and message in answer.err and answer.err.count("\n") == 1
    assert answer.out == "" and not (tmp_path / "out.h5").exists()


POSES = "x,y,z,roll,pitch,yaw\n0.8,-0.3,0.2,180,0,0\n0.8,0.3,0.2,180,0,0\n1,0,0.4,180,0,0\n"


def test_a_map_that_is_ended_has_a_reason(beeline, tmp_path):
    answer = beeline("reach", "map", "rrr", "--out", tmp_path / "out.h5", "--time-limit", "0", "--json")
    assert answer.code == 1 and answer.json["status"] == "time_limit" and answer.json["code"] == "ended_in_map"
    assert answer.json["fields"] == {"ending": "time_limit", "parts": answer.json["parts"]}
    assert answer.err == f"beeline: {answer.json['reason']}\n"


def test_a_placement_reaches_every_pose_in_lines(beeline, puma, written):
    poses = written("poses.csv", POSES)
    found = beeline("reach", "place", puma, "--poses", poses, "--degrees", "--lines", "--count", 3, "--json")
    assert found.code == 0 and found.json["checked"] == found.json["mounts"]
    assert (found.json["reason"], found.json["code"], found.json["fields"]) == ("", None, {})
    margins = [placement["margin"] for placement in found.json["placements"]]
    assert len(margins) == 3 and margins == sorted(margins, reverse=True)
    mount = found.json["placements"][0]["mount"]
    for row, q in zip(POSES.splitlines()[1:], found.json["placements"][0]["solutions"], strict=True):
        fk = beeline("fk", "puma560", "--mount", mount, "--degrees", "--json", "--q", ",".join(map(repr, q)))
        assert fk.json["pose"]["translation"] == pytest.approx([float(x) for x in row.split(",")[:3]], abs=1e-6)
    line = beeline("line", "puma560", "--mount", mount, "--degrees", "--through", poses)
    assert line.code == 0


def test_no_placement_has_a_reason(beeline, puma, written):
    apart = written("poses.csv", "x,y,z,roll,pitch,yaw\n0,0,0.2,0,0,0\n9,0,0.2,0,0,0\n")
    answer = beeline("reach", "place", puma, "--poses", apart)
    assert answer.code == 1 and "farther apart" in answer.err
    high = written("high.csv", "x,y,z,roll,pitch,yaw\n0,0,5,0,0,0\n")
    answer = beeline("reach", "place", puma, "--poses", high, "--json")
    assert answer.code == 1 and answer.json["placements"] == [] and "none of the" in answer.err
    assert answer.json["code"] == "no_mount_reaches" and answer.err == f"beeline: {answer.json['reason']}\n"
    assert set(answer.json["fields"]) == {"count", "of"}


def test_a_slice_is_drawn_and_written(beeline, puma, tmp_path):
    answer = beeline("reach", "slice", puma, "--at", "z=0.2", "--out", tmp_path / "slice.csv", "--json")
    rows = (tmp_path / "slice.csv").read_text().splitlines()
    assert rows[0] == "x,y,z,directions" and len(rows) == 1 + answer.json["positions"]
    assert sum(not row.endswith("nan") for row in rows[1:]) == answer.json["reached"] > 0
    for measure in ("branches", "manipulability", "margin"):
        picture = tmp_path / f"{measure}.svg"
        assert beeline("reach", "slice", puma, "--at", "y=0", "--measure", measure, "--out", picture).code == 0
        assert measure.replace("branches", "solutions") in picture.read_text()


def test_an_image_has_the_cells_of_the_map(beeline, puma, tmp_path):
    assert beeline("reach", "export", puma, "--out", tmp_path / "map.vti").code == 0
    data = (tmp_path / "map.vti").read_bytes()
    head, _, values = data.partition(b'<AppendedData encoding="raw">\n_')
    nx, ny, nz = (int(word) for word in head.split(b'Extent="')[1].split(b'"')[0].split()[1::2])
    positions = beeline("reach", "query", puma, "--json").json["positions"]
    assert nx * ny * nz == positions and len(values) > 4 * (8 + 4 * positions)
    # The first array, whose first axis is z, beside the rows of a slice.
    image = numpy.frombuffer(values, "<f4", positions, 8).reshape(nz, ny, nx)
    answer = beeline("reach", "slice", puma, "--at", "y=0.21", "--out", tmp_path / "slice.csv", "--json")
    rows = numpy.genfromtxt(tmp_path / "slice.csv", delimiter=",", names=True)
    j = round((answer.json["at"] - rows["x"].min()) / 0.1)  # the box is as wide along y
    assert numpy.allclose(image[:, j, :].T.ravel(), numpy.nan_to_num(rows["directions"]), atol=1e-6)
    assert beeline("reach", "export", puma, "--out", tmp_path / "map.obj").code == 2


CYLINDER = ["reach", "map", "puma560", "--resolution", "0.2", "--azimuths", "30", "--directions", "60", "--degrees"]


@pytest.mark.parametrize("rolls", [[], ["--rolls", "45"]])
def test_a_map_by_azimuths_is_smaller_and_answers_alike(beeline, tmp_path, rolls):
    path = tmp_path / "turned.h5"
    assert beeline(*CYLINDER, *rolls, "--out", path, "--json").code == 0
    sliced = beeline("reach", "slice", path, "--at", "z=0.2", "--out", tmp_path / "slice.csv", "--json")
    rows = numpy.genfromtxt(tmp_path / "slice.csv", delimiter=",", names=True)
    reached = ~numpy.isnan(rows["directions"])
    # The limits of the first joint leave out some azimuths.
    assert 0 < reached.sum() == sliced.json["reached"] < reached.size
    for k in (*numpy.flatnonzero(reached)[::9], *numpy.flatnonzero(~reached)[::9]):
        pose = ",".join(repr(float(rows[axis][k])) for axis in "xyz")
        answer = beeline("reach", "query", path, f"--pose={pose}", "--json")
        assert answer.json["directions"] == pytest.approx(rows["directions"][k]) if reached[k] else answer.code == 1
    assert beeline("reach", "slice", path, "--at", "z=0.2", "--out", tmp_path / "slice.svg").code == 0


def test_a_map_by_sampling_says_so(beeline, tmp_path):
    path = tmp_path / "px150.h5"
    options = ["--resolution", "0.1", "--by", "sampling", "--any-orientation", "--samples", "200000"]
    made = beeline("reach", "map", "px150", *options, "--out", path, "--json")
    assert made.code == 0 and made.json["by"] == "sampling" and made.json["samples"] == 200000
    assert 0 < made.json["positions_reached"] < made.json["positions"]
    assert "by sampling" in beeline("reach", "query", path).out
    tool = beeline("fk", "px150", "--q", "0.1,0.2,-0.3,0.4,0.5", "--json").json["pose"]["translation"]
    answer = beeline("reach", "query", path, f"--pose={','.join(map(repr, tool))}", "--json")
    assert answer.code == 0 and answer.json["samples"] > 0 and "branches" not in answer.json


def test_two_mounts_are_compared(beeline, puma, tmp_path):
    raised = tmp_path / "raised.h5"
    assert beeline(*MAP, "--mount", "0,0,0.5,0,0,0", "--out", raised).code == 0
    answer = beeline("reach", "compare", puma, raised, "--at", "y=0", "--out", tmp_path / "two.svg", "--json")
    assert answer.code == 0
    first, second = answer.json["maps"]
    assert first["volume"] == pytest.approx(second["volume"]) and 0 < first["alone"] < first["volume"]
    assert first["alone"] + answer.json["both"] == pytest.approx(first["volume"])
    assert "puma.h5" in (tmp_path / "two.svg").read_text() and "raised.h5" in (tmp_path / "two.svg").read_text()


def test_a_full_disk_loses_only_what_was_in_work(build, beeline, puma, tmp_path):
    """Files that may not grow beyond a size, as on a full disk: what was written stays, and the map is continued."""
    path = tmp_path / "map.h5"
    command = [build / "beeline", "reach", "map", "ur5", "--resolution", "0.08", "--out", path]

    def limited():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (120_000, resource.RLIM_INFINITY))

    full = subprocess.run(command, preexec_fn=limited, capture_output=True, text=True)
    assert full.returncode == 3 and full.stderr.count("\n") == 1 and "cannot be written" in full.stderr
    assert not path.exists() and not list(tmp_path.glob("**/*.part"))
    assert beeline(*map(str, command[1:])).code == 0
    assert beeline("reach", "query", path, "--json").json["status"] == "complete"


def test_a_cut_shard_is_refused_and_computed_again(beeline, puma, tmp_path):
    parts = [tmp_path / f"part{k}.h5" for k in (1, 2)]
    for k, part in enumerate(parts, 1):
        assert beeline(*MAP, "--shard", f"{k}/2", "--out", part).code == 0
    os.truncate(parts[1], parts[1].stat().st_size * 2 // 3)
    merged = beeline("reach", "merge", *parts, "--out", tmp_path / "joined.h5")
    assert merged.code == 3 and "part2.h5" in merged.err and not (tmp_path / "joined.h5").exists()
    assert beeline(*MAP, "--shard", "2/2", "--out", parts[1]).code == 0
    assert beeline("reach", "merge", *parts, "--out", tmp_path / "joined.h5").code == 0


def test_two_processes_may_compute_the_same_map(build, beeline, tmp_path):
    command = [build / "beeline", "reach", "map", "ur5", "--resolution", "0.15", "--rolls", "1", "--out", tmp_path / "k.h5"]
    both = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) for _ in range(2)]
    assert [process.communicate()[1] for process in both] == [b"", b""]
    assert [process.returncode for process in both] == [0, 0]
    assert beeline("reach", "query", tmp_path / "k.h5", "--json").json["status"] == "complete"


def test_planar_maps_of_two_resolutions_have_the_same_area(beeline, tmp_path):
    for name, resolution in (("a.h5", "1"), ("b.h5", "0.4")):
        assert beeline("reach", "map", "rrr", "--resolution", resolution, "--out", tmp_path / name).code == 0
    first, second = beeline("reach", "compare", tmp_path / "a.h5", tmp_path / "b.h5", "--json").json["maps"]
    assert first["volume"] == pytest.approx(second["volume"], rel=0.05)
    assert first["directions"] == pytest.approx(second["directions"], rel=0.1)


def test_links_are_followed_and_pipes_refused(beeline, puma, tmp_path):
    (tmp_path / "link.h5").symlink_to("real.h5")
    assert beeline("reach", "merge", puma, "--out", tmp_path / "link.h5").code == 0
    assert (tmp_path / "link.h5").is_symlink() and (tmp_path / "real.h5").read_bytes()
    os.mkfifo(tmp_path / "pipe")
    answer = beeline("reach", "query", tmp_path / "pipe")
    assert answer.code == 3 and "it is a pipe" in answer.err


def test_a_placement_that_ended_early_reports_what_it_found(beeline, puma, written):
    pose = written("pose.csv", "x,y,z,roll,pitch,yaw\n0.8,-0.3,0.2,180,0,0\n")
    answer = beeline("reach", "place", puma, "--poses", pose, "--degrees", "--max-work", "100", "--json")
    assert answer.code == 1 and answer.json["status"] == "work_limit" and answer.json["placements"]
    empty = beeline("reach", "place", puma, "--poses", pose, "--degrees", "--lower", "1,1,1", "--upper", "0,0,0")
    assert empty.code == 2 and "box of the mounts is empty" in empty.err
