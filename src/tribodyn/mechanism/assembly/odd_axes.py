"""Axes that do not belong to the plane in which the other joints of a mechanism move."""

import math
from collections.abc import Mapping
from typing import Final

from tribodyn.cases.case import dot, unit
from tribodyn.cases.fields import Vector
from tribodyn.mechanism.model.parts import JointKeys

_ALIKE: Final = 1.0e-6  #: Sine of the angle up to which two axes count as parallel, or as perpendicular.
_PARALLEL: Final = "revolute"
_ACROSS: Final = "prismatic"


def odd_axes(joints: Mapping[str, JointKeys]) -> str:
    """Return the axes that prevent a planar motion, as words that follow a message; empty otherwise.

    Most revolute joints of a planar mechanism have parallel axes. The other axes of revolute joints, and
    those of prismatic joints that are not perpendicular to them, are named with their angle.
    """
    axes = {name: unit(keys.axis, "axis") for name, keys in joints.items() if keys.axis is not None}
    turning = [name for name in axes if joints[name].type == _PARALLEL]
    groups = [[other for other in turning if _sine(axes[name], axes[other]) <= _ALIKE] for name in turning]
    plane = max(groups, key=len, default=[])
    if len(plane) < 2 or 2 * len(plane) <= len(turning):
        return ""
    normal = axes[plane[0]]
    words = [
        f"the axis of {name} is not parallel to that of {_listed(plane)}, by "
        f"{_in_degrees(_sine(normal, axes[name]))}"
        for name in turning
        if name not in plane
    ]
    words += [
        f"the axis of {name} is not perpendicular to that of {_listed(plane)}, by "
        f"{_in_degrees(abs(dot(normal, axes[name])))}"
        for name in axes
        if joints[name].type == _ACROSS and abs(dot(normal, axes[name])) > _ALIKE
    ]
    return "".join(f"; {one}" for one in words)


def _sine(a: Vector, b: Vector) -> float:
    return math.sqrt(max(0.0, 1.0 - dot(a, b) ** 2))


def _in_degrees(sine: float) -> str:
    return f"{math.degrees(math.asin(min(sine, 1.0))):.3g} deg"


def _listed(names: list[str]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}"
