"""formula: fixed formulas of the chapter's arms, generated code that is compiled and run, LaTeX."""

import re
import shutil
import subprocess

import numpy as np
import pytest

from arms import text

ARMS = {"rrr": 3, "rp": 2, "gantry": 2, "puma560": 6, "ur5": 6, "ur5e": 6, "panda": 7, "iiwa14": 7,
        "scara": 4, "stanford": 6}
CONTENT = "forward,jacobian,derivative"
MAIN = """
#include <stdio.h>
int main(void) {
  double q[@n@], dq[@n@], T[16], J[6 * @n@], dJ[6 * @n@], U[16];
  int k;
  for (;;) {
    for (k = 0; k < @n@; ++k) if (scanf("%lf", &q[k]) != 1) return 0;
    for (k = 0; k < @n@; ++k) if (scanf("%lf", &dq[k]) != 1) return 1;
    @arm@_forward(q, U);
    @arm@_jacobian(q, T, J);
    @arm@_jacobian_derivative(q, dq, dJ);
    for (k = 0; k < 16; ++k) printf("%.17g ", T[k] == U[k] ? T[k] : 1e9);
    for (k = 0; k < 6 * @n@; ++k) printf("%.17g ", J[k]);
    for (k = 0; k < 6 * @n@; ++k) printf("%.17g ", dJ[k]);
    printf("\\n");
  }
}
"""
COMPILERS = {
    "c": (["cc", "-std=c99", "-pedantic"], "c"),
    "c++": (["c++", "-std=c++11", "-pedantic"], "cpp"),
}


@pytest.fixture
def rows(seed):
    """rows(n, k) -> n random rows of k numbers, the same in every run."""
    random = np.random.default_rng(seed)
    return lambda n, k: random.uniform(-3, 3, (n, k))


@pytest.fixture
def kinematics(beeline, tmp_path):
    """kinematics("ur5", rows) -> poses and Jacobians by the library, a row each."""

    def answer(arm, q):
        np.save(tmp_path / "q.npy", q)
        values = []
        for verb, options in (("fk", []), ("jacobian", ["--task", "spatial"])):
            done = beeline("batch", verb, arm, "--in", "q.npy", "--out", f"{verb}.npy", *options)
            assert done.code == 0, done.err
            values.append(np.load(tmp_path / f"{verb}.npy"))
        return values

    return answer


def differences(code, q, dq):
    """The derivative of the Jacobian by differences of code(q)'s."""
    h = 1e-5
    return (code(q + h * dq)[:, 16:] - code(q - h * dq)[:, 16:]) / (2 * h)


def same(a, b, tolerance=1e-12):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance)


@pytest.mark.parametrize("language", COMPILERS)
@pytest.mark.parametrize("arm", ARMS)
def test_compiled_code_equals_the_library(beeline, kinematics, rows, tmp_path, arm, language):
    n = ARMS[arm]
    command, ending = COMPILERS[language]
    if shutil.which(command[0]) is None:
        pytest.skip(f"there is no {command[0]}")
    done = beeline("formula", arm, "--of", CONTENT, "--as", language, "--task", "spatial", "--out",
                   f"arm.{ending}", *(["--numbers"] if language == "c" else []))
    assert done.code == 0, done.err
    source = tmp_path / f"arm.{ending}"
    source.write_text(source.read_text() + MAIN.replace("@n@", str(n)).replace("@arm@", arm))
    subprocess.run([*command, "-Wall", "-Wextra", "-Werror", source, "-o", tmp_path / "arm", "-lm"],
                   check=True)

    def run(q, dq):
        lines = "\n".join(" ".join(map(repr, row)) for row in np.hstack([q, dq]).tolist())
        done = subprocess.run([tmp_path / "arm"], input=lines, capture_output=True, text=True,
                              check=True)
        return np.array([line.split() for line in done.stdout.splitlines()], dtype=float)

    q, dq = rows(200, n), rows(200, n)
    poses, jacobians = kinematics(arm, q)
    values = run(q, dq)
    same(values[:, :16], poses)
    same(values[:, 16:16 + 6 * n], jacobians)
    differenced = differences(lambda at: run(at, dq)[:, :16 + 6 * n], q, dq)
    same(values[:, 16 + 6 * n:], differenced, 1e-7)


@pytest.mark.parametrize("arm", ARMS)
def test_python_code_equals_the_library(beeline, kinematics, rows, arm):
    n = ARMS[arm]
    names = {}
    code = beeline("formula", arm, "--of", CONTENT, "--as", "python", "--task", "spatial")
    exec(compile(code.out, "<formula>", "exec"), names)
    q, dq = rows(100, n), rows(100, n)
    poses, jacobians = kinematics(arm, q)

    def run(configurations):
        answers = (names[f"{arm}_jacobian"](row) for row in configurations.tolist())
        return np.array([np.concatenate([np.ravel(T), np.ravel(J)]) for T, J in answers])

    values = run(q)
    same(values, np.hstack([poses, jacobians]))
    forward = [np.ravel(names[f"{arm}_forward"](row)) for row in q.tolist()]
    same(forward, poses)
    rates = [np.ravel(names[f"{arm}_jacobian_derivative"](*pair))
             for pair in zip(q.tolist(), dq.tolist())]
    same(rates, differences(run, q, dq), 1e-7)


def test_the_macro_precedes_each_function(beeline, tmp_path):
    """For CUDA it is __host__ __device__; here an attribute that C++ compilers know."""
    code = beeline("formula", "ur5", "--of", "all", "--as", "c++").out
    assert code.count("BEELINE_FORMULA_FUNCTION") == 2 + 4
    (tmp_path / "ur5.cpp").write_text(code)
    subprocess.run(["c++", "-std=c++11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only",
                    "-DBEELINE_FORMULA_FUNCTION=inline __attribute__((always_inline))",
                    tmp_path / "ur5.cpp"], check=True)


def formulas(beeline, arm, content, *options):
    document = beeline("formula", arm, "--of", content, "--json", *options).json
    return {formula["left"]: formula["cells"]
            for section in ("links", "tool", "jacobian", "determinant") if section in document
            for formula in document[section]["formulas"]}


def test_the_exercise_of_section_1_3(beeline):
    """The RP arm: its matrix and (x, y, theta), in symbols and numbers."""
    found = formulas(beeline, "rp", "forward")
    assert found["T₁⁰"] == [["c₁", "−s₁", "a₁c₁"], ["s₁", "c₁", "a₁s₁"], ["0", "0", "1"]]
    assert found["T₂¹"] == [["1", "0", "q₂"], ["0", "1", "0"], ["0", "0", "1"]]
    assert found["T"] == [["c₁", "−s₁", "c₁(a₁ + q₂)"], ["s₁", "c₁", "s₁(a₁ + q₂)"],
                          ["0", "0", "1"]]
    assert [found[name] for name in "xyθ"] == [[["c₁(a₁ + q₂)"]], [["s₁(a₁ + q₂)"]], [["q₁"]]]
    numbers = formulas(beeline, "rp", "forward", "--numbers")
    assert numbers["T"] == [["c₁", "−s₁", "c₁(1 + q₂)"], ["s₁", "c₁", "s₁(1 + q₂)"],
                            ["0", "0", "1"]]


def test_equation_1_2(beeline):
    found = formulas(beeline, "rrr", "forward")
    assert found["T"] == [["c₁₂₃", "−s₁₂₃", "a₁c₁ + a₂c₁₂ + a₃c₁₂₃"],
                          ["s₁₂₃", "c₁₂₃", "a₁s₁ + a₂s₁₂ + a₃s₁₂₃"], ["0", "0", "1"]]
    assert found["θ"] == [["q₁ + q₂ + q₃"]]
    numbers = formulas(beeline, "rrr", "forward", "--numbers")
    assert numbers["x"] == [["3.5 c₁ + 3.5 c₁₂ + 2c₁₂₃"]]


def test_equations_1_4_and_1_7(beeline):
    """The chapter's 1.7 has 2.5 in two columns, which is the arm of its figures: a3 is 2."""
    assert formulas(beeline, "rrr", "jacobian")["J"] == [
        ["−a₁s₁ − a₂s₁₂ − a₃s₁₂₃", "−a₂s₁₂ − a₃s₁₂₃", "−a₃s₁₂₃"],
        ["a₁c₁ + a₂c₁₂ + a₃c₁₂₃", "a₂c₁₂ + a₃c₁₂₃", "a₃c₁₂₃"],
        ["1", "1", "1"],
    ]
    assert formulas(beeline, "rrr", "jacobian", "--numbers")["J"] == [
        ["−3.5 s₁ − 3.5 s₁₂ − 2s₁₂₃", "−3.5 s₁₂ − 2s₁₂₃", "−2s₁₂₃"],
        ["3.5 c₁ + 3.5 c₁₂ + 2c₁₂₃", "3.5 c₁₂ + 2c₁₂₃", "2c₁₂₃"],
        ["1", "1", "1"],
    ]


@pytest.mark.parametrize(
    "arm, task, determinant",
    [
        ("rrr", "planar", "a₁a₂s₂"),
        ("gantry", "110000", "1"),
        ("rp", "110000", "−(a₁ + q₂)"),
        ("puma560", "spatial", "a₂s₅(a₃s₃ + d₄c₃)(a₂c₂ + a₃c₂₃ − d₄s₂₃)"),
        ("ur5", "spatial", "a₂a₃s₃s₅(a₂c₂ + a₃c₂₃ + d₅s₂₃₄)"),
        ("stanford", "spatial", "q₃²s₂s₅"),
    ],
)
def test_determinants_and_their_factors(beeline, arm, task, determinant):
    found = formulas(beeline, arm, "determinant", "--task", task)
    assert found["det J"] == [[determinant]]


def test_singularities_in_words(beeline):
    puma = beeline("formula", "puma560", "--of", "determinant", "--json").json
    wrist, elbow, shoulder = puma["determinant"]["sentences"]
    assert wrist == "Singular where s₅ = 0: q₅ = 0 or ±π; the axes of joints 4 and 6 are in line."
    assert "−1.523818 or 1.617774 rad" in elbow and "stretched or folded" in elbow
    assert shoulder == "Singular where a₂c₂ + a₃c₂₃ − d₄s₂₃ = 0."
    gantry = beeline("formula", "gantry", "--of", "determinant", "--task", "110000", "--json").json
    assert gantry["determinant"]["sentences"] == ["Singular nowhere."]


@pytest.mark.parametrize("arm", ["rp", "rrr", "puma560", "panda"])
def test_latex_compiles_by_itself(beeline, tmp_path, arm):
    if shutil.which("pdflatex") is None:
        pytest.skip("there is no pdflatex (Debian: texlive-latex-base)")
    content = "all" if arm in ("rrr", "puma560") else "forward,jacobian"
    done = beeline("formula", arm, "--of", content, "--as", "latex", "--standalone", "--out", "f.tex")
    assert done.code == 0, done.err
    run = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "f.tex"],
                         cwd=tmp_path, capture_output=True, text=True, errors="replace")
    assert run.returncode == 0, run.stdout[-2000:]
    assert "Overfull" not in (tmp_path / "f.log").read_text(errors="replace")


def test_a_formula_that_is_too_large_is_refused_and_its_code_is_not(beeline, refused):
    long_arm = "S" * 33
    line = refused(2, "formula", long_arm, says=["too large", "--as python", "--of links"])
    assert len(line) < 500
    code = beeline("formula", long_arm, "--as", "c", "--of", "forward,jacobian")
    assert code.code == 0
    assert len(code.out) < 2_000_000


def test_refusals(refused):
    refused(2, "formula", "rrr", "--of", "jacobean", says=["--of", "jacobian"])
    refused(2, "formula", "rp", "--of", "determinant", says=["as many rows as joints", "another task"])
    refused(2, "formula", "panda", "--of", "determinant", says=["6", "7"])
    refused(2, "formula", "rrr", "--standalone", says=["--standalone", "--as latex"])
    refused(2, "formula", "rrr", "--as", "html", says=["--as", "latex"])
    refused(2, "formula", "rrr", "--as", "c", "--of", "inverse", says=["--as c", "--of"])
    refused(2, "formula", "rrr", "--as", "c", "--all", says=["--all"])
    refused(2, "formula", "ur5", "--of", "inverse", says=["planar"])
    refused(2, "formula", "rrr", "--angle-tolerance", "1", says=["--angle-tolerance"])
    refused(3, "formula", "rrr", "--out", "no/such/f.txt", says=["no/such"])


def rounded_urdf(angle):
    return f"""<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<origin xyz="0 0 0.3"/></joint>
<joint name="j2" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/>
<origin xyz="0.1 0 0.2" rpy="{angle} 0 0"/></joint></robot>"""


def test_rounded_angles_are_named_or_said(beeline, written):
    """1.5708 is no right angle to 1e-9; 1.57079632679 is, and the answer says by how much."""
    named = beeline("formula", written("r.urdf", rounded_urdf("1.5708")), "--json").json
    assert pytest.approx(1.5708, abs=1e-15) in [s["value"] for s in named["symbols"]]
    assert "1e-05 rad" in named["notes"][0] and "--angle-tolerance" in named["notes"][0]
    exact = beeline("formula", written("s.urdf", rounded_urdf("1.57079632679")), "--json").json
    assert all(symbol["unit"] == "m" for symbol in exact["symbols"])
    assert "4.89" in exact["notes"][0]
    wide = beeline("formula", "r.urdf", "--angle-tolerance", "1e-5", "--json").json
    assert wide["links"] == exact["links"] and "3.67" in wide["notes"][0]


def test_names_are_escaped_in_latex_and_code(beeline, written):
    """Whatever an arm and its joints are called."""
    urdf = rounded_urdf("0.3").replace('"j1"', '"j_1 50% #"').replace('name="r"', 'name="9 */ \\r_ö"')
    written("r.urdf", urdf)
    latex = beeline("formula", "r.urdf", "--of", "forward,jacobian", "--as", "latex").out
    assert "j\\_1 50\\% \\#" in latex and "\\textbackslash{}r\\_?" in latex
    code = beeline("formula", "r.urdf", "--as", "c").out
    assert "void arm_9_____r____forward(" in code and code.count("*/") == code.count("/*")


def test_the_tool_and_the_mount_are_in_the_formulas(beeline):
    found = formulas(beeline, "rrr", "forward", "--tcp", "0.5,0,0", "--mount", "1,2,0")
    assert found["x"] == [["x₀ + a₁c₁ + a₂c₁₂ + c₁₂₃(a₃ + xₜ)"]]
    assert "Tₜ³" in found and "T₀ʷ" in found


@pytest.mark.parametrize("arm", ["rrr", "rp", "RR:1,2", "RP:1,0.5@30", "PR:1@30,2", "PP:0,0@90", "RPR:1,0@90,0.5",
                                 "PPR:0,0@90,1", "RRP:1,2,0@90", "PRP:0,1,0@90", "RPP:1,0,0.2@45", "PRR:0@20,1,2",
                                 "RRR:1@10,2@20,3@30"])
def test_inverse_kinematics_in_steps(beeline, rows, arm):
    """The steps, as they are printed, give the joint values of a pose; the solution is among both signs."""
    document = beeline("formula", arm, "--of", "inverse", "--json").json
    steps = [(formula["left"], formula["cells"][0][0]) for formula in document["inverse"]["formulas"]]
    joints = sorted(left for left, _ in steps if left.startswith("q"))
    constants = {plain(symbol["name"]): symbol["value"] for symbol in document["symbols"]}
    for q in rows(20, len(joints)):
        pose = beeline("fk", arm, "--q", text(q), "--json").json["pose"]["planar"]
        found = []
        for sign in (1, -1):
            names = {"cos": np.cos, "sin": np.sin, "atan2": np.arctan2, "root": lambda s: np.sqrt(max(s, 0)),
                     "sign": sign, "rad": np.pi / 180, "x": pose["x"], "y": pose["y"],
                     "theta": pose["theta"], **constants}
            for left, right in steps:
                names[plain(left)] = eval(python_of(right), names)
            found.append([names[plain(joint)] for joint in joints])
        revolute = np.array([letter == "R" for letter in arm.upper().split(":")[0]])
        differences = np.array(found) - q
        differences[:, revolute] = np.angle(np.exp(1j * differences[:, revolute]))
        assert np.abs(differences).max(axis=1).min() < 1e-6, (q, found, steps)


SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₜ", "0123456789t")


def plain(name):
    return name.translate(SUBSCRIPTS).replace("θ", "theta")


def python_of(formula):
    """A printed formula as Python: products and functions without brackets are made explicit."""
    formula = plain(formula).replace("−", "-").replace("±√(", "sign*root(").replace("± √(", "+ sign*root(")
    formula = formula.replace("√2", "2**0.5").replace("√3", "3**0.5").replace("²", "**2").replace("°", "*rad")
    formula = re.sub(r"(cos|sin) (theta\d?)", r"\1(\2)", formula)
    tokens = re.findall(r"atan2|cos|sin|root|sign|rad|theta\d?|[a-z]\d?|\d+(?:\.\d+)?|\*\*|[-+*/(),]", formula)
    result = []
    for token in tokens:
        before = result[-1] if result else ""
        ends_factor = before == ")" or re.fullmatch(r"theta\d?|[a-z]\d?|\d+(\.\d+)?", before)
        begins_factor = token == "(" or re.fullmatch(r"[a-z]\w*", token)
        if ends_factor and begins_factor and before not in ("atan2", "cos", "sin", "root"):
            result.append("*")
        result.append(token)
    return "".join(result)


def test_degrees(beeline):
    """Read from --tcp, and in the values of constants and at singularities."""
    document = beeline("formula", "RR:1@20,2", "--degrees", "--tcp", "0.1,0,25", "--json").json
    angles = {symbol["name"]: symbol["value"] for symbol in document["symbols"] if symbol["unit"] == "deg"}
    assert angles == {"θ₁": 20, "γₜ": pytest.approx(25, abs=1e-12)}
    assert document["units"]["angle"] == "deg"
    puma = beeline("formula", "puma560", "--of", "determinant", "--degrees").out
    assert "q₅ = 0 or ±180°" in puma and "q₃ = −87.308364° or 92.691636°" in puma


MIMIC = """<robot name="m"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="j1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<joint name="j2" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/><origin xyz="0.5 0 0"/>
<mimic joint="j1" multiplier="-2" offset="0.3"/></joint>
<joint name="j3" type="prismatic"><parent link="c"/><child link="d"/><axis xyz="1 0 0"/>
<limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="j1" multiplier="0.5"/></joint></robot>"""


def test_mimic_joints_are_formulas_of_the_joint_that_they_follow(beeline, written):
    arm = written("m.urdf", MIMIC)
    printed = beeline("formula", arm).out
    assert re.search(r"u₂ = 0\.3 − 2q₁ +mimic joint j2, rad\n", printed)
    assert re.search(r"u₃ = 0\.5 q₁ +mimic joint j3, m\n", printed)
    assert "u_{2}$ & $0.3 - 2 q_{1}$, rad &" in beeline("formula", arm, "--as", "latex").out
    two, three = (symbol for symbol in beeline("formula", arm, "--json").json["symbols"] if "joint" in symbol)
    assert (two["joint"], two["multiplier"], two["offset"]) == ("j1", -2, 0.3)
    assert (three["joint"], three["multiplier"], three["offset"]) == ("j1", 0.5, 0)
    assert "value" not in two
    two, three = (symbol for symbol in beeline("formula", arm, "--degrees", "--json").json["symbols"]
                  if "joint" in symbol)
    assert (two["multiplier"], two["offset"]) == (-2, pytest.approx(np.degrees(0.3)))
    assert three["multiplier"] == pytest.approx(np.radians(0.5))


def test_the_determinant_in_the_space_frame(beeline, refused):
    """The rows of a task are rows of the tool's velocity."""
    for arm in ("rrr", "ur5"):
        refused(2, "formula", arm, "--frame", "space", "--of", "determinant", says=["--frame base or tool"])
        rest = beeline("formula", arm, "--frame", "space", "--of", "all", "--json").json
        assert "determinant" not in rest and "jacobian" in rest
        assert "determinant is left out: it needs --frame base or tool" in rest["notes"][-1]


@pytest.mark.parametrize("language", COMPILERS)
def test_code_may_be_included_twice(beeline, tmp_path, language):
    command, ending = COMPILERS[language]
    if shutil.which(command[0]) is None:
        pytest.skip(f"there is no {command[0]}")
    assert beeline("formula", "rrr", "--as", language, "--out", "rrr.h").code == 0
    assert beeline("formula", "rrr", "--of", "jacobian", "--as", language, "--out", "jacobian.h").code == 0
    (tmp_path / f"a.{ending}").write_text('#include "rrr.h"\n#include "jacobian.h"\n#include "rrr.h"\n'
                                          "double T[16], J[9];\nvoid f(const double* q);\n"
                                          "void f(const double* q) { rrr_forward(q, T); rrr_jacobian(q, T, J); }\n")
    subprocess.run([*command, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", tmp_path / f"a.{ending}"], check=True)


def test_a_formula_that_is_too_large_is_refused_early(refused, seed, written):
    """Joints about any axes with any angles between: the expansion stops soon after the limit."""
    random = np.random.default_rng(seed)
    links = '<link name="l0"/>'
    for i in range(1, 8):
        axis, xyz, rpy = (text(random.uniform(0.1, 1, 3)).replace(",", " ") for _ in range(3))
        links += (f'<link name="l{i}"/><joint name="j{i}" type="continuous"><parent link="l{i - 1}"/>'
                  f'<child link="l{i}"/><axis xyz="{axis}"/><origin xyz="{xyz}" rpy="{rpy}"/></joint>')
    arm = written("general.urdf", f'<robot name="g">{links}</robot>')
    for content in ("forward", "jacobian"):
        line = refused(2, "formula", arm, "--of", content, says=["too large", "more than 50000"])
        assert int(re.search(r"has (\d+) symbols", line)[1]) < 300_000
