"""Self-checks of a run of the journal, in plain words."""

from __future__ import annotations

from collections.abc import Mapping

from tribodyn.joints import BushingJoint
from tribodyn.mechanisms.checks import ENERGY_LIMIT, TIGHTEN, of_contact, of_load, of_steps


def warnings(
    extremes: Mapping[str, float],
    joint: BushingJoint,
    load: Mapping[str, float],
    *,
    residual: float,
    grid_error: float,
    t_end: float,
    statistics: Mapping[str, float],
    when: str,
) -> list[str]:
    """Return the warnings on a run, one sentence each.

    Parameters
    ----------
    extremes
        Of the joint over all accepted steps.
    joint
        The bushing.
    load
        From :func:`tribodyn.mechanisms.bushing.loading`.
    residual
        Energy residual as a fraction.
    grid_error
        Largest error of the contact force on the run's grid, as a fraction.
    t_end
        Simulated time reached [s].
    statistics
        As for :func:`tribodyn.mechanisms.checks.of_steps`.
    when
        When the contact pressure was largest, in words.
    """
    messages = [
        f"Energy is missed: {100 * residual:.2g} % of all in the balance. {TIGHTEN}"
        if not residual <= ENERGY_LIMIT
        else "",
        *of_contact(
            joint.touch,
            separation=extremes["separation_least"],
            clipped=extremes["tensile_clip_time"] / t_end if t_end > 0.0 else 0.0,
            grid_error=grid_error,
            grid=(joint.grid.theta, joint.grid.z),
        ),
        *of_load(load, when),
        *of_steps(statistics),
    ]
    return [message for message in messages if message]
