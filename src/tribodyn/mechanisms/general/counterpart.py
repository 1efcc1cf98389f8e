"""The ideal counterpart of a mechanism with clearance: what it is as the clearances vanish."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from tribodyn.mechanisms.general.description import Description, Joint

_HELD: Final = {"sphere": "spherical", "ball": "pin-slot"}
"""Ideal joint that holds what a shape holds; a mesh holds what the type does."""


def counterpart(description: Description) -> Description:
    """Return the mechanism in which every joint with clearance is the ideal one that holds the same."""
    return replace(description, joints=tuple(map(ideal, description.joints)))


def as_drawn(description: Description) -> Description:
    """Return the mechanism in which every joint is the ideal one of its type."""
    return replace(description, joints=tuple(replace(joint, clearance=None) for joint in description.joints))


def ideal(joint: Joint) -> Joint:
    """Return the ideal joint that holds what a joint with clearance holds."""
    if joint.clearance is None:
        return joint
    sizes, shape = joint.clearance.sizes, joint.clearance.shape
    if shape == "cylinder":
        kind = "revolute" if any(name.startswith("axial") for name in sizes) else "cylindrical"
    else:
        kind = _HELD.get(shape, joint.kind)
    return replace(joint, kind=kind, clearance=None)


def has_loops(description: Description) -> bool:
    """Tell whether joints close a loop, through the ground or not, or elements do; else all can close."""
    if description.elements:
        return True
    group = list(range(-1, len(description.bodies)))

    def root(body: int) -> int:
        while group[body + 1] != body:
            body = group[body + 1]
        return body

    for joint in description.joints:
        first, second = map(root, joint.bodies)
        if joint.kind != "spring-damper":
            if first == second:
                return True
            group[first + 1] = second
    return False
