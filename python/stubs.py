"""Writes the type stub of the extension: the signatures and docstrings of every public name.

Usage: stubs.py EXTENSION STUB"""

import importlib.util
import re
import sys
from pathlib import Path

from nanobind.stubgen import StubGen


def main(extension: str, stub: str) -> None:
    # On its own, as the package renames the module of its classes.
    spec = importlib.util.spec_from_file_location("beeline._core", extension)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["beeline._core"] = module
    spec.loader.exec_module(module)

    generator = StubGen(module)
    generator.put(module)
    text = generator.get().replace("__all__: list =", "__all__: list[str] =")
    text = text.replace("__hash__: None = None", "__hash__: None  # type: ignore[assignment]")
    # One pose or many: their types do not differ, so the first signatures stand for one pose.
    shapes = re.compile(r"^( *def inverse_kinematics\(.*\) -> (?:InverseResult|int):)", re.MULTILINE)
    text = shapes.sub(r"\1  # type: ignore[overload-overlap]", text)
    # The dtype of an array for results.
    real = '_Real = TypeVar("_Real", numpy.float32, numpy.float64, default=numpy.float64)'
    private = f"from typing import Any\n\nfrom typing_extensions import TypeVar\n\n{real}\n\n__version__: str\n\ndef _command_line(words: list[bytes], /) -> int: ...\n"
    private += "\nfrom ._reason import Reason\n"
    private += "\ndef _matrix_of(value: object, /) -> Any: ...\n\ndef _arm_of(value: object, /) -> Arm: ...\n"
    private += "\ndef _collision_files(model: CollisionModel, /) -> tuple[str, str]: ...\n"
    Path(stub).write_text(text + "\n" + private)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
