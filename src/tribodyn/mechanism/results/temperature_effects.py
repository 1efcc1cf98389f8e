"""Temperatures in joints: their effect on clearances, and flash temperatures of conductors that are known.

The pressure is largest where the gap is least. There, a node at x of a shaft that moves with v and ω slides
at the part of v + ω × x that is tangential to the surface.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.signals import begun
from tribodyn.joints.clearances import Clearance, Place
from tribodyn.joints.point_contact import Touch
from tribodyn.joints.shapes import Surface
from tribodyn.kernels import dense
from tribodyn.kernels.joints.surface.data import GAP, SurfaceData
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of, material_of
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.run_keys import ROWS
from tribodyn.mechanisms.bushing import of_clearances, of_heat
from tribodyn.mechanisms.flash import flash_of, has_conductors
from tribodyn.mechanisms.self_checks import named
from tribodyn.wear import loaded_depth

_FRICTION: Final = "joint.friction_coefficient"  #: Name of the friction of a joint in tables of properties.


def opens(model: Model) -> list[bool]:
    """Return of each joint with clearance whether it follows temperatures over time."""
    return [any(opening is not None for opening in real.openings) for real in model.clearances.values()]


def from_time(model: Model, time: float) -> Model:
    """Return a mechanism whose clearances are those of its temperatures from a time on [s]."""
    if time == 0.0:
        return model
    clearances = {}
    for name, real in model.clearances.items():
        radial, axial = (None if one is None else begun(one, time) for one in real.openings)
        clearances[name] = replace(real, openings=(radial, axial))
    return replace(model, clearances=clearances)


def openings(model: Model, t: FloatArray) -> FloatArray:
    """Return the growth of radial clearances and plays by temperature at times [m], shape (n_t, n, 2).

    The joints are those with clearance.
    """
    found = np.zeros((t.size, len(model.clearances), 2))
    for k, real in enumerate(model.clearances.values()):
        for which, opening in enumerate(real.openings):
            if opening is not None:
                found[:, k, which] = opening(t)
    return found


def radial_clearances(model: Model, t: FloatArray) -> dict[str, FloatArray]:
    """Return the radial clearances of all joints over time [m], by name; nothing where all are constant."""
    if not any(opens(model)):
        return {}
    found = np.full((t.size, len(model.joints)), np.nan)
    at_start = np.array([real.shape.clearance for real in model.clearances.values()])
    found[:, model.real] = at_start + openings(model, t)[..., 0]
    return {"radial_clearance": found}


def of_temperatures(model: Model) -> list[str]:
    """Return the clearances and materials that differ at the temperatures of the run, in words."""
    over_time = radial_clearances(model, np.linspace(0.0, model.case.duration, ROWS))
    messages = []
    for number, (name, hot) in zip(model.real, model.clearances.items(), strict=True):
        keys = model.case.joints[name].real
        assert keys is not None
        if hot.openings[0] is not None:
            own = over_time["radial_clearance"][:, number]
            messages += named(name, [of_clearances(float(own[0]), float(own[-1]), float(own.min()))])
        elif keys.radial is not None:
            found = keys.temperature.properties_at_start
            kept = {path: ends for path, ends in found.items() if path != _FRICTION}
            if _FRICTION in found and found[_FRICTION][1] == keys.friction_coefficient:
                kept[_FRICTION] = found[_FRICTION]
            messages += named(name, [of_heat(keys.radial, hot.shape.clearance, kept)])
    return messages


def depth_of(data: SurfaceData, places: Sequence[Place]) -> FloatArray:
    """Return the wear depth that a run was made with, at the nodes of all joints [m], shape (n_nodes,)."""
    drawn = np.concatenate([np.empty(0), *(place.surface.gap for place in places)])
    return np.asarray(data.nodes[GAP] - drawn)


def worn_model(model: Model, places: Sequence[Place], depth: FloatArray | None) -> Model:
    """Return a mechanism with the roughness that its joints have at a wear depth.

    ``model``: the mechanism as drawn; ``places``: where the surfaces of its joints lie among all nodes;
    ``depth``: wear depth at the nodes [m], shape (n_nodes,); None for none.
    """
    if not model.case.wear.running_in or depth is None or not depth.any():
        return model
    depths = {}
    for number, name in enumerate(model.clearances):
        own = [place for place in places if place.joint == number]
        area = np.concatenate([place.surface.area for place in own])
        depths[name] = loaded_depth(depth[own[0].nodes.start : own[-1].nodes.stop], area)
    return replace(model, clearances=clearances_of(model.case, depths))


def least_roughness(case: MechanismCase) -> float:
    """Return the least combined rms roughness that a joint with clearance comes to [m]; 1 without any."""
    worn = math.inf if case.wear.running_in else 0.0
    real = [name for name, joint in case.joints.items() if joint.real is not None]
    pairs = [material_of(case, name, worn) for name in real]
    return min((pair.surface_pair.roughness_rms for pair in pairs), default=1.0)


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
