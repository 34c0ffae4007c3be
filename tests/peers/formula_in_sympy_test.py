"""Formulas of the Python module for SymPy: equal as numbers, and to SymPy's own derivatives."""

import os
import random

import numpy as np
import pytest

beeline = pytest.importorskip("beeline")
sympy = pytest.importorskip("sympy")

SEED = int(os.environ.get("BEELINE_SEED", random.randrange(10**6)))


@pytest.mark.parametrize("name", ["rrr", "rp", "scara", "stanford", "puma560", "ur5"])
def test_sympy_has_the_same_values_and_derivatives(name):
    print("seed", SEED)
    arm = beeline.Arm.load(name)
    tool, jacobian = beeline.tool_formula(arm), beeline.jacobian_formula(arm)
    in_sympy = tool.to_sympy()
    assert in_sympy.shape == (4, 4)
    q = np.random.default_rng(SEED).uniform(-3, 3, arm.dof)
    values = {sympy.Symbol(symbol.letter + symbol.subscript): symbol.value for symbol in tool.arm.symbols}
    values |= {sympy.Symbol(f"q{k + 1}"): q[k] for k in range(arm.dof)}
    assert np.allclose(np.array(in_sympy.subs(values).evalf(), dtype=float), tool.value(q), atol=1e-12)
    for row in range(3):
        for column in range(arm.dof):
            derivative = sympy.diff(in_sympy[row, 3], sympy.Symbol(f"q{column + 1}"))
            difference = sympy.expand(sympy.expand_trig(derivative - jacobian[row, column].to_sympy()))
            assert abs(complex(difference.subs(values).evalf())) < 1e-12


def test_exact_roots_stay_exact():
    row = beeline.DhRow(a=1.0, alpha=np.pi / 4)
    arm = beeline.Arm.from_dh([row, row], convention="standard")
    entries = beeline.tool_formula(arm).to_sympy()
    assert any(entry.has(sympy.sqrt(2)) for entry in entries) and not any(entry.has(sympy.Float) for entry in entries)


def test_a_mimic_joint_is_written_in_its_leader():
    arm = beeline.Arm.from_string("RR:1,1")
    first, second = arm.joints
    mimic = beeline.Mimic(leader="joint1", multiplier=2.0, offset=0.1)
    follower = beeline.Joint(name="joint2", offset=second.offset, screw=second.screw, mimic=mimic)
    x = beeline.tool_formula(beeline.Arm("mimic", [first, follower]))[0, 3]
    names = {symbol.name for symbol in x.to_sympy().free_symbols}
    assert names == {"a1", "a2", "q1"}
    value = x.to_sympy().subs({"a1": 1, "a2": 1, "q1": 0.3})
    assert float(value) == pytest.approx(x.value([0.3]), abs=1e-12)
