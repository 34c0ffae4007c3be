"""Every option of C++ is one of Python: a member of a struct of options is a keyword or is listed here with the reason."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

import beeline

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests")]

import header_texts  # noqa: E402
import layers  # noqa: E402

# Structs that users fill in, beside those whose name ends in Options.
STRUCTS = {"Budget", "ChainEnds", "LimitOverrides", "MovingEnds", "PidGains", "PoseFormat", "ReachShard",
           "SplineEnds"}

# Members that are keywords of a function, but not by Fields<Struct> of python/src.
KEYWORDS = {
    "BatchOptions::layout": ("batch_inverse", "layout"),
    "BatchOptions::frame": ("jacobian", "frame"),
    "Budget::time_limit": ("move_in_lines", "time_limit"),
    "Budget::max_work": ("move_in_lines", "max_work"),
    "Budget::progress": ("move_in_lines", "progress"),
    "BatchOptions::budget": ("batch_inverse", "time_limit"),
    "ChainEnds::base": ("read_arm_shapes", "base"),
    "ChainEnds::tip": ("read_arm_shapes", "tip"),
    "MatchOptions::angle_unit": ("Trajectory.load", "angle_unit"),
    "MatchOptions::joint_map": ("Trajectory.load", "joint_map"),
    "RecordingOptions::detect_degrees": ("read_recording", "detect_degrees"),
    "RecordingOptions::match": ("read_recording", "joint_map"),
    "RecordingOptions::needs_times": ("read_recording", "needs_times"),
    "RecordingOptions::time_unit": ("Trajectory.load", "time_unit"),
    "ReachMapOptions::shard": ("compute_reach_map", "shard"),
    "ShapeOptions::frames": ("read_scene", "frames"),
    "ShapeOptions::hold": ("read_arm_shapes", "hold"),
    "ShapeOptions::moving_frames": ("read_scene", "moving_frames"),
    "ShapeOptions::package": ("read_arm_shapes", "package"),
    "ShapeOptions::radius": ("read_scene", "radius"),
    "ShapeOptions::srdf": ("read_arm_shapes", "srdf"),
    "SplineEnds::first": ("path_through", "first"),
    "SplineEnds::last": ("path_through", "last"),
    "TimingFigureOptions::clearance": ("timing_figure", "clearance"),
    "TimingFigureOptions::task": ("timing_figure", "task"),
    "TimingFigureOptions::waypoint_times": ("timing_figure", "waypoint_times"),
}

# Members that Python does not have.
NOT_IN_PYTHON = {
    "Budget::cancelled": "Ctrl-C and signal handlers cancel",
    "CartesianOptions::simulation": "its members are keywords",
    "Budget::whole": "set by the library alone",
    "MatchOptions::column_units": "set by the reader, from the names of columns",
    "ReachMapOptions::reach": "its members are keywords",
    "ReachOptions::scene": "of the model of blocked_by",
    "RecordingOptions::angle_unit_is_known": "angle_unit=\"radians\" states it",
    "RecordingOptions::map_is_optional": "for two files with one map; load each with its own",
    "RecordingOptions::time_unit_is_optional": "for two files with one unit; load each with its own",
    "TimingFigureOptions::path": "a PathMotion has it",
}


def option_members():
    headers = [path for path in (ROOT / "beeline").rglob("*.h") if layers.is_public(path.relative_to(ROOT / "beeline"))]
    entries = [entry for path in sorted(headers) for entry in header_texts.entries(path)]
    members = {entry.name for entry in entries if entry.scope == "struct" and entry.type and "::" in entry.name}
    found = {member for member in members if re.search(r"Options::", member) or member.split("::")[0] in STRUCTS}
    assert {member.split("::")[0] for member in found} >= {"VerifyOptions", "InverseOptions", "SimulationOptions"}
    return found


def bound():
    sources = "".join(path.read_text() for path in (ROOT / "python" / "src").iterdir())
    return set(re.findall(r"&(\w+::\w+)", sources))


def keywords(function):
    """The parameters in a function's docstring."""
    value = beeline
    for name in function.split("."):
        value = getattr(value, name)
    return set(re.findall(r"^ *(\w+) : ", value.__doc__, re.MULTILINE))


def test_every_option_is_a_keyword_or_has_a_reason_why_not():
    members = option_members()
    assert len(members) > 120
    missing = members - bound() - set(KEYWORDS) - set(NOT_IN_PYTHON)
    assert missing == set(), "bind it in python/src, or give the reason in NOT_IN_PYTHON"
    # Nothing is listed that is bound or is not there.
    assert (set(KEYWORDS) | set(NOT_IN_PYTHON)) - members == set()
    assert set(NOT_IN_PYTHON) & (bound() | set(KEYWORDS)) == set()


@pytest.mark.parametrize("member", KEYWORDS)
def test_the_keyword_of_an_option_exists(member):
    function, keyword = KEYWORDS[member]
    assert keyword in keywords(function), keywords(function)


def test_a_motion_from_outside_the_limits_leads_back():
    arm = beeline.arms.panda()
    outside = arm.middle.copy()
    outside[1] = arm.upper[1] + 0.05
    with pytest.raises(beeline.Error, match="limits"):
        beeline.point_to_point(arm, outside, arm.middle)
    motion = beeline.point_to_point(arm, outside, arm.middle, from_outside=True)
    positions = np.array(beeline.sampled(arm, motion, 100).positions)
    assert positions[0][1] == outside[1] and positions[-1].tolist() == arm.middle.tolist()
