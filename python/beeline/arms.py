"""The built-in arms: the arms of Dellaert, *Serial Link Manipulators*, and arms on the market.

Each is a function without arguments, as `beeline.arms.panda()`. `names()` lists them, and
`beeline.built_in_arms()` says what each is and where its numbers come from."""

from collections.abc import Callable

from ._core import Arm, built_in_arms

__all__ = ["names"]


def names() -> list[str]:
    """Returns the names of the built-in arms."""
    return [arm.name for arm in built_in_arms()]


def __getattr__(name: str) -> Callable[[], Arm]:
    if name not in names():
        raise AttributeError(f"no built-in arm {name!r}; there are {', '.join(names())}")

    def arm() -> Arm:
        return Arm.load(name)

    arm.__name__ = name
    return arm


def __dir__() -> list[str]:
    return [*__all__, *names()]
