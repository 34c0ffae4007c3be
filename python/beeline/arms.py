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

    def arm(*arguments: object) -> Arm:
        if arguments:
            raise TypeError(f"arms.{name}() takes no arguments; an arm of your own is Arm.load(\"RRR:0.4,0.3,0.2\")")
        return Arm.load(name)

    arm.__name__ = arm.__qualname__ = name
    return arm


def __dir__() -> list[str]:
    return [*__all__, *names()]
