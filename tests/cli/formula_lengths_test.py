"""formula: arms with lengths of any magnitude."""

import pytest


@pytest.mark.parametrize("command", ["RRR:1e6,1,1 --of all", "RRR:1,1,1e6 --of all", "RRR:1e-4,1e4,1 --of all",
                                     "RRR:1e-9,1,1e6 --of inverse", "RRR:1e-13,1e-13,1e-13 --of all",
                                     "ur5 --mount 1e6,0,0 --of determinant,jacobian",
                                     "ur5 --tcp 0,0,1e6 --of determinant"])
def test_lengths_of_any_magnitude(beeline, command):
    done = beeline("formula", *command.split())
    assert done.code == 0, done.err


def test_small_lengths_are_named_or_said(beeline):
    """What is zero is relative to the arm."""
    small = beeline("formula", "RRR:1e-13,1e-13,1e-13", "--json").json
    assert [symbol["value"] for symbol in small["symbols"]] == [1e-13] * 3
    assert small["notes"] == []
    mixed = beeline("formula", "RRR:1e-13,1e-13,1", "--json").json
    assert [symbol["value"] for symbol in mixed["symbols"]] == [1]
    assert mixed["notes"] == ["Lengths up to 1e-13 m are taken as zero."]
    for arm in ("ur5", "panda", "puma560", "stanford"):
        assert beeline("formula", arm, "--json").json["notes"] == []
