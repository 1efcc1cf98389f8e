"""Why a run of a mechanism stopped, where the model of a joint no longer held."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tribodyn.core.problem import Problem
from tribodyn.kernels.mechanism.data import INTACT, OPENED, OVERLAPPED, Now
from tribodyn.mechanisms.checks import beyond_law
from tribodyn.mechanisms.general.model import Model


def failure(problem: Problem, model: Model, surfaces: Sequence[str], t_end: float) -> str:
    """Return what became of which joint, in words; empty where all are intact.

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
        return ""
    if broken == OPENED:
        return f"stopped at t = {t_end:.6g} s: {_opened(now, model, at)}"
    joint, surface = surfaces[at].rsplit(":", 1)
    if broken == OVERLAPPED:
        h_first = float(problem.data.contact.surfaces[at]["h_first"])
        return beyond_law(h_first, t_end, f"joint {joint} ({surface})")
    return f"stopped at t = {t_end:.6g} s: {_left(problem, model, joint, at)}"


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
    off, reach, way = float(np.hypot(d[0], d[1])), across, "across"
    if abs(float(d[2])) > along:
        off, reach, way = abs(float(d[2])), along, "along"
    hold = f'; joints.{name}.clearance.axial = "50 um" would hold it' if joint.type == "revolute" else ""
    return (
        f"the pin of {shaft} has left its bore in {socket}, joint {name}: it is displaced by "
        f"{1e3 * off:.4g} mm {way} the axis, and the bore reaches {1e3 * reach:.4g} mm{hold}"
    )
