"""Formulas equal to SymPy's, symbolically: the same parameters multiplied out and simplified by SymPy, for
eight arms (panda's Jacobian with CASES=3)."""

import json
import re
import subprocess

import pytest
import sympy
from random_cases import cases

ARMS = ["rrr", "rp", "gantry", "scara", "stanford", "puma560", "ur5", "panda"]
SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
TOKEN = re.compile(r"[cs][\d₋]+|[a-z][\dₜ]|√\d|\d+|[-+/()²]")


@pytest.fixture(scope="session")
def formulas(build):
    def run(arm, *options):
        done = subprocess.run([build / "beeline", "formula", arm, "--json", *options], check=True,
                              capture_output=True, text=True)
        return json.loads(done.stdout)

    return run


def expression(text):
    """A printed formula as an expression of SymPy; c12 is cos(q1 + q2)."""
    text = text.translate(SUBSCRIPTS).replace("−", "-").replace(" ", "")
    tokens = TOKEN.findall(text)
    assert "".join(tokens) == text
    result, before = [], ""
    for token in tokens:
        if token[0] not in "+-/)²" and before not in ("", "+", "-", "/", "("):
            result.append("*")
        if joints := re.fullmatch(r"([cs])([\d₋]+)", token):
            angle = re.sub(r"(\d)", r"+q\1", joints[2]).replace("₋+", "-")
            result.append(f"{'cos' if joints[1] == 'c' else 'sin'}({angle})")
        elif token[0] == "√":
            result.append(f"sqrt({token[1:]})")
        else:
            result.append({"²": "**2"}.get(token, token))
        before = token
    return sympy.sympify("".join(result).replace("ₜ", "t"))


def matrix(formula):
    cells = sympy.Matrix([[expression(cell) for cell in row] for row in formula["cells"]])
    if cells.shape == (3, 3):  # of the plane
        plane = sympy.eye(4)
        plane[:2, :2], plane[:2, 3] = cells[:2, :2], cells[:2, 2]
        return plane
    return cells


def zero(difference):
    """Whether an expression is zero: as a polynomial in c and s of each joint, modulo c^2 + s^2 = 1."""
    expanded = sympy.expand(sympy.expand_trig(difference))
    for q in sorted((s for s in difference.free_symbols if s.name[0] == "q"), key=str):
        c, s = sympy.symbols(f"c{q} s{q}")
        expanded = expanded.subs({sympy.cos(q): c, sympy.sin(q): s})
        expanded = sympy.rem(sympy.expand(expanded), c**2 + s**2 - 1, c)
    return sympy.expand(expanded) == 0


def product(links):
    result = sympy.eye(4)
    for link in links:
        result = result * link
    return result


@pytest.mark.parametrize("arm", ARMS)
def test_the_tools_pose_is_the_product_of_the_links(formulas, arm):
    document = formulas(arm)
    links = [matrix(formula) for formula in document["links"]["formulas"]]
    tool = matrix(document["tool"]["formulas"][0])
    difference = product(links) - tool
    assert all(zero(entry) for entry in difference)


@pytest.mark.parametrize("arm", [arm for arm in ARMS if arm != "panda" or cases(3) >= 3])  # which takes 15 s
def test_the_jacobian_is_the_poses_derivative(formulas, arm):
    document = formulas(arm, "--of", "forward,jacobian", "--task", "spatial")
    tool = matrix(document["tool"]["formulas"][0])
    jacobian = matrix(document["jacobian"]["formulas"][0])
    rotation, position = tool[:3, :3], tool[:3, 3]
    for k in range(jacobian.shape[1]):
        q = sympy.Symbol(f"q{k + 1}")
        assert all(zero(entry) for entry in position.diff(q) - jacobian[:3, k])
        w = jacobian[3:, k]
        turned = sympy.Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]]) * rotation
        assert all(zero(entry) for entry in rotation.diff(q) - turned)


@pytest.mark.parametrize("arm, task", [("rrr", "planar"), ("scara", "111001"), ("stanford", "spatial"),
                                       ("puma560", "spatial"), ("ur5", "spatial")])
def test_the_determinant_is_the_jacobians(formulas, arm, task):
    """In the tool's frame, where the entries are shorter."""
    document = formulas(arm, "--of", "jacobian,determinant", "--task", task)
    jacobian = sympy.Matrix([[expression(cell) for cell in row]
                             for row in document["jacobian"]["formulas"][0]["cells"]])
    determinant = expression(document["determinant"]["formulas"][0]["cells"][0][0])
    values = {s: sympy.Rational(k + 3, 7) for k, s in
              enumerate(sorted(jacobian.free_symbols | determinant.free_symbols, key=str))
              if s.name[0] != "q"}
    angles = sorted((s for s in jacobian.free_symbols if s.name[0] == "q"), key=str)
    triples = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29), (12, 35, 37)]

    def exact(entry):  # rational points of the circles: exact, without simplification
        entry = sympy.expand_trig(entry)
        for s, (a, b, c) in zip(angles, triples):
            entry = entry.subs({sympy.cos(s): sympy.Rational(a, c), sympy.sin(s): sympy.Rational(b, c)})
        return entry.subs(values).subs({s: sympy.Rational(2, 3) for s in angles})

    assert jacobian.applyfunc(exact).det() == exact(determinant)
