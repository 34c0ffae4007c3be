"""Arms by their names: every function that takes an arm takes the name of a built-in one."""

import ast
import re

import numpy as np
import pytest

import beeline

PANDA = beeline.arms.panda()
Q, GOAL = PANDA.random(2, seed=3)
POSE = beeline.forward_kinematics(PANDA, Q)
MOTION = beeline.move_joints(PANDA, Q, GOAL).trajectory


@pytest.mark.parametrize("call", [
    lambda arm: beeline.forward_kinematics(arm, Q).tolist(),
    lambda arm: beeline.hessian(arm, Q).tolist(),
    lambda arm: beeline.inverse_kinematics(arm, POSE, seed=Q),
    lambda arm: beeline.inverse_kinematics(arm, [POSE, POSE]),
    lambda arm: beeline.batch_inverse(arm, [POSE]),
    lambda arm: beeline.joint_rates(arm, Q, [0.1, 0, 0, 0, 0, 0]),
    lambda arm: beeline.random_configuration(arm, 3, seed=1).tolist(),
    lambda arm: beeline.move_joints(arm, Q, GOAL),
    lambda arm: beeline.point_to_point(arm, Q, GOAL),
    lambda arm: beeline.retime(arm, MOTION),
    lambda arm: beeline.limit_usage(arm, MOTION),
    lambda arm: MOTION.matched_to(arm),
    lambda arm: beeline.compare_arms(arm, arm),
    lambda arm: beeline.symbolic_arm(arm),
    lambda arm: str(beeline.formula_document(arm)),
    lambda arm: beeline.arm_figure(arm, Q).svg,
    lambda arm: beeline.draw(arm, MOTION).svg,
    lambda arm: repr(beeline.Servo(arm, gain=5)),
])  # fmt: skip
def test_a_name_is_the_arm(call):
    assert call("panda") == call(PANDA)
    assert call("panda") == call(PANDA)  # of the arm that is kept


def test_the_arm_of_a_name_is_in_its_results():
    assert beeline.CollisionModel("panda", [], beeline.Scene([])).arm == PANDA
    assert beeline.symbolic_arm("panda").arm == PANDA


@pytest.mark.parametrize("name, near", [("pnda", "panda"), ("UR5", "ur5"), ("puma", "puma560")])
def test_an_unknown_name_suggests_the_nearest(name, near):
    for call in (beeline.inverse_method, beeline.default_task, beeline.symbolic_arm,
                 beeline.arm_figure, beeline.Servo, lambda arm: beeline.point_to_point(arm, Q, GOAL)):  # fmt: skip
        with pytest.raises(beeline.Error, match=f'^unknown built-in arm "{name}"; did you mean "{near}"[?]') as error:
            call(name)
        assert "\n" not in str(error.value)


def test_every_annotation_of_an_arm_has_names(build):
    stub = ast.parse((build / "python" / "beeline" / "_core.pyi").read_text())
    functions = [node for node in ast.walk(stub) if isinstance(node, ast.FunctionDef)]
    annotations = [ast.unparse(argument.annotation) for function in functions
                   for argument in function.args.args + function.args.kwonlyargs if argument.annotation]  # fmt: skip
    arms = [text for text in annotations if re.search(r"\bArm\b", text)]
    assert len(arms) > 60 and [text for text in arms if not re.search(r"\bstr\b", text)] == []


def test_pictures_in_matplotlib_take_names():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    assert beeline.plot.arm("panda").get_title() == beeline.plot.arm(PANDA).get_title()
    assert len(beeline.plot.joints("panda", MOTION)) == 3
    assert beeline.plot.trail("panda", MOTION) is not None
    pyplot.close("all")
