"""The built-in arms: those of Dellaert, *Serial Link Manipulators*, and industrial ones."""

from ._core import Arm, built_in_names

__all__ = ["gantry", "iiwa14", "names", "panda", "puma560", "rp", "rrr", "scara", "stanford", "ur5", "ur5e"]


def names() -> list[str]:
    """Returns the names of the built-in arms."""
    return built_in_names()


def rrr() -> Arm:
    """Planar, links of 3.5, 3.5 and 2 m (section 1.5 of the chapter)."""
    return Arm.load("rrr")


def rp() -> Arm:
    """Planar, a link of 1 m and a prismatic joint along it (exercise of section 1.3)."""
    return Arm.load("rp")


def gantry() -> Arm:
    """Planar, two prismatic joints at right angles (exercise of section 1.7)."""
    return Arm.load("gantry")


def puma560() -> Arm:
    """Unimation PUMA 560, six joints, without pedestal."""
    return Arm.load("puma560")


def ur5() -> Arm:
    """Universal Robots UR5, six joints."""
    return Arm.load("ur5")


def ur5e() -> Arm:
    """Universal Robots UR5e, six joints."""
    return Arm.load("ur5e")


def scara() -> Arm:
    """SCARA, RRRP."""
    return Arm.load("scara")


def stanford() -> Arm:
    """Stanford arm, RRPRRR."""
    return Arm.load("stanford")


def panda() -> Arm:
    """Franka Emika Panda, seven joints, its flange as the tool."""
    return Arm.load("panda")


def iiwa14() -> Arm:
    """KUKA LBR iiwa 14, seven joints."""
    return Arm.load("iiwa14")
