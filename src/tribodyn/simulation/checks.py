"""What a run says about its own trustworthiness, in plain words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints import SURFACE, BushingJoint, Grid
from tribodyn.joints.bushing import joint_wrench
from tribodyn.kernels.vsv.data import VsvMemory
from tribodyn.mechanisms.vsv import Vsv
from tribodyn.wear import resampled

ENERGY_LIMIT: Final = 0.01
GRID_LIMIT: Final = 0.005
CLIP_LIMIT: Final = 0.02
REJECTED_LIMIT: Final = 0.2
"""Share of rejected steps among those tried; built-in cases and rough variations of them have 1 to 6 %."""
RESTART_LIMIT: Final = 0.05
"""Restarts over steps. The order grows step by step: twenty are few to get beyond the low ones."""
TIGHTEN: Final = "Tighten solver.rtol and all of solver.atol tenfold."
"""What makes ledgers close: absolute tolerances alone hold small slips and long ringing."""
_SAMPLES: Final = 24


def peaks(memory: VsvMemory) -> dict[str, float]:
    """Return the peaks over all accepted steps by name, SI units."""
    records = (memory.joint.peaks, memory.collar)
    return {name: float(record[name]) for record in records for name in record.dtype.names}


def grid_force_error(
    joint: BushingJoint, rows: Mapping[str, FloatArray], wear: FloatArray | None = None
) -> float:
    """Return the largest error of the contact force on the run's grid against one four times finer [1].

    Taken at some of the run's own attitudes, without their velocities, relative to the largest force.

    Parameters
    ----------
    joint
        The joint on the run's grid.
    rows
        Columns of the run, of which the attitudes are used.
    wear
        Wear depth at the nodes during the run [m], shape (n_z + 2, n_theta); none by default.
    """
    n_rows = rows["e_x"].size
    if not n_rows:
        return 0.0
    finer = replace(joint, grid=Grid(4 * joint.grid.theta, 4 * joint.grid.z))
    fine = finer.data(None if wear is None else resampled(wear, joint.z, finer.z, finer.grid.theta))
    coarse = joint.data(wear)
    largest = error = 0.0
    for i in np.unique(np.linspace(0, n_rows - 1, _SAMPLES).astype(int)):
        y = np.zeros(8)
        y[:4] = [rows[name][i] for name in ("e_x", "e_y", "phi_x", "phi_y")]
        exact = joint_wrench(fine, y)[:2]
        largest = max(largest, float(np.hypot(*exact)))
        error = max(error, float(np.hypot(*(joint_wrench(coarse, y)[:2] - exact))))
    return error / largest if largest > 0.0 else 0.0


def warnings(
    vsv: Vsv,
    found: Mapping[str, float],
    whole: float,
    clearance: float,
    grid_error: float,
    t_end: float,
    statistics: Mapping[str, float],
) -> list[str]:
    """Return what a user should know before trusting the numbers, one sentence each.

    Parameters
    ----------
    vsv
        The mechanism.
    found
        From :func:`peaks`.
    whole, clearance
        Energy residuals as fractions.
    grid_error
        From :func:`grid_force_error`.
    t_end
        Simulated time reached [s].
    statistics
        Cost of the integration, by the names of :class:`~tribodyn.core.problem.Statistics`.
    """
    lift_off = found["collar_lift_off_time"]
    messages = [
        _energy_message(vsv, whole, clearance),
        *of_contact(
            vsv.joint,
            separation=found["separation_least"],
            clipped=found["tensile_clip_time"] / t_end if t_end > 0.0 else 0.0,
            grid_error=grid_error,
        ),
        f"The thrust collar carried nothing for {1e3 * lift_off:.3g} ms: "
        "lift-off of the vane is not modelled."
        if lift_off > 0.0
        else "",
        *of_steps(statistics),
    ]
    return [message for message in messages if message]


def of_contact(joint: BushingJoint, *, separation: float, clipped: float, grid_error: float) -> list[str]:
    """Return what is to be said of a contact, whatever is joined by it; empty texts where nothing is.

    Parameters
    ----------
    joint
        The bushing.
    separation
        Least distance of the mean planes [m].
    clipped
        Share of the contact area where the tensile clip acts, mean over time.
    grid_error
        From :func:`grid_force_error`.
    """
    depth = separation / joint.roughness
    surface = joint.contact == SURFACE
    return [
        f"On the chosen grid the contact force is off by up to {100 * grid_error:.2g} %: raise solver.grid."
        if grid_error > GRID_LIMIT
        else "",
        f"The mean planes of the surfaces came within {depth:.2g} sigma of each other: below 0 the "
        "statistical contact law is outside its range."
        if depth < 0.0 and surface
        else "",
        f"The clip of tensile pressure acted on {100 * clipped:.2g} % of the contact area on average: "
        "damping is strong against stiffness there."
        if clipped > CLIP_LIMIT
        else "",
        ""
        if surface
        else "The contact is at a point of each end of the bushing: there is no pressure field and no wear.",
    ]


def of_steps(statistics: Mapping[str, float]) -> list[str]:
    """Return what is to be said of how the integration went; empty texts where nothing is.

    Parameters
    ----------
    statistics
        As for :func:`warnings`.
    """
    steps, rejected, restarts = (statistics[name] for name in ("steps", "rejected", "restarts"))
    return [
        f"The integrator threw away {100 * rejected / (steps + rejected):.2g} % of the steps it tried: "
        "something switches faster than it can follow, and short peaks may be missed. Look for what is sharp "
        "in the case, and see whether a tighter solver.rtol changes the result."
        if rejected > REJECTED_LIMIT * (steps + rejected)
        else "",
        f"The integration started anew every {steps / restarts:.2g} steps: most of them are taken with "
        "low orders. See whether a tighter solver.rtol changes the result."
        if restarts > RESTART_LIMIT * steps > 0.0
        else "",
    ]


def _energy_message(vsv: Vsv, whole: float, clearance: float) -> str:
    """Say that the ledgers do not close, and why."""
    if math.isnan(whole + clearance):
        return (
            "Energy could not be accounted for to the end: on its way the motion went through a state that "
            "the mechanism cannot have. Doubt what follows the last finite energy_residual."
        )
    if max(whole, clearance) <= ENERGY_LIMIT:
        return ""
    numbers = f"Energy is missed: {100 * whole:.2g} % of the whole mechanism's, {100 * clearance:.2g} % of"
    if vsv.exact:
        return f"{numbers} the clearance motion's. {TIGHTEN}"
    return (
        f"{numbers} the clearance motion's. The paper's equations do not come from one virtual work, so "
        "their ledger cannot close; mechanism.formulation = 'exact' does."
    )
