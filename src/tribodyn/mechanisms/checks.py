"""What a run with a bushing says about its own trustworthiness, in plain words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from tribodyn.core.quantities import Record
from tribodyn.joints import SURFACE, BushingJoint

ENERGY_LIMIT: Final = 0.01
GRID_LIMIT: Final = 0.005
HARDNESS_LIMIT: Final = 1.0 / 3.0
"""Peak pressure over hardness: a third of the hardness is about the yield stress of the bulk (D. Tabor, The
hardness of metals, 1951)."""
AREA_LIMIT: Final = 0.1
"""Real area of contact over the nominal one: beyond a few per cent asperities no longer deform one by one,
which every law here takes for granted."""
_DAMPING: Final = 0.05
"""Share of the peak pressure that is damping; below it the grid hardly matters."""
LIFT_OFF_LIMIT: Final = 0.001
"""Share of a run without the thrust collar; below it is only noted."""
CLIP_LIMIT: Final = 0.02
LINER_LIMIT: Final = 0.05
REJECTED_LIMIT: Final = 0.2
"""Share of rejected steps among those tried; built-in cases and rough variations of them have 1 to 6 %."""
RESTART_LIMIT: Final = 0.05
"""Restarts over steps. The order grows step by step: twenty are few to get beyond the low ones."""
TIGHTEN: Final = "Tighten solver.rtol and all of solver.atol tenfold."
"""What makes ledgers close: absolute tolerances alone hold small slips and long ringing."""


def extremes(*records: Record) -> dict[str, float]:
    """Return extremes over all accepted steps by name, SI units, from the records that kernels keep."""
    return {name: float(record[name]) for record in records for name in record.dtype.names}


def beyond_law(joint: BushingJoint, t_end: float) -> str:
    """Return why a run stopped at ``t_end`` [s] that left the range of its contact law."""
    return (
        f"stopped at t = {t_end:.6g} s: the surfaces came closer than the contact law reaches "
        f"({joint.table.h_first:g} sigma); load or impact is too much for it"
    )


def of_load(loading: Mapping[str, float]) -> list[str]:
    """Return what is to be said of the load on the surfaces; empty texts where nothing is.

    Parameters
    ----------
    loading
        From :func:`tribodyn.mechanisms.bushing.loading`.
    """
    hardness, area = loading["hardness_share"], loading["real_area_share"]
    return [
        f"The contact pressure reached {100 * hardness:.2g} % of the hardness: above a third of it the bulk "
        "yields, not asperities alone."
        if hardness > HARDNESS_LIMIT
        else "",
        f"The real area of contact reached {100 * area:.2g} % of the nominal one where the surfaces came "
        f"closest: above {100 * AREA_LIMIT:g} % asperities do not deform one by one, as contact laws have it."
        if area > AREA_LIMIT
        else "",
    ]


def of_damping_pressure(pressure: float, at_rest: float) -> str:
    """Return what is to be said of a peak pressure where surfaces at rest would carry ``at_rest`` [Pa]."""
    if not 0.0 < at_rest < (1.0 - _DAMPING) * pressure:
        return ""
    return (
        f"Surfaces at rest would carry {at_rest * 1e-6:.3g} MPa where the pressure was largest: the rest of "
        f"{pressure * 1e-6:.3g} MPa is damping at single points, and more on a finer grid."
    )


def of_lift_off(share: float) -> str:
    """Return what is to be said of a thrust collar that carried nothing for a share of the run."""
    return f"The thrust collar carried nothing for {100 * share:.2g} % of the run: lift-off is not modelled."


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
        From :func:`tribodyn.mechanisms.bushing.grid_force_error`.
    """
    depth = joint.asperity_separation(separation)
    surface = joint.contact == SURFACE
    return [
        f"On the chosen grid the contact force is off by up to {100 * grid_error:.2g} %: raise solver.grid."
        if grid_error > GRID_LIMIT
        else "",
        f"The mean planes of the surfaces came within {depth:.2g} sigma of each other: below 0 the "
        "statistical contact law is outside its range."
        if depth < 0.0 and surface
        else "",
        *_of_liner(joint, separation),
        f"The clip of tensile pressure acted on {100 * clipped:.2g} % of the contact area on average: "
        "damping is strong against stiffness there."
        if clipped > CLIP_LIMIT
        else "",
        ""
        if surface
        else "The contact is at a point of each end of the bushing: there is no pressure field and no wear.",
    ]


def _of_liner(joint: BushingJoint, separation: float) -> list[str]:
    """Return what is to be said of the layer that the asperities stand on."""
    if joint.liner is None:
        return []
    half_width = joint.contact_half_width(separation)
    return [
        f"Half the contact is {half_width / joint.liner.thickness:.2g} times as wide as its liner is thick: "
        "with this Poisson's ratio that is too little for a thin layer, and pressures are only roughly right."
        if joint.liner.error(half_width) > LINER_LIMIT
        else ""
    ]


def of_steps(statistics: Mapping[str, float]) -> list[str]:
    """Return what is to be said of how the integration went; empty texts where nothing is.

    Parameters
    ----------
    statistics
        Cost of the integration, by the names of :class:`~tribodyn.core.problem.Statistics`.
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
