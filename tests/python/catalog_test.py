"""What a built-in arm says about itself is what its file says; tests/io/text/catalog_test.py compares the numbers."""

import json

import beeline


def test_built_in_arms_say_what_their_files_say(root):
    arms = beeline.built_in_arms()
    assert [arm.name for arm in arms] == sorted(file.stem for file in (root / "beeline/model/arms").glob("*.json"))
    for arm in arms:
        file = json.loads((root / f"beeline/model/arms/{arm.name}.json").read_text())
        for member in ("name", "maker", "model", "source", "note", "shapes_source"):
            assert getattr(arm, member) == file.get(member, ""), (arm.name, member)
        assert [list(names) for names in arm.joint_names] == file.get("joint_names", []), arm.name
