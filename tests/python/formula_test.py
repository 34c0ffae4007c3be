"""Formulas: equal to the kinematics at random configurations, as numbers, functions, code and pickles."""

import copy
import pickle

import beeline
import numpy as np
import pytest

ARMS = ["rrr", "rp", "gantry", "scara", "stanford", "puma560", "ur5", "panda", "iiwa14"]


@pytest.fixture(params=ARMS)
def arm(request):
    return beeline.Arm.load(request.param)


def test_formulas_are_the_kinematics(arm, rng):
    named = beeline.symbolic_arm(arm)
    tool, jacobian = beeline.tool_formula(named), beeline.jacobian_formula(named)
    assert tool.shape == (4, 4) and jacobian.shape == (6, arm.dof)
    q = rng.uniform(-3, 3, (7, arm.dof))
    for formula, expected in [(tool, beeline.forward_kinematics(arm, q)), (jacobian, beeline.jacobian(arm, q))]:
        function = formula.lambdify()
        assert np.abs(formula.value(q) - expected).max() < 1e-12
        assert np.abs(function(q) - expected).max() < 1e-12
        assert np.abs(function(q[0]) - expected[0]).max() < 1e-12
        assert np.array_equal(pickle.loads(pickle.dumps(function))(q), function(q))


@pytest.mark.parametrize("frame", ["base", "tool", "space"])
def test_jacobians_in_each_frame(frame, rng):
    arm = beeline.arms.puma560()
    q = rng.uniform(-3, 3, 6)
    assert np.allclose(beeline.jacobian_formula(arm, frame).value(q), beeline.jacobian(arm, q, frame), atol=1e-12)


def test_links_multiply_to_the_tool(arm, rng):
    q = rng.uniform(-3, 3, arm.dof)
    product = beeline.base_formula(arm).value(q)
    for i in range(1, len(arm.joints) + 1):
        product = product @ beeline.link_formula(arm, i, i - 1).value(q)
    assert np.allclose(product @ beeline.tool_offset_formula(arm).value(q), beeline.forward_kinematics(arm, q))


def test_the_time_derivative_has_joint_velocities(rng):
    arm = beeline.arms.ur5()
    rate = beeline.time_derivative(beeline.jacobian_formula(arm))
    q, dq = rng.uniform(-3, 3, (2, 4, 6))
    difference = (beeline.jacobian(arm, q + 1e-6 * dq) - beeline.jacobian(arm, q - 1e-6 * dq)) / 2e-6
    function = rate.lambdify()
    assert np.abs(rate.value(q, dq) - difference).max() < 1e-8
    assert np.abs(function(q, dq) - difference).max() < 1e-8
    assert np.abs(function(q[1], dq[1]) - difference[1]).max() < 1e-8
    with pytest.raises(TypeError, match="takes q and dq"):
        function(q)
    with pytest.raises(beeline.Error, match="dq the shape|dq \\("):
        function(q, dq[:2])


def test_expressions_are_a_ring_and_have_derivatives(rng):
    arm = beeline.arms.rrr()
    tool, jacobian = beeline.tool_formula(arm), beeline.jacobian_formula(arm)
    x, y = tool[0, 3], tool[1, 3]
    assert x.derivative("q1") == jacobian[0, 0] == -y
    assert x.derivative("q1") + y == 0 * x and not x - x and x
    q = rng.uniform(-3, 3, 3)
    assert (2 * x * y - x + 1.5).value(q) == pytest.approx(2 * x.value(q) * y.value(q) - x.value(q) + 1.5)
    assert isinstance(x.value(q), float) and x.lambdify()(q) == pytest.approx(x.value(q))
    assert x.lambdify()([q, q]) == pytest.approx([x.value(q)] * 2)
    assert str(x) == "a₁c₁ + a₂c₁₂ + a₃c₁₂₃" and "a_{1} c_{1}" in x._repr_latex_()
    assert tool[:1, 3:] == tool[[0]][:, [3]] and tool[:1, 3:].lambdify()(q).shape == (1, 1)
    assert tool[:1, 3:].lambdify()([q, q, q]).shape == (3, 1, 1)


def test_the_determinant_names_its_singularities(rng):
    determinant = beeline.determinant_formula(beeline.arms.rrr())
    assert str(determinant).startswith("det J = a₁a₂s₂\nSingular where s₂ = 0")
    assert [(str(factor), exponent) for factor, exponent in determinant.factors] == [("s₂", 1)]
    arm = beeline.arms.ur5()
    q = rng.uniform(-3, 3, 6)
    value = beeline.determinant_formula(arm).expression.value(q)
    assert value == pytest.approx(np.linalg.det(beeline.jacobian(arm, q)), rel=1e-9)
    assert len(beeline.determinant_formula(arm).singularities) >= 3


def test_documents_have_the_derivation_of_inverse_kinematics():
    arm = beeline.arms.rrr()
    document = beeline.formula_document(arm, links=False, tool=False, inverse=True)
    assert [section.key for section in document.sections] == ["inverse"]
    assert "law of cosines" in str(document) and "\\frac" in document.latex()
    assert document.latex(standalone=True).startswith("\\documentclass")
    assert "$$\nc_{2} = \\frac" in document._repr_markdown_()
    assert beeline.has_inverse_formula(arm) and not beeline.has_inverse_formula(beeline.arms.panda())
    with pytest.raises(beeline.Error):
        beeline.formula_document(beeline.arms.panda(), inverse=True)


def test_code_in_three_languages():
    arm = beeline.arms.panda()
    for language, word in [("python", "def panda_jacobian(q)"), ("c", "<math.h>"), ("c++", "<cmath>")]:
        code = beeline.formula_code(arm, language, jacobian=True)
        assert word in str(code) and code.functions[-1].name == "panda_jacobian"
    assert "def rrr_x(q):" in beeline.tool_formula(beeline.arms.rrr())[0, 3].code(name="x").text


def test_a_mimic_joint_follows_in_symbols(rng):
    arm = beeline.Arm.from_string("RRR:1,1,1")
    joints = arm.joints
    follower = beeline.Joint(
        name="joint3", offset=joints[2].offset, screw=joints[2].screw,
        mimic=beeline.Mimic(leader="joint1", multiplier=-2, offset=0.3),
    )  # fmt: skip
    arm = beeline.Arm("mimic", [*joints[:2], follower])
    q = rng.uniform(-3, 3, (5, 2))
    assert np.allclose(beeline.tool_formula(arm).lambdify()(q), beeline.forward_kinematics(arm, q))


def test_copies_pickles_and_equality():
    arm, other = beeline.arms.rrr(), beeline.arms.rp()
    made = [
        lambda arm: beeline.symbolic_arm(arm),
        lambda arm: beeline.tool_formula(arm),
        lambda arm: beeline.tool_formula(arm)[0, 3],
        lambda arm: beeline.formula_document(arm, inverse=True),
        lambda arm: beeline.formula_code(arm, jacobian=True),
        lambda arm: beeline.determinant_formula(arm, "110000" if arm == other else None),
    ]
    for make in made:
        value = make(arm)
        for again in [pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value), make(arm)]:
            assert again == value and repr(again) == repr(value)
        assert make(other) != value and value != 1
    panda = beeline.jacobian_formula(beeline.arms.panda())
    assert pickle.loads(pickle.dumps(panda)) == panda


@pytest.mark.parametrize(
    "wrong, error, message",
    [
        (lambda arm, x: x + "a", TypeError, "operand"),
        (lambda arm, x: x + float("nan"), beeline.Error, "finite"),
        (lambda arm, x: x + beeline.tool_formula(beeline.arms.ur5())[0, 0], beeline.Error, "different arms"),
        (lambda arm, x: x.derivative("z9"), beeline.Error, "known: q1"),
        (lambda arm, x: x.value([1, 2]), beeline.Error, r"expected \(3,\)"),
        (lambda arm, x: x.lambdify()([1, 2]), beeline.Error, r"expected \(3,\)"),
        (lambda arm, x: x.lambdify()([1, 2, 3], [1, 2, 3]), TypeError, "q alone"),
        (lambda arm, x: x.code("java"), beeline.Error, "known: python"),
        (lambda arm, x: x.code(name="a b"), beeline.Error, "not a name"),
        (lambda arm, x: beeline.tool_formula("my.urdf"), TypeError, "Arm or a SymbolicArm"),
        (lambda arm, x: beeline.tool_formula(arm)[4, 0], IndexError, "bounds"),
        (lambda arm, x: beeline.tool_formula(arm)[0], beeline.Error, "part of a matrix"),
        (lambda arm, x: beeline.link_formula(arm, 4, 0), beeline.Error, "i must be a whole number from 0 to 3"),
        (lambda arm, x: beeline.link_formula(arm, 1, 2), beeline.Error, "k must be a whole number from 0 to 1"),
        (lambda arm, x: beeline.formula_document(arm, joints=True), TypeError, "known: links"),
        (lambda arm, x: beeline.determinant_formula(beeline.arms.panda()), beeline.Error, "task"),
    ],
)
def test_refusals(wrong, error, message):
    arm = beeline.arms.rrr()
    with pytest.raises(error, match=message):
        wrong(arm, beeline.tool_formula(arm)[0, 3])


def test_pickles_that_were_changed_are_refused():
    x = beeline.tool_formula(beeline.arms.rrr())[0, 3]
    arm, terms = x.__getstate__()
    for broken in [(), ((1, 0, 0, 0, 0), (), ()), ((1.0,), ((99, 1),), ()), ((1.0,), (), ((True, 0, ((-1, 1),)),))]:
        with pytest.raises((beeline.Error, TypeError, IndexError, RuntimeError)):
            x.__class__.__new__(x.__class__).__setstate__((arm, (broken,)))
