"""Type checkers see what the module has: the stub names all of it, and code that uses it passes `mypy --strict`."""

import ast
import os
import subprocess
import sys

import beeline


# They take what has been checked when it was made.
NOTHING_REFUSED = {"length_of", "span_of", "motion_limits", "tool_formula", "base_formula", "tool_offset_formula", "latex",
                   "time_derivative", "has_inverse_formula", "display_configuration", "base_blocked_by",
                   "slight_excess"}  # fmt: skip


def mypy(build, *words):
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    environment |= {"MYPYPATH": str(build / "python"), "MYPY_CACHE_DIR": str(build / "mypy")}
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", *words],
        capture_output=True, text=True, cwd=build, env=environment,
    )  # fmt: skip
    return done.stdout + done.stderr if done.returncode else ""


def test_the_stub_has_the_names_of_the_module(build):
    stub = ast.parse((build / "python" / "beeline" / "_core.pyi").read_text())
    defined = {node.name for node in stub.body if hasattr(node, "name")}
    defined |= {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
    assert set(beeline._core.__all__) == {name for name in defined if not name.startswith("_")}
    assert set(beeline._core.__all__) < set(beeline.__all__)


def test_every_public_function_has_a_signature_and_a_docstring(build):
    for name in beeline._core.__all__:
        assert getattr(beeline, name).__doc__, name
    stub = ast.parse((build / "python" / "beeline" / "_core.pyi").read_text())
    functions = [node for node in ast.walk(stub) if isinstance(node, ast.FunctionDef)]
    for function in functions:
        parameters = function.args.args + function.args.kwonlyargs + function.args.posonlyargs
        untyped = [parameter.arg for parameter in parameters if parameter.annotation is None]
        assert untyped in ([], ["self"]), (function.name, untyped)
        assert function.returns is not None, function.name
        documented = ast.get_docstring(function) or ""
        assert documented or function.name != "__init__", ast.dump(function)
        if "Parameters\n---" in documented and function.name not in NOTHING_REFUSED | {"__init__"}:
            assert "Raises\n---" in documented, function.name


def test_docstrings_say_what_is_refused():
    documented = {
        beeline.jacobian: "For `q` of another shape or not finite; for `out` of another shape or read-only; "
        "for `frame`, `threads` other than described.",
        beeline.limit_usage: "`trajectory` that does not fit the arm",
        beeline.planar_jacobian: "; when the arm is not planar.",
        beeline.Trajectory.load: "beeline.FileError\n    For invalid lines, which it names.",
        beeline.Servo.__init__: "other than described",
        beeline.Trajectory.__init__: "for times that do not increase",
        beeline.Limits.__init__: "`lower`, `upper`",
        beeline.poses.from_any: "For matrices of another shape",
    }
    for function, text in documented.items():
        assert text in function.__doc__.split("Raises\n")[1]


def test_the_package_passes_strictly(build):
    assert mypy(build, "-p", "beeline") == ""


def test_code_that_uses_the_module_passes_strictly(root, build):
    users = [root / "tests" / "python" / "typed_code.py", *sorted((root / "examples").glob("*.py"))]
    assert mypy(build, *map(str, users)) == ""


def test_wrong_types_are_found(build, tmp_path):
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import beeline\n\nbeeline.arms.panda().with_speed_scale('half')\nbeeline.no_such_name\n")
    found = mypy(build, str(wrong))
    assert "wrong.py:3" in found and "wrong.py:4" in found


def test_the_typed_code_runs():
    from typed_code import main

    main()
