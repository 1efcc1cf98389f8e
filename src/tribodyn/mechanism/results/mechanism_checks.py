"""Warnings on runs of any mechanism: slow sliding, joints whose model ended, and why a run stopped."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.problem import Problem
from tribodyn.joints.clearances import Clearance, Place
from tribodyn.joints.shapes import Sphere
from tribodyn.kernels.film.data import CONVERGED
from tribodyn.kernels.mechanism.data import INTACT, OPENED, OVERLAPPED, Now
from tribodyn.lubrication import explain
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.joint_friction import JointFriction
from tribodyn.mechanisms.self_checks import ENERGY_LIMIT, beyond_law, of_steps

_DEVELOPED: Final = 5.0  #: Sliding speed over the slip velocity from which on friction is developed.
_SHARE: Final = 0.05  #: Share of the sliding distance below it that is reported.


def of_slow_sliding(
    model: Model, places: Sequence[Place], times: FloatArray, rows: Mapping[str, FloatArray]
) -> list[str]:
    """Return the joints of which much of the sliding is slower than friction is developed, in words.

    ``places``: surfaces of all joints with clearance; ``times``: of the rows [s], shape (n_t,); ``rows``:
    observed of all couplings, shape (n_t, n_couplings) or (n_t, n_couplings, size) each.
    """
    found: list[str] = []
    if model.case.friction.rest:
        return found
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


GAP_LIMIT: Final = 1.0e-9  #: Residual of a constraint, in m or rad, below which nobody sees it.
_TIGHTEN: Final = "Tighten solver.rtol tenfold."


def of_balance(energy: float, gaps: FloatArray) -> list[str]:
    """Return remarks on energy and constraints; empty texts without any.

    ``energy``: what the energy balance misses, as a fraction of its largest term; ``gaps``: largest residual
    of a constraint over time [m or rad], shape (n_t,).
    """
    if math.isnan(energy):
        return [
            "Energy could not be accounted for to the end. Do not use what follows the last finite "
            "energy_residual."
        ]
    gap = float(np.max(gaps, initial=0.0))
    return [
        f"Energy is missed: {100 * energy:.2g} % of the largest term. {_TIGHTEN}"
        if energy > ENERGY_LIMIT
        else "",
        f"Ideal joints came apart by up to {gap:.2g} m or rad. {_TIGHTEN}" if gap > GAP_LIMIT else "",
    ]


def of_start(asked: str, began: Mapping[str, str]) -> list[str]:
    """Return a remark on a start in equilibrium that was requested and not found."""
    if began.get("start") != "centred" or asked == "centred":
        return []
    return [
        "No place was found in which the loads on all shafts balance within the range of the contact law, so "
        "they start in the middle of their sockets, and first impacts are those of the start. Is there a "
        "shaft that nothing holds along its axis, or a joint too small for its load?"
    ]


def messages(*parts: Sequence[str], cost: Mapping[str, float]) -> list[str]:
    """Return all messages, those on the integration last."""
    return [message for part in (*parts, of_steps(cost)) for message in part if message]


def failure(problem: Problem, model: Model, surfaces: Sequence[str], t_end: float) -> str:
    """Return the failures of joints in words; empty where all are intact.

    ``problem``: what was integrated; ``model``: the mechanism as drawn; ``surfaces``: names of the surfaces
    of all joints with clearance, as ``joint:surface``; ``t_end``: simulated time reached [s].
    """
    now: Now = problem.memory.now
    broken, at = int(now.course.broken), int(now.course.broken_at)
    if broken == INTACT:
        return _of_reactions(now, model, t_end) or _of_films(problem.memory.oil["status"], model, t_end)
    if broken == OPENED:
        return f"stopped at t = {t_end:.6g} s: {_opened(now, model, at)}"
    joint, surface = surfaces[at].rsplit(":", 1)
    if broken == OVERLAPPED:
        h_first = float(problem.data.contact.surfaces[at]["h_first"])
        return beyond_law(h_first, t_end, f"joint {joint} ({surface})", advice=model.yielding(joint))
    return f"stopped at t = {t_end:.6g} s: {_left(problem, model, joint, at)}"


def _of_reactions(now: Now, model: Model, t_end: float) -> str:
    """Return the element whose friction did not agree with the reaction that it follows."""
    missed = np.abs(now.couplings["missed"])
    if not math.isnan(now.x[0, 0]) or not np.isfinite(missed).all() or not missed.any():
        return ""
    name, bodies = model.constraint(int(np.argmax(missed)))
    return (
        f"stopped at t = {t_end:.6g} s: {name} between {' and '.join(bodies)} locks itself: "
        "its friction grows faster than the reaction that it follows; give less friction, or its load"
    )


def _of_films(statuses: FloatArray, model: Model, t_end: float) -> str:
    """Return the film without a solution at some trial state, and the reason."""
    for number, status in zip(model.oiled, statuses, strict=True):
        if status != CONVERGED:
            words = f"the oil film of joint {model.joints[number]} had no answer: {explain(int(status))}"
            return f"stopped at t = {t_end:.6g} s: {words}"
    return ""


def _opened(now: Now, model: Model, number: int) -> str:
    """Return that an ideal joint, or an element, came apart."""
    name, bodies = model.constraint(number)
    between = " and ".join(bodies)
    gap = float(np.max(np.abs(now.couplings[number].residual)))
    return (
        f"{name} between {between}, which is ideal, came apart by {gap:.2g} m or rad: "
        "the bodies cannot go on as they move, so look for a position in which the mechanism locks"
    )


def _left(problem: Problem, model: Model, name: str, surface: int) -> str:
    """Return that a shaft has left its socket."""
    joint, d = model.case.joints[name], problem.memory.now.couplings[model.joints.index(name)].pose.d
    socket, shaft = joint.between if joint.sign > 0.0 else joint.between[::-1]
    across, along = problem.data.contact.surfaces[surface]["reach"]
    off, reach, way = float(portable.hypot(d[0], d[1])), across, "across"
    if abs(float(d[2])) > along:
        off, reach, way = abs(float(d[2])), along, "along"
    hold = f'; joints.{name}.clearance.axial = "50 um" would hold it' if joint.type == "revolute" else ""
    return (
        f"the pin of {shaft} has left its bore in {socket}, joint {name}: it is displaced by "
        f"{1e3 * off:.4g} mm {way} the axis, and the bore reaches {1e3 * reach:.4g} mm{hold}"
    )
