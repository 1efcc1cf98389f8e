"""The kinds of joints: what each needs in a case file, what can drive it, and what clearance it may have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True)
class JointKind:
    """What a case says of a joint of one kind.

    Attributes
    ----------
    meaning
        What it lets move, in a few words.
    axis
        What its axis is called; empty where it has none.
    second_axis
        Whether it has another one.
    coordinates
        What can be driven: ``angle``, ``position``.
    shapes
        Names of ``joints.SHAPES`` that its clearance may have, the usual one first; none where it is always
        ideal.
    """

    meaning: str
    axis: str = ""
    second_axis: bool = False
    coordinates: tuple[str, ...] = ()
    shapes: tuple[str, ...] = ()


KINDS: Final[dict[str, JointKind]] = {
    "fixed": JointKind("nothing moves"),
    "revolute": JointKind("turns about its axis", "axis", False, ("angle",), ("cylinder", "mesh")),
    "spherical": JointKind("turns about its point", shapes=("sphere", "mesh")),
    "cylindrical": JointKind(
        "turns about its axis and slides along it", "axis", False, ("angle", "position"), ("cylinder", "mesh")
    ),
    "prismatic": JointKind("slides along its axis", "axis", False, ("position",)),
    "universal": JointKind("turns about an axis of each body", "axis", True),
    "pin-slot": JointKind(
        "a ball that slides along a pin", "axis of the pin", False, ("position",), ("ball", "cylinder")
    ),
    "planar": JointKind("slides and turns in a plane", "normal of the plane", False, ("angle",)),
    "spring-damper": JointKind("moves against six stiffnesses", coordinates=("angle", "position")),
}
"""Every kind of joint by its name."""

GROUND: Final = "ground"
"""Name of the body that never moves."""
