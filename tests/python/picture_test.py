"""Pictures: SVG of arms and motions, in notebooks and files."""

import copy
import os
import pickle
import xml.etree.ElementTree as ElementTree

import beeline
import numpy as np
import pytest


def motion(arm):
    t = np.linspace(0, 1, 11)
    q = beeline.display_configuration(arm) + 0.3 * np.sin(t)[:, None]
    return beeline.Trajectory(arm.joint_names, t, q)


def texts(svg):
    elements = ElementTree.fromstring(svg.encode()).iter()
    return [element.text or "" for element in elements if element.tag.endswith("text")]


@pytest.mark.parametrize("name", beeline.arms.names())
def test_arms_and_motions_draw_themselves(name):
    arm = beeline.Arm.load(name)
    trajectory = motion(arm)
    assert arm._repr_svg_() == beeline.draw(arm)._repr_svg_()
    style = 'style="max-width: 100%; height: auto" '
    assert arm._repr_svg_().replace(style, "") == beeline.draw(arm).svg != arm._repr_svg_()
    assert arm.name in texts(arm._repr_svg_())
    assert beeline.draw(arm, arm.middle) == beeline.arm_figure(arm, arm.middle)
    assert beeline.draw(arm, trajectory) == beeline.motion_figure(arm, trajectory)
    assert set(arm.joint_names) <= set(texts(trajectory._repr_svg_()))
    assert set(arm.joint_names) <= set(texts(beeline.timing_figure(arm, trajectory).svg))
    animation = beeline.animate(arm, trajectory)
    assert "animate" in animation.svg and animation._repr_html_().startswith('<img src="data:image/svg+xml;base64,')
    assert animation.times[-1] == 1


def test_options_have_the_names_of_the_command():
    arm = beeline.arms.rrr()
    plain, titled = beeline.draw(arm), beeline.draw(arm, [0, 1.57, 0], title="mine", jacobian=True, frames=True)
    assert plain != titled and "mine" in texts(titled.svg)
    assert titled.width > 100 and "points" in repr(titled)
    there, twice = beeline.animate(arm, motion(arm)), beeline.animate(arm, motion(arm), speed=2)
    assert there.svg != twice.svg and "1 s" in repr(there)
    marked = beeline.draw(arm, motion(arm), waypoints=[beeline.forward_kinematics(arm, [0, 1, 0])])
    assert "1" in texts(marked.svg)


def test_a_trajectory_without_samples_has_no_picture():
    assert beeline.Trajectory(["a"], [], np.zeros((0, 1)))._repr_svg_() is None


def test_saved_files(tmp_path):
    arm = beeline.arms.rrr()
    drawing, animation = beeline.draw(arm), beeline.animate(arm, motion(arm))
    drawing.save(tmp_path / "arm.svg")
    assert (tmp_path / "arm.svg").read_text() == drawing.svg
    animation.save(os.fspath(tmp_path / "arm_moving.svg"))
    assert (tmp_path / "arm_moving.svg").read_text() == animation.svg
    try:
        drawing.save(tmp_path / "arm.png")
        assert (tmp_path / "arm.png").read_bytes().startswith(b"\x89PNG")
    except beeline.Error as error:
        assert "Cairo" in str(error)
    for wrong in ["arm.jpg", "arm"]:
        with pytest.raises(beeline.Error, match="must end in .svg, .png or .pdf"):
            drawing.save(tmp_path / wrong)
    with pytest.raises(beeline.Error, match="no_such_folder"):
        drawing.save(tmp_path / "no_such_folder" / "arm.svg")


def test_the_figures_of_the_chapter():
    assert beeline.chapter_figures()[:2] == ["1.1", "1.2"]
    assert beeline.figure("1.6") == beeline.chapter_figure("1.6") != beeline.figure("1.7")
    assert "animate" in beeline.chapter_animation("1.7", speed=4).svg
    with pytest.raises(beeline.Error, match="1.9"):
        beeline.figure("2.1")


def test_a_copy_is_the_picture_and_pickles_are_refused():
    arm = beeline.arms.panda()
    pictures = [beeline.draw(arm, frames=True), beeline.timing_figure(arm, motion(arm)), beeline.figure("1.2")]
    for picture in (*pictures, beeline.animate(arm, motion(arm))):
        assert copy.copy(picture) is copy.deepcopy(picture) is picture
        with pytest.raises(TypeError, match="pickle its svg"):
            pickle.dumps(picture)


def test_step_responses():
    arm = beeline.arms.rrr()
    goal = np.array([1.0, 0.5, -0.5])
    t = np.linspace(0, 3, 61)
    motions = {
        f"K_p = {k}": beeline.Trajectory(arm.joint_names, t, (1 - np.exp(-k * t))[:, None] * goal) for k in (1, 4)
    }
    drawn = texts(beeline.step_response_figure(motions, goal, "gains").svg)
    assert {"gains", "K_p = 1", "K_p = 4"} <= set(drawn)
    with pytest.raises(beeline.Error):
        beeline.step_response_figure(motions, [0, 0, 0])
    with pytest.raises(TypeError, match="motions"):
        beeline.step_response_figure({"a": 3}, goal)


@pytest.mark.parametrize(
    "wrong, error, message",
    [
        (lambda arm: beeline.draw(arm, "q"), TypeError, "q"),
        (lambda arm: beeline.draw(arm, [1, 2]), beeline.Error, "2 values|needs 3|3 "),
        (lambda arm: beeline.draw(arm, colour="red"), TypeError, "known: title, caption"),
        (lambda arm: beeline.draw(arm, ghosts=-3, frames="yes"), TypeError, "frames"),
        (lambda arm: beeline.draw(arm, waypoints=[np.eye(4)]), TypeError, "motion"),
        (lambda arm: beeline.draw(arm, motion(beeline.arms.ur5())), beeline.Error, "joint"),
        (lambda arm: beeline.draw(arm, motion(arm), ghosts=-1), beeline.Error, "outside 0 to 1000"),
        (lambda arm: beeline.draw(arm, motion(arm), ghosts=2**31 - 1), beeline.Error, "outside 0 to 1000"),
        (lambda arm: beeline.animate(arm, motion(arm), dots=2**40), beeline.Error, "above 100000"),
        (lambda arm: beeline.animate(arm, motion(arm), speed=0), beeline.Error, "speed"),
        (lambda arm: beeline.animate(arm, [0, 0, 0]), TypeError, "Trajectory|incompatible"),
        (lambda arm: beeline.draw(arm, [np.nan] * 3), beeline.Error, "finite|NaN|nan"),
    ],
)
def test_refusals(wrong, error, message):
    with pytest.raises(error, match=message):
        wrong(beeline.arms.rrr()).svg


def test_animations_compare():
    arm = beeline.arms.rrr()
    moving = beeline.animate(arm, motion(arm), waypoints=[np.eye(4)], speed=2, title="a title")
    assert beeline.chapter_animation("1.7", speed=2) == beeline.chapter_animation("1.7", speed=2)
    assert moving != beeline.animate(arm, motion(arm), waypoints=[np.eye(4)], speed=2)
    assert beeline.chapter_animation("1.7") != beeline.chapter_animation("1.7", frames_per_second=10)


@pytest.mark.parametrize("option", ["speed", "rest_before", "rest_after", "frames_per_second"])
def test_how_an_animation_is_played_is_checked_at_once(option):
    for value in (-1, float("nan")):
        with pytest.raises(beeline.Error, match=option):
            beeline.chapter_animation("1.7", **{option: value})
        with pytest.raises(beeline.Error, match=option):
            beeline.animate(beeline.arms.rrr(), motion(beeline.arms.rrr()), **{option: value})
