"""`cmake --install`, and programs of others that find what was installed."""

import os
import re
import subprocess

import pytest

from layers import is_public


def run(*command, **options):
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, **options
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def prefix(build, tmp_path_factory):
    prefix = tmp_path_factory.mktemp("installed")
    run("cmake", "--install", build, "--prefix", prefix)
    return prefix


def built_against(prefix, sources, folder, target):
    """Configures somebody's `sources` in `folder`, builds the target and returns the program."""
    run(
        "cmake", "-G", "Ninja", "-S", sources, "-B", folder,
        f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_FLAGS={os.environ.get('BEELINE_CXX_FLAGS', '')}",  # the sanitizers' own
    )  # fmt: skip
    run("cmake", "--build", folder, "--target", target)
    return folder / target


def test_the_installed_command_runs(prefix):
    assert "rrr" in run(prefix / "bin" / "beeline", "arms")


def test_the_manual_page_and_the_completions_are_installed(prefix):
    share = prefix / "share"
    assert ".TH BEELINE 1" in (share / "man" / "man1" / "beeline.1").read_text()
    for path in ("bash-completion/completions/beeline", "zsh/site-functions/_beeline",
                 "fish/vendor_completions.d/beeline.fish"):
        assert "retime" in (share / path).read_text()


def test_a_program_on_the_core_needs_eigen_only(prefix, root, tmp_path):
    program = built_against(prefix, root / "tests" / "install", tmp_path, "consumer")
    assert run(program) == "9.000 0.000\n"


def test_a_program_of_another_alignment_does_not_link(prefix, root, tmp_path):
    """A matrix of Eigen that crosses to the library would crash it."""
    command = [os.environ.get("CXX", "c++"), *os.environ.get("BEELINE_CXX_FLAGS", "").split(), "-std=c++20",
               "-isystem", "/usr/include/eigen3", f"-I{prefix}/include", root / "tests" / "install" / "consumer.cpp",
               "-o", tmp_path / "consumer", f"-L{next(prefix.glob('lib*/**/libbeeline_core.a')).parent}",
               "-lbeeline_core", "-lhwy", "-ldl"]  # fmt: skip
    wider = "-DEIGEN_MAX_ALIGN_BYTES=64"  # which -march=native may set
    refused = subprocess.run([str(word) for word in [*command, wider]], capture_output=True, text=True)
    assert refused.returncode != 0 and "aligns_eigen_as_the_library(" in refused.stderr
    run(*command)
    assert run(tmp_path / "consumer") == "9.000 0.000\n"


def test_an_example_builds_against_the_installed_copy(prefix, root, tmp_path):
    first = min((root / "examples").glob("*.cpp")).stem
    program = built_against(prefix, root / "examples", tmp_path, first)
    assert run(program, root / "examples", cwd=tmp_path) != ""


def test_every_compiler_finds_the_functions_of_a_library(prefix):
    """An expression that Eigen takes as a default argument of a template is named differently by GCC and Clang."""
    libraries = sorted((prefix / "lib").rglob("libbeeline_*.a"))
    symbols = [line.split()[-1] for library in libraries
               for line in run("nm", "--extern-only", "--defined-only", library).splitlines() if line.startswith("0")]
    ours = [symbol for symbol in symbols if symbol.startswith(("_ZN7beeline", "_ZNK7beeline"))]
    assert any("batch_forward" in symbol for symbol in ours)
    assert not [symbol for symbol in ours if "AtCompileTime" in symbol]


def test_an_unknown_component_is_refused(prefix, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\n"
        "project(wrong LANGUAGES CXX)\n"
        "find_package(beeline REQUIRED COMPONENTS legs)\n"
    )
    done = subprocess.run(
        ["cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode != 0
    message = " ".join(done.stderr.split())  # CMake breaks lines
    assert "beeline has no component 'legs': core, batch, reach, io, formula, doctor, draw" in message


def test_every_public_header_is_installed(prefix, root):
    """Not headers in folders internal/, nor -inl.h, which Highway compiles once for each instruction set."""
    library = root / "beeline"
    headers = {path for path in library.rglob("*.h") if is_public(path.relative_to(library))}
    installed = {path.relative_to(prefix / "include") for path in prefix.rglob("*.h")}
    assert installed == {path.relative_to(root) for path in headers}


def test_what_an_installed_header_includes_is_installed(prefix):
    for header in prefix.rglob("*.h"):
        for name in re.findall(r"#include <(beeline/[^>]*)>", header.read_text()):
            assert (prefix / "include" / name).is_file(), f"{header.name} includes {name}"


@pytest.mark.parametrize(
    "name, word",
    [
        ("doc/beeline/LICENSE", "Copyright"),
        ("doc/beeline/examples/00_ten_lines.cpp", "beeline"),
        ("beeline/arm.schema.json", "$schema"),
        ("beeline/scene.schema.json", "$schema"),
        ("bash-completion/completions/beeline", "retime"),
        ("zsh/site-functions/_beeline", "retime"),
        ("fish/vendor_completions.d/beeline.fish", "retime"),
        ("man/man1/beeline.1", "retime"),
    ],
)
def test_documents_and_completions_are_installed(prefix, name, word):
    assert word in (prefix / "share" / name).read_text()
