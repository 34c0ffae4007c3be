"""The built-in arms are compiled in from beeline/model/arms/*.json by CMake; the reader of arms reads the same files."""

import json
import subprocess


def written(build, arm, path):
    """The arm as JSON by its joints."""
    subprocess.run([build / "beeline", "show", arm, "--out", path], check=True, capture_output=True)
    return json.loads(path.read_text())


def test_each_built_in_arm_is_what_the_reader_makes_of_its_file(build, root, tmp_path):
    files = sorted((root / "beeline" / "model" / "arms").glob("*.json"))
    answer = subprocess.check_output([build / "beeline", "arms", "--json"])
    assert [arm["name"] for arm in json.loads(answer)["arms"]] == [file.stem for file in files]
    for file in files:
        compiled_in = written(build, file.stem, tmp_path / "a.json")
        assert compiled_in == written(build, file, tmp_path / "b.json"), file.stem
