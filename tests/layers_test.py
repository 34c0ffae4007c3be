"""The includes follow layers.txt, and the check finds every kind of violation."""

import pytest

from layers import MAX_PUBLIC_HEADERS, read_layers, violations


def test_the_library_keeps_its_order(root):
    assert violations(root) == []


@pytest.fixture
def library(tmp_path):
    """A small library in order: pose, model above it, draw above both."""

    def write(name, *lines):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines) + "\n")

    write("layers.txt", "# lowest first", "pose:", "model: pose", "draw: pose model")
    write("beeline/error.h", "#include <string>")
    write("beeline/pose/pose.h", "#include <Eigen/Core>", "#include <beeline/error.h>")
    write("beeline/model/arm.h", "#include <vector>", "#include <beeline/pose/pose.h>")
    write("beeline/draw/svg.cpp", "#include <cairo-svg.h>", "#include <beeline/model/arm.h>")
    return tmp_path


def test_a_library_in_order_passes(library):
    assert violations(library) == []


def test_the_umbrella_includes_every_public_header(library):
    umbrella = library / "beeline/beeline.h"
    umbrella.write_text("#include <beeline/error.h>\n#include <beeline/model/arm.h>\n")
    assert violations(library) == ["beeline/beeline.h does not include beeline/pose/pose.h"]
    umbrella.write_text(umbrella.read_text() + "#include <beeline/pose/pose.h>\n")
    assert violations(library) == []
    (library / "beeline/model/arm.h").write_text("#include <beeline/beeline.h>\n")
    assert violations(library) == [
        "beeline/model/arm.h:1: beeline/beeline.h: it is for users of the library"
    ]


@pytest.mark.parametrize(
    "file, line, reason",
    [
        ("pose/up.h", "#include <beeline/model/arm.h>", "pose may not include model"),
        ("pose/up.cpp", "  #  include <beeline/model/arm.h>", "pose may not include model"),
        ("error.cpp", "#include <beeline/pose/pose.h>", ". may not include pose"),
        ("model/own.cpp", '#include "beeline/model/arm.h"', "write <beeline/...>"),
        ("model/own.cpp", "#include <beeline/model/leg.h>", "there is no such file"),
        ("model/json.cpp", "#include <nlohmann/json.hpp>", "belongs to io and io/text"),
        ("draw/drawing.h", "#include <cairo.h>", "a header does not include"),
        ("draw/drawing.h", "#include <cairo/cairo.h>", "a header does not include"),
        ("draw/print.cpp", "#include <boost/any.hpp>", "no folder uses this library"),
        ("model/file.h", "#include <unistd.h>", "a header does not include the system's"),
        ("attic/old.h", "#include <string>", "beeline/attic is not in layers.txt"),
    ],
)
def test_a_bad_include_is_refused(library, file, line, reason):
    (library / "beeline" / file).parent.mkdir(exist_ok=True)
    (library / "beeline" / file).write_text("#include <string>\n" + line + "\n")
    found = violations(library)
    assert len(found) == 1
    assert reason in found[0]
    assert f"beeline/{file}:2" in found[0] or "layers.txt" in found[0]


@pytest.mark.parametrize(
    "text, reason",
    [
        ("#include <beeline/pose/internal/secret.h>", "includes the internal"),
        ("#include <beeline/pose/kernel-inl.h>", "includes the internal"),
        ("/// Throws Error for a bad number.", "does not include <beeline/error.h>"),
    ],
)
def test_a_bad_public_header_is_refused(library, text, reason):
    for name in ["internal/secret.h", "kernel-inl.h"]:
        path = library / "beeline" / "pose" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("#include <string>\n")
    (library / "beeline" / "pose" / "bad.h").write_text(text + "\n")
    found = violations(library)
    assert len(found) == 1
    assert reason in found[0]
    (library / "beeline" / "pose" / "bad.h").rename(library / "beeline/pose/internal/good.h")
    assert violations(library) == []


@pytest.mark.parametrize("folder", ["cli", "cli/command", "python/src", "mpi", "web/core", "bench"])
@pytest.mark.parametrize(
    "line, reason",
    [
        ("#include <beeline/pose/internal/secret.h>", "include the internal secret.h"),
        ('#include "beeline/math/log.h"', "include the internal log.h"),
        ("#include <beeline/pose/kernel-inl.h>", "include the internal kernel-inl.h"),
        ("  return beeline::internal::secret();", "use beeline::internal"),
        ("using namespace beeline::internal::parts;", "use beeline::internal"),
    ],
)
def test_the_inside_is_refused_outside(library, folder, line, reason):
    file = library / folder / "verb.cpp"
    file.parent.mkdir(parents=True)
    file.write_text("#include <beeline/pose/pose.h>\n" + line + "\n")
    assert violations(library) == [f"{folder}/verb.cpp:2: only beeline/ and tests/ {reason}"]
    file.write_text("#include <beeline/pose/pose.h>\nusing namespace internal_names;\n")
    assert violations(library) == []


def test_public_headers_are_counted(library):
    for k in range(MAX_PUBLIC_HEADERS):
        (library / "beeline" / "pose" / f"h{k}.h").write_text("#include <string>\n")
    assert any(f"at most {MAX_PUBLIC_HEADERS}" in line for line in violations(library))


@pytest.mark.parametrize(
    "order, reason",
    [
        (["pose: model", "model: pose"], "pose may include model, which is not below it"),
        (["pose: pose"], "pose may include pose, which is not below it"),
        (["model: pose", "pose:"], "model may include pose, which is not below it"),
        (["pose:", "pose:"], "pose is listed twice"),
    ],
)
def test_a_cyclic_order_is_refused(tmp_path, order, reason):
    path = tmp_path / "layers.txt"
    path.write_text("\n".join(order) + "\n")
    with pytest.raises(ValueError, match=reason):
        read_layers(path)
