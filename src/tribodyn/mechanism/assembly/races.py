"""Axes of a joint; that of the race of a ball joint follows from the mechanism and turns with it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from tribodyn.cases.case import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanism.frames import GROUND, cross
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.parts import JointKeys

_PARALLEL: Final = 1e-3
"""Sine of an angle below which two directions are taken for one."""


def axes_of(case: MechanismCase, joint: JointKeys) -> FloatArray:
    """Return the two unit vectors of a joint, shape (2, 3); the second is across the first if not given."""
    if not joint.kind.AXIS and joint.clearance is not None and joint.axis is None:
        first, second = _race_axes(case, joint)
    else:
        first, second = np.array(unit(joint.axis or (0.0, 0.0, 1.0), "axis")), None
    if joint.second_axis is not None:
        second = np.array(unit(joint.second_axis, "second_axis"))
    if second is not None:
        return np.array([first, second])
    across = np.eye(3)[int(np.argmin(np.abs(first)))]
    second = across - first * dense.product(first, across)
    return np.array([first, second / dense.norm(second)])


def _race_axes(case: MechanismCase, joint: JointKeys) -> FloatArray:
    """Return axis and direction of angle zero of a joint that has no axis of its own, unit vectors (2, 3).

    The axis is normal to the plane of the joint and the mass centres of its two bodies, so that forces along
    the bodies meet the middle of the race. Where these lie on one line, or one body is the ground, other
    joints of the two bodies take their place, then the rest of the mechanism. Angle zero points to the first
    of these places.
    """
    point = np.array(joint.point)
    first: FloatArray | None = None
    for place in _places(case, joint):
        way = np.array(place) - point
        length = float(dense.norm(way))
        if length == 0.0:
            continue
        if first is None:
            first = way / length
            continue
        normal = cross(first, way / length)
        if dense.norm(normal) > _PARALLEL:
            return np.array([normal / dense.norm(normal), first])
    if first is None:
        return np.eye(3)[[2, 0]]
    across = cross(first, np.eye(3)[int(np.argmin(np.abs(first)))])
    return np.array([across / dense.norm(across), first])


def _places(case: MechanismCase, joint: JointKeys) -> Iterator[tuple[float, float, float]]:
    """Yield the places that the axis may follow from, the nearest relations first."""
    for body in joint.between:
        if body != GROUND:
            yield case.bodies[body].centre
    for other in case.joints.values():
        if (set(other.between) & set(joint.between)) - {GROUND}:
            yield other.point
    yield from (body.centre for body in case.bodies.values())
    yield from (other.point for other in case.joints.values())
