"""Flash temperatures of the joints of a mechanism, where the conductors of heat are known.

The pressure is largest where the gap is least. There, a node at x of a shaft that moves with v and ω slides
at the part of v + ω × x that is tangential to the surface.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.clearances import Clearance, Place
from tribodyn.joints.shapes import Surface
from tribodyn.joints.touch import Touch
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanisms.flash import flash_of, has_conductors


def flash_temperatures(
    model: Model, places: Sequence[Place], touches: Sequence[Touch], rows: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return the flash temperature of each joint where pressure times speed was largest, by name.

    ``model``: the mechanism, its joints as they are in the run; ``places``, ``touches``: the surfaces of all
    joints with clearance, and both sides of each; ``rows``: observed of all couplings, shape (n_t,
    n_couplings) or (n_t, n_couplings, size) each. Returns ``flash_temperature`` [K], shape (n_joints,), NaN
    where it is not known; nothing where it nowhere is.
    """
    found = np.full(len(model.joints), np.nan)
    for k, (name, clearance) in enumerate(model.clearances.items()):
        first = next(s for s, place in enumerate(places) if place.joint == k)
        own = [place.surface for place in places if place.joint == k]
        number = model.joints.index(name)
        of_joint = {key: values[:, number] for key, values in rows.items()}
        found[number] = _of_joint(model.case, name, clearance, own, touches[first], of_joint)
    return {"flash_temperature": found} if np.isfinite(found).any() else {}


def _of_joint(
    case: MechanismCase,
    name: str,
    clearance: Clearance,
    surfaces: Sequence[Surface],
    touch: Touch,
    rows: Mapping[str, FloatArray],
) -> float:
    """Return the flash temperature of one joint [K]."""
    keys, pressure = case.joints[name].real, rows["pressure_max"]
    assert keys is not None
    material = case.of_pair(keys).surfaces
    if not (has_conductors(material) and touch.over_surface and pressure.size):
        return math.nan
    row, speed = _hottest(surfaces, rows)
    return flash_of(
        material,
        clearance.law,
        touch,
        friction_coefficient=clearance.friction_coefficient,
        pressure=float(pressure[row]),
        separation=float(rows["gap_min"][row]),
        speed=speed,
    )


def _hottest(surfaces: Sequence[Surface], rows: Mapping[str, FloatArray]) -> tuple[int, float]:
    """Return the row where pressure times speed of sliding was largest, and that speed [m/s].

    Rows are looked at in the order of an upper bound of it, so that few of them need their nodes.
    """
    reach = max(float(np.linalg.norm(surface.position, axis=1).max()) for surface in surfaces)
    speed, turning = (np.linalg.norm(rows[key], axis=1) for key in ("relative_velocity", "relative_rate"))
    offset = np.linalg.norm(rows["displacement"], axis=1)
    bound = rows["pressure_max"] * (speed + turning * (reach + offset))
    best, found = 0.0, (int(np.argmax(bound)), 0.0)
    for row in np.argsort(-bound).tolist():
        if bound[row] <= best:
            break
        sliding = _sliding(surfaces, {key: values[row] for key, values in rows.items()})
        if rows["pressure_max"][row] * sliding > best:
            best, found = float(rows["pressure_max"][row] * sliding), (row, sliding)
    return found


def _sliding(surfaces: Sequence[Surface], row: Mapping[str, FloatArray]) -> float:
    """Return the speed of sliding at the node of the least gap [m/s]."""
    phi = np.array([row["tilt_x"], row["tilt_y"], 0.0])
    d, v, w = row["displacement"], row["relative_velocity"], row["relative_rate"]
    least, sliding = math.inf, 0.0
    for surface in surfaces:
        # On a surface that slides, nodes stay with the socket: see kernels/joints/surface/station.py.
        z = float(d[2]) if surface.slides else 0.0
        u = np.array([phi[1], -phi[0], 1.0])
        near = np.einsum("ij,ij->i", surface.normal, (d - z * u) + np.cross(phi, surface.position))
        k = int(np.argmin(surface.gap - near))
        if surface.gap[k] - near[k] < least:
            least, n = float(surface.gap[k] - near[k]), surface.normal[k]
            slip = v - z * np.cross(w, u) + np.cross(w, surface.position[k])
            sliding = float(dense.norm(slip - n * (dense.product(n, slip))))
    return sliding
