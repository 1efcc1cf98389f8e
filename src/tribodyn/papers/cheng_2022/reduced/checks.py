"""Energy balances and self-checks of a run of the vane mechanism, in plain words."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.mechanisms import self_checks
from tribodyn.papers.cheng_2022.reduced.drives import run_segments
from tribodyn.papers.cheng_2022.reduced.parameters import Vsv
from tribodyn.views.energy_balance import EnergyBalance, EnergyTerm, energy_columns

WHOLE: Final = EnergyBalance(
    title="Whole mechanism",
    put_in={
        "energy_drive": "drive work, in",
        "energy_loads": "load work, in",
        "energy_expansion": "expansion, in",
    },
    gained={
        "energy_kinetic": "kinetic",
        "energy_gravity": "gravity",
        "energy_contact": "stored in contact",
        "energy_friction": "bushing friction, out",
        "energy_collar_friction": "collar friction, out",
        "energy_collar_tilt": "collar tilt, out",
        "energy_damping": "contact damping, out",
    },
    residual="energy_residual",
    measure=("energy_drive", "energy_loads", "energy_friction"),
    attribute="energy_residual",
    yardstick="largest term",
)
CLEARANCE: Final = EnergyBalance(
    title="Motion in the clearance alone",
    put_in={"energy_clearance_loads": "loads and reactions, in", "energy_expansion": "expansion, in"},
    gained={
        "energy_clearance_inertia": "inertia",
        "energy_clearance_contact": "stored in contact",
        "energy_clearance_friction": "friction, out",
        "energy_clearance_collar": "collar, out",
        "energy_clearance_damping": "contact damping, out",
    },
    residual="energy_clearance_residual",
    measure=("energy_clearance_contact", "energy_clearance_damping"),
    attribute="clearance_energy_residual",
    yardstick="largest contact term",
)
BALANCES: Final = (WHOLE, CLEARANCE)


TERMS: Final = {
    "energy_kinetic": EnergyTerm("energy_kinetic"),
    "energy_contact": EnergyTerm("energy_contact"),
    "energy_gravity": EnergyTerm("energy_gravity", since_start=True),
    "energy_drive": EnergyTerm("work_drive"),
    "energy_loads": EnergyTerm("work_loads"),
    "energy_friction": EnergyTerm("work_friction", -1.0),
    "energy_collar_friction": EnergyTerm("work_collar_friction", -1.0),
    "energy_collar_tilt": EnergyTerm("work_collar_tilt", -1.0),
    "energy_damping": EnergyTerm("heat_damping"),
    "energy_clearance_inertia": EnergyTerm("work_clearance_inertia"),
    "energy_clearance_loads": EnergyTerm("work_clearance_loads"),
    "energy_clearance_contact": EnergyTerm("energy_contact", since_start=True),
    "energy_clearance_friction": EnergyTerm("work_clearance_friction", -1.0),
    "energy_clearance_collar": EnergyTerm("work_clearance_collar", -1.0),
    "energy_clearance_damping": EnergyTerm("heat_damping"),
}


def balance_columns(rows: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    expansion = {"energy_expansion": EnergyTerm("work_expansion")} if rows["work_expansion"].any() else {}
    return energy_columns(rows, TERMS | expansion, BALANCES)


#: Why a run in ``paper`` or ``printed`` may leave the range of the contact law: see the manual, two energy
#: balances.
GAINS_ENERGY: Final = (
    "the equations of formulation {!r} can gain energy in an impact, with damping and at small loads too; "
    "compare with mechanism.formulation = 'exact'"
)


def warnings(
    vsv: Vsv,
    found: Mapping[str, float],
    whole: float,
    clearance: float,
    t_end: float,
    statistics: Mapping[str, float],
    when: str,
) -> list[str]:
    """Return the warnings on a run, one sentence each.

    ``found``: extremes, error of the grid and loading of the joint, by the names of attributes; ``whole``,
    ``clearance``: energy residuals as fractions; ``t_end``: simulated time reached [s]; ``statistics``: cost
    of the integration, by the names of :class:`~tribodyn.core.problem.Statistics`; ``when``: when the contact
    pressure was largest, in words.
    """
    share = lift_off_share(found, t_end)
    messages = [
        _energy_message(vsv, whole, clearance),
        *self_checks.of_contact(
            vsv.joint.touch,
            separation=found["separation_least"],
            clipped=found["tensile_clip_time"] / t_end if t_end > 0.0 else 0.0,
            grid_error=found["grid_force_error"],
            grid=(vsv.joint.grid.theta, vsv.joint.grid.z),
        ),
        *self_checks.of_load(found, when),
        self_checks.of_lift_off(share) if share > self_checks.LIFT_OFF_LIMIT else "",
        *self_checks.of_steps(statistics),
    ]
    return [message for message in messages if message]


def notes(
    vsv: Vsv, found: Mapping[str, float], pressure: float, t_end: float, turns: FloatArray, carried: bool
) -> list[str]:
    """Return notes on numbers that are valid, one sentence each.

    ``vsv``, ``found``, ``t_end``: as for :func:`warnings`; ``pressure``: largest contact pressure [Pa];
    ``turns``: times of the start and of the reversals that were reached [s]; ``carried``: whether the start
    is a reversal, because the run continues from another one.
    """
    share = lift_off_share(found, t_end)
    messages = [
        "" if vsv.exact else f"T{GAINS_ENERGY.format(vsv.formulation)[1:]}.",
        self_checks.of_lift_off(share) if 0.0 < share <= self_checks.LIFT_OFF_LIMIT else "",
        self_checks.of_damping_pressure(pressure, found["pressure_at_rest"]),
        _of_reversals(vsv, t_end, turns, carried),
    ]
    return [message for message in messages if message]


def lift_off_share(found: Mapping[str, float], t_end: float) -> float:
    """Return the share of the run during which the thrust collar carried nothing."""
    return found["collar_lift_off_time"] / t_end if t_end > 0.0 else 0.0


def _of_reversals(vsv: Vsv, t_end: float, turns: FloatArray, carried: bool) -> str:
    """Report the reversals of a drive cycle that the run does not hold with their impacts."""
    period = vsv.drive.period
    cycle = run_segments(vsv, period)
    ends = cycle.segments.direction[[0, -1]]
    every = cycle.turns if ends[0] == ends[1] else np.concatenate([[0.0], cycle.turns])
    return self_checks.of_reversals(every, turns, period=period, t_end=t_end, carried=carried)


def _energy_message(vsv: Vsv, whole: float, clearance: float) -> str:
    """Say that the balances do not close, and why."""
    if math.isnan(whole + clearance):
        return (
            "Energy could not be accounted for to the end: on its way the motion went through a state that "
            "the mechanism cannot have. Do not use what follows the last finite energy_residual."
        )
    if max(whole, clearance) <= self_checks.ENERGY_LIMIT:
        return ""
    numbers = f"Energy is missed: {100 * whole:.2g} % of the whole mechanism's, {100 * clearance:.2g} % of"
    if vsv.exact:
        return f"{numbers} the clearance motion's. {self_checks.TIGHTEN}"
    return (
        f"{numbers} the clearance motion's. The paper's equations do not come from one virtual work, so "
        "their energy balance cannot close; mechanism.formulation = 'exact' does."
    )
