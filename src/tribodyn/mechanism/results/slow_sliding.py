"""Share of a dynamic run that slides so slowly that its friction is not developed.

Friction of joints is regularised: at the slip velocity it has 71 % of its size, at five times that 98 %.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.clearances import Clearance, Place
from tribodyn.joints.shapes import Sphere
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.joint_friction import JointFriction

_DEVELOPED: Final = 5.0
"""Sliding speed over the slip velocity from which on friction is developed."""
_SHARE: Final = 0.05
"""Share of the sliding distance below it that is reported."""


def of_slow_sliding(
    model: Model, places: Sequence[Place], times: FloatArray, rows: Mapping[str, FloatArray]
) -> list[str]:
    """Return the joints of which much of the sliding is slower than friction is developed, in words.

    Parameters
    ----------
    model
        The mechanism.
    places
        Surfaces of all joints with clearance.
    times
        Of the rows [s], shape (n_t,).
    rows
        Observed of all couplings, shape (n_t, n_couplings) or (n_t, n_couplings, size) each.
    """
    found = []
    for joint, slip, speed in _sliding(model, places, rows):
        path = np.abs(speed[:-1]) * np.diff(times)
        slow = float(np.sum(path[np.abs(speed[:-1]) < _DEVELOPED * slip]))
        if slow > _SHARE * float(np.sum(path)):
            share = 100.0 * slow / float(np.sum(path))
            found.append(
                f"{share:.0f} % of the sliding in joint {joint} is below five slip velocities "
                f"of {slip:.3g} m/s: its friction is not developed there; lower slip_velocity, or "
                "run the static analysis"
            )
    return found


def _sliding(
    model: Model, places: Sequence[Place], rows: Mapping[str, FloatArray]
) -> Iterator[tuple[str, float, FloatArray]]:
    """Yield joints with friction, their slip velocity and their sliding speed [m/s], shape (n_t,)."""
    if not {"relative_rate", "relative_velocity", "reaction_force"} <= rows.keys():
        return  # a large model that does not keep them
    spins, velocities = rows["relative_rate"], rows["relative_velocity"]
    for k, (name, clearance) in enumerate(model.clearances.items()):
        if clearance.friction_coefficient > 0.0 and clearance.film is None:
            surface = next(place.surface for place in places if place.joint == k)
            number = model.joints.index(name)
            touching = np.linalg.norm(rows["reaction_force"][:, number], axis=-1) > 0.0
            speed = _speed(clearance, surface.position, spins[:, number], velocities[:, number])
            yield name, clearance.slip_velocity, speed * touching
    for element in model.elements:
        keys = element.keys
        if isinstance(keys, JointFriction) and keys.friction_coefficient > 0.0:
            number = model.joints.index(keys.joint)
            along = velocities[:, number, 2] if keys.radius is None else keys.radius * spins[:, number, 2]
            yield keys.joint, keys.slip_velocity, along


def _speed(clearance: Clearance, position: FloatArray, spin: FloatArray, velocity: FloatArray) -> FloatArray:
    if isinstance(clearance.shape, Sphere):
        return np.asarray(np.linalg.norm(spin, axis=1) * np.max(np.linalg.norm(position, axis=1)))
    radius = float(np.max(np.hypot(position[:, 0], position[:, 1])))
    return np.hypot(radius * spin[:, 2], velocity[:, 2])
