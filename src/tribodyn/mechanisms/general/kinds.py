"""The kinds of joints: constraint equations, keys in a case file, what can drive one, and its clearance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from tribodyn.kernels.mechanism.data import DIRECTION, POINT

Row = tuple[int, int, int]
"""Kind of a constraint equation, axis of the socket, axis of the shaft; 0, 1, 2 for x, y, z."""

_BALL: Final[tuple[Row, ...]] = tuple((POINT, i, 0) for i in range(3))
_ALONG: Final = _BALL[:2]
_ALIGNED: Final[tuple[Row, ...]] = ((DIRECTION, 0, 2), (DIRECTION, 1, 2))
_NO_TURN: Final[tuple[Row, ...]] = ((DIRECTION, 1, 0),)


@dataclass(frozen=True)
class JointKind:
    """A kind of joint.

    Attributes
    ----------
    meaning
        What it lets move, in a few words.
    rows
        What vanishes in the ideal joint. z is the axis, of a universal joint that on the first body, whose
        other axis is the x of the shaft.
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
    rows: tuple[Row, ...]
    axis: str = ""
    second_axis: bool = False
    coordinates: tuple[str, ...] = ()
    shapes: tuple[str, ...] = ()


KINDS: Final[dict[str, JointKind]] = {
    "fixed": JointKind("nothing moves", (*_BALL, *_ALIGNED, *_NO_TURN)),
    "revolute": JointKind(
        "turns about its axis", (*_BALL, *_ALIGNED), "axis", False, ("angle",), ("cylinder", "mesh")
    ),
    "spherical": JointKind("turns about its point", _BALL, shapes=("sphere", "mesh")),
    "cylindrical": JointKind(
        "turns about its axis and slides along it",
        (*_ALONG, *_ALIGNED),
        "axis",
        False,
        ("angle", "position"),
        ("cylinder", "mesh"),
    ),
    "prismatic": JointKind(
        "slides along its axis", (*_ALONG, *_ALIGNED, *_NO_TURN), "axis", False, ("position",)
    ),
    "universal": JointKind("turns about an axis of each body", (*_BALL, (DIRECTION, 2, 0)), "axis", True),
    "pin-slot": JointKind(
        "a ball that slides along a pin",
        _ALONG,
        "axis of the pin",
        False,
        ("position",),
        ("ball", "cylinder"),
    ),
    "planar": JointKind(
        "slides and turns in a plane", (_BALL[2], *_ALIGNED), "normal of the plane", False, ("angle",)
    ),
    "spring-damper": JointKind("moves against six stiffnesses", (), coordinates=("angle", "position")),
}
"""Every kind of joint by its name."""

NEEDED: Final = {
    "cylinder": {"radius": "its radius", "radial": "its clearance", "length": "the length of the bore"},
    "sphere": {"radius": "its radius", "radial": "its clearance"},
    "ball": {"radius": "its radius", "radial": "its clearance"},
    "mesh": {"facets": 'triangles, such as mesh = "socket.stl"', "gap": "its gap"},
}
"""Keys that each shape needs, with what they are."""

GROUND: Final = "ground"
"""Name of the body that never moves."""
