"""Warnings on runs of any mechanism, and why a run stopped where the model of a joint no longer held."""

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.kernels.film.data import CONVERGED
from tribodyn.kernels.mechanism.data import INTACT, OPENED, OVERLAPPED, Now
from tribodyn.lubrication import explain
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanisms.self_checks import ENERGY_LIMIT, beyond_law, of_steps

GAP_LIMIT: Final = 1.0e-9
"""Residual of a constraint, in m or rad, below which nobody sees it."""
_TIGHTEN: Final = "Tighten solver.rtol tenfold."


def of_balance(energy: float, gaps: FloatArray) -> list[str]:
    """Return remarks on energy and constraints; empty texts without any.

    Parameters
    ----------
    energy
        What the energy balance misses, as a fraction of its largest term.
    gaps
        Largest residual of a constraint over time [m or rad], shape (n_t,).
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

    Parameters
    ----------
    problem
        What was integrated.
    model
        The mechanism as drawn.
    surfaces
        Names of the surfaces of all joints with clearance, as ``joint:surface``.
    t_end
        Simulated time reached [s].
    """
    now: Now = problem.memory.now
    broken, at = int(now.course.broken), int(now.course.broken_at)
    if broken == INTACT:
        return _of_films(problem.memory.oil["status"], model, t_end)
    if broken == OPENED:
        return f"stopped at t = {t_end:.6g} s: {_opened(now, model, at)}"
    joint, surface = surfaces[at].rsplit(":", 1)
    if broken == OVERLAPPED:
        h_first = float(problem.data.contact.surfaces[at]["h_first"])
        return beyond_law(h_first, t_end, f"joint {joint} ({surface})")
    return f"stopped at t = {t_end:.6g} s: {_left(problem, model, joint, at)}"


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
