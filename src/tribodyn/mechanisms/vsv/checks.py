"""What a run of the vane mechanism says about its own trustworthiness, in plain words."""

from __future__ import annotations

import math
from collections.abc import Mapping

from tribodyn.mechanisms.checks import ENERGY_LIMIT, TIGHTEN, of_contact, of_steps
from tribodyn.mechanisms.vsv.parameters import Vsv


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
        From :func:`tribodyn.mechanisms.bushing.grid_force_error`.
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
