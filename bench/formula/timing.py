#!/usr/bin/env python3
"""Time of forward kinematics with Jacobian: Beeline's generated code beside the library's jacobian(), the
code of CasADi and the code of SymPy's cse, in one run.

Usage: timing.py BEELINE FOLDER [ARM...], where FOLDER has libbeeline_core.a of a release build. Needs
SymPy and CasADi."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import casadi
    import sympy
    from operations import derived
    from sympy.printing.c import ccode
except ImportError as error:
    raise SystemExit(print(f"Left out: {error.name} is not installed"))

ROOT = Path(__file__).resolve().parent.parent.parent
SUBSCRIPT = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₜ−", "0123456789t-")
# In a file of its own: the instruction set of the others would change the alignment of Eigen's matrices.
LIBRARY = """
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
constexpr int n = @n@;
static beeline::Arm arm = beeline::built_in("@arm@");
void by_library(const double* q, double* T, double* J) {
  static beeline::Jacobian columns(6, n);
  const beeline::Pose pose = beeline::jacobian(arm, Eigen::Map<const Eigen::VectorXd>(q, n), columns);
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(T, 4, 4) = pose.matrix();
  Eigen::Map<Eigen::Matrix<double, 6, n, Eigen::RowMajor>>(J, 6, n) = columns;
}
"""
MAIN = """
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <vector>
extern "C" {
#include "casadi.c"
}
#include "sympy.h"
#include "beeline.h"
constexpr int n = @n@, count = 1000;
using Row = std::vector<double>;
static double check(const double* T, const double* J) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += (k + 1) * T[k];
  for (int k = 0; k < 6 * n; ++k) sum += (k + 3) * J[k];
  return sum;
}
void by_library(const double* q, double* T, double* J);
static void by_casadi(const double* q, double* T, double* J) {
  static casadi_real w[100000];
  static casadi_int iw[1000];
  const casadi_real* arguments[] = {q};
  casadi_real* results[] = {T, J};
  kinematics(arguments, results, iw, w, 0);
}
int main() {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-3, 3);
  std::vector<Row> rows(count, Row(n));
  for (Row& row : rows) for (double& value : row) value = uniform(engine);
  struct { const char* name; void (*run)(const double*, double*, double*); double best, sum; } peers[] = {
      {"generated", @arm@_jacobian, 1e9, 0}, {"library", by_library, 1e9, 0},
      {"casadi", by_casadi, 1e9, 0}, {"sympy", sympy_kinematics, 1e9, 0}};
  for (int repetition = 0; repetition < 200; ++repetition) {
    for (auto& peer : peers) {
      double T[16], J[6 * n], sum = 0;
      const auto begin = std::chrono::steady_clock::now();
      for (const Row& row : rows) { peer.run(row.data(), T, J); sum += J[0]; }
      const auto end = std::chrono::steady_clock::now();
      peer.best = std::min(peer.best, std::chrono::duration<double, std::nano>(end - begin).count() / count);
      peer.run(rows[0].data(), T, J);
      peer.sum = check(T, J) + 0 * sum;
    }
  }
  for (const auto& peer : peers) std::printf("%s %.1f %.12g\\n", peer.name, peer.best, peer.sum);
}
"""


def evaluated(cell, names):
    """A printed formula with the values of `names`, which has cos and sin as well."""
    text = cell.translate(SUBSCRIPT)
    text = re.sub(r"([a-z]\dt?|[a-z]t)(?=[a-z(])", r"\1*", text)
    text = re.sub(r"\b([cs])(\d)", lambda m: f"{'cos' if m[1] == 'c' else 'sin'}(q{m[2]})", text)
    return eval(text, {}, names)


def kinematics(document, matrix, names):
    """The tool's pose and the axes of all joints, from the printed transforms of the links."""
    modified = document["convention"].startswith("Modified")
    pose, axes = matrix([[float(row == column) for column in range(4)] for row in range(4)]), []
    for k, link in enumerate(document["links"]["formulas"]):
        fixed = link["left"].startswith("Tₜ")
        if not modified and not fixed:
            axes.append(pose[:3, 2])
        pose = pose @ matrix([[evaluated(cell, names) for cell in row] for row in link["cells"]])
        if modified and not fixed:
            axes.append(pose[:3, 2])
    return pose, axes


def by_casadi(document, n, constants, folder):
    q = casadi.SX.sym("q", n)
    names = {"cos": casadi.cos, "sin": casadi.sin, **constants, **{f"q{k + 1}": q[k] for k in range(n)}}

    def matrix(rows):
        return casadi.vertcat(*(casadi.horzcat(*row) for row in rows))

    pose, axes = kinematics(document, matrix, names)
    columns = casadi.vertcat(casadi.jacobian(pose[:3, 3], q), casadi.horzcat(*axes))
    # CasADi is column-major: the transposes are row by row.
    function = casadi.Function("kinematics", [q], [casadi.cse(casadi.densify(pose.T)),
                                                   casadi.cse(casadi.densify(columns.T))])
    generator = casadi.CodeGenerator("casadi.c", {"with_header": False})
    generator.add(function)
    generator.generate(str(folder) + "/")


def by_sympy(document, n, constants, folder):
    q = sympy.symbols(f"q1:{n + 1}")
    names = {"cos": sympy.cos, "sin": sympy.sin, **constants, **{str(s): s for s in q}}
    pose, axes = kinematics(document, sympy.Matrix, names)
    columns = pose[:3, 3].jacobian(q).col_join(sympy.Matrix.hstack(*axes))
    parts, outputs = sympy.cse(list(pose) + list(columns))
    lines = [f"const double q{k + 1} = q[{k}];" for k in range(n)]
    lines += [f"const double {left} = {ccode(right)};" for left, right in parts]
    lines += [f"{f'T[{k}]' if k < 16 else f'J[{k - 16}]'} = {ccode(right)};"
              for k, right in enumerate(outputs)]
    body = "\n  ".join(lines)
    (folder / "sympy.h").write_text("#include <cmath>\nusing std::cos; using std::sin;\n"
                                    "static void sympy_kinematics(const double* q, double* T, "
                                    f"double* J) {{\n  {body}\n}}\n")


def main(beeline, library, *arms):
    print("| arm | generated ns | library ns | CasADi ns | SymPy cse ns |\n|---|---|---|---|---|")
    for arm in arms or ["puma560", "ur5", "panda", "iiwa14"]:
        document = derived(beeline, arm)
        constants = {symbol["code_name"]: symbol["value"] for symbol in document["symbols"]}
        code = derived(beeline, arm, "--of", "jacobian", "--as", "c++", "--numbers")["code"]
        n = int(re.search(r"q\[(\d+)\]", code)[1])
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "beeline.h").write_text(code)
            by_casadi(document, n, constants, folder)
            by_sympy(document, n, constants, folder)
            for file, text in {"library": LIBRARY, "main": MAIN}.items():
                (folder / f"{file}.cpp").write_text(text.replace("@n@", str(n)).replace("@arm@", arm))
            compiler = ["c++", "-std=c++20", "-O3", "-w"]
            subprocess.run([*compiler, f"-I{ROOT}", "-isystem/usr/include/eigen3", "-c", "library.cpp"],
                           cwd=folder, check=True)
            subprocess.run([*compiler, "-march=native", "main.cpp", "library.o", "-o", "main",
                            f"-L{Path(library).resolve()}", "-lbeeline_core", "-lhwy"], cwd=folder, check=True)
            run = subprocess.run(["taskset", "-c", "0", folder / "main"], check=True,
                                 capture_output=True, text=True)
        rows = [line.split() for line in run.stdout.splitlines()]
        sums = [float(row[2]) for row in rows]
        assert max(sums) - min(sums) < 1e-9, rows
        print(f"| {arm} | " + " | ".join(row[1] for row in rows) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
