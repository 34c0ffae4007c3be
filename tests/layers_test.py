"""layers.txt holds, and the check of it sees what it must see."""

import pytest

from layers import read_layers, violations


def test_the_house_keeps_its_order(root):
    assert violations(root) == []


@pytest.fixture
def house(tmp_path):
    """A small house in order: pose, then model on it, then draw on both."""

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


def test_a_house_in_order_passes(house):
    assert violations(house) == []


def test_the_umbrella_includes_the_public_headers_of_the_core(house):
    umbrella = house / "beeline/beeline.h"
    umbrella.write_text("#include <beeline/error.h>\n#include <beeline/model/arm.h>\n")
    assert violations(house) == ["beeline/beeline.h does not include beeline/pose/pose.h"]
    umbrella.write_text(umbrella.read_text() + "#include <beeline/pose/pose.h>\n")
    assert violations(house) == []
    (house / "beeline/model/arm.h").write_text("#include <beeline/beeline.h>\n")
    assert violations(house) == [
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
        ("model/json.cpp", "#include <nlohmann/json.hpp>", "belongs to read and record"),
        ("draw/scene.h", "#include <cairo.h>", "a header does not include"),
        ("draw/scene.h", "#include <cairo/cairo.h>", "a header does not include"),
        ("draw/print.cpp", "#include <boost/any.hpp>", "no folder uses this library"),
        ("model/file.h", "#include <unistd.h>", "a header does not include the system's"),
        ("attic/old.h", "#include <string>", "beeline/attic is not in layers.txt"),
    ],
)
def test_a_bad_include_is_refused(house, file, line, reason):
    (house / "beeline" / file).parent.mkdir(exist_ok=True)
    (house / "beeline" / file).write_text("#include <string>\n" + line + "\n")
    found = violations(house)
    assert len(found) == 1
    assert reason in found[0]
    assert f"beeline/{file}:2" in found[0] or "layers.txt" in found[0]


@pytest.mark.parametrize(
    "order, reason",
    [
        (["pose: model", "model: pose"], "pose may include model, which is not below it"),
        (["pose: pose"], "pose may include pose, which is not below it"),
        (["model: pose", "pose:"], "model may include pose, which is not below it"),
        (["pose:", "pose:"], "pose stands there twice"),
    ],
)
def test_an_order_with_a_circle_is_refused(tmp_path, order, reason):
    path = tmp_path / "layers.txt"
    path.write_text("\n".join(order) + "\n")
    with pytest.raises(ValueError, match=reason):
        read_layers(path)
