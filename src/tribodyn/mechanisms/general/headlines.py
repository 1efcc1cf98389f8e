"""Headline numbers of a mechanism: of the whole, and of each joint by its name."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.base import ByPart
from tribodyn.mechanisms.general.ledger import WHOLE
from tribodyn.mechanisms.general.readings import (
    above_zero,
    least,
    of_joint,
    of_surfaces,
    offset,
    partner_share,
    sizes,
    wear_life,
    wear_rate,
)
from tribodyn.results.reading import (
    column,
    in_settled,
    lasting,
    peak,
    period,
    reversals_held,
    settled,
    time_mean,
)
from tribodyn.results.summary import Headline
from tribodyn.results.wear_numbers import WEAR_NUMBERS

_ROUNDING: Final = 1e-9


def _cycles(dataset: xr.Dataset) -> float:
    """Return the number of whole cycles evaluated; NaN for none."""
    whole = math.floor(column(dataset, "time")[-1] / period(dataset) + _ROUNDING)
    return above_zero(whole if in_settled(dataset)[0] else whole - 1)


def _scatter(dataset: xr.Dataset) -> float:
    """Return by how much the largest forces of the cycles looked at differ, of their mean [%]."""
    time, n = settled(dataset, column(dataset, "time")), int(_cycles(dataset))
    force = settled(dataset, sizes(dataset, "reaction_force").max(axis=1))
    edges = np.searchsorted(time, time[0] + period(dataset) * np.arange(1, n))
    found = np.array([part.max() for part in np.split(force, edges)])
    return 100.0 * float(np.ptp(found) / found.mean()) if n > 1 and found.any() else math.nan


def _power(dataset: xr.Dataset) -> float:
    """Return the mean power put in [W]: the rate of stored energy and heat by the energy balance.

    The work itself goes to and fro by many times as much, and the error of its sum over steps with it.
    """
    time = column(dataset, "time")
    gains = np.sum([column(dataset, name) for name in WHOLE.gained if name in dataset.variables], axis=0)
    works = np.ptp(column(dataset, "energy_in")) > _ROUNDING * np.ptp(column(dataset, "energy_kinetic"))
    return float((gains[-1] - gains[0]) / (time[-1] - time[0])) if works else math.nan


def _outside(label: str, unit: str, quantity: str, *, scale: float = 1.0) -> ByPart:
    """Return the largest value outside the impacts after reversals, of one joint or of all of them."""

    def value(dataset: xr.Dataset, joint: str) -> float:
        values = column(dataset, f"{quantity}_outside")
        return above_zero(peak(values[:, of_joint(dataset, joint)] if joint else values)) * scale

    def made(joint: str) -> Headline:
        name = label if joint else f"{label} in a joint"
        number = Headline(
            f"{name}, largest outside impacts",
            unit,
            "Joints" if joint else "Load",
            "Once the impacts after reversals of the drive have died away.",
            lambda d: value(d, joint),
        )
        return number.of_part(joint) if joint else number

    return made


OUTSIDE: Final[dict[str, ByPart]] = {
    "force_outside_N": _outside("Force", "N", "joint_force"),
    "pressure_outside_MPa": _outside("Contact pressure", "MPa", "pressure", scale=1e-6),
    "offset_outside_um": _outside("Offset", "µm", "offset", scale=1e6),
    "drive_moment_outside_Nm": _outside("Drive moment", "N m", "drive_moment"),
}
"""Numbers of mechanisms whose drives reverse, by name."""


def _pair(
    names: tuple[str, str],
    label: str,
    unit: str,
    group: str,
    meaning: str,
    values: Callable[[xr.Dataset], FloatArray],
    *,
    scale: float = 1.0,
) -> dict[str, Headline]:
    """Return the sustained maximum and the peak with impacts, by their names.

    Parameters
    ----------
    names
        Of the two.
    label, unit, group, meaning
        As of a :class:`~tribodyn.results.summary.Headline`; the meaning ends in the share of time.
    values
        The quantities over time, shape (n_t,) or (n_t, n).
    scale
        Their unit over that of the number.
    """
    quiet, loud = names
    return {
        quiet: Headline(
            f"{label}, sustained",
            unit,
            group,
            f"{meaning} for 99 % of the time; impacts excluded.",
            lambda d: above_zero(lasting(d, values(d))) * scale,
        ),
        loud: Headline(
            f"{label}, peak",
            unit,
            group,
            "Largest value at any step of the integration, impacts included.",
            lambda d: above_zero(peak(settled(d, values(d)))) * scale,
            over="cycles",
            span="over {} cycle",
        ),
    }


HEADLINES: Final[dict[str, Headline]] = {
    "reversals": Headline(
        "Reversals held",
        "",
        "Load",
        "Reversals of a drive in this result with the impacts that follow them.",
        reversals_held,
        count=True,
    ),
    "cycles": Headline(
        "Cycles evaluated",
        "",
        "Load",
        "Whole cycles that peaks are taken over; of several, the first is left out as transient.",
        _cycles,
        count=True,
    ),
    **_pair(
        ("joint_force_lasting_N", "joint_force_max_N"),
        "Force in a joint",
        "N",
        "Load",
        "Largest force that any joint carries",
        lambda d: sizes(d, "reaction_force"),
    ),
    **_pair(
        ("pressure_lasting_MPa", "peak_pressure_MPa"),
        "Contact pressure",
        "MPa",
        "Load",
        "Highest pressure in any joint, to compare with the hardness",
        lambda d: column(d, "pressure_max"),
        scale=1e-6,
    ),
    **{name: made("") for name, made in OUTSIDE.items()},
    "flash_temperature_K": Headline(
        "Flash temperature, largest",
        "K",
        "Load",
        "How much warmer than the surfaces their asperities get in any joint, an estimate, where pressure "
        "times speed is largest.",
        lambda d: peak(column(d, "flash_temperature")),
        digits=2,
    ),
    **_pair(
        ("drive_moment_lasting_Nm", "drive_moment_max_Nm"),
        "Drive moment",
        "N m",
        "Drive",
        "Largest moment of a motor",
        lambda d: column(d, "drive_moment"),
    ),
    **_pair(
        ("drive_force_lasting_N", "drive_force_max_N"),
        "Drive force",
        "N",
        "Drive",
        "Largest force of an actuator",
        lambda d: column(d, "drive_force"),
    ),
    "power_mean_W": Headline(
        "Power put in, mean", "W", "Drive", "Mean power of drives and loads over the run.", _power
    ),
    "offset_max_um": Headline(
        "Offset in a joint, largest",
        "µm",
        "Accuracy",
        "Largest distance of a pin from the centre of its bore.",
        lambda d: peak(settled(d, offset(d))) * 1e6,
    ),
    "friction_heat_J": Headline(
        "Friction heat",
        "J",
        "Loss",
        "Heat of friction in all joints over the run.",
        lambda d: float(column(d, "energy_friction")[-1]) if "surface" in d.dims else math.nan,
    ),
    "film_pressure_max_MPa": Headline(
        "Film pressure, peak",
        "MPa",
        "Oil film",
        "Largest pressure in the oil film of any joint.",
        lambda d: peak(settled(d, column(d, "film_pressure_max"))) * 1e-6,
    ),
    "film_thickness_min_um": Headline(
        "Film thickness, smallest",
        "µm",
        "Oil film",
        "Smallest gap of any oil film; below a few rms roughnesses asperities carry a part of the load.",
        lambda d: least(settled(d, column(d, "film_thickness_min"))) * 1e6,
    ),
    "film_power_mean_W": Headline(
        "Film friction power, mean",
        "W",
        "Oil film",
        "Mean power that all oil films dissipate.",
        lambda d: time_mean(d, np.nansum(column(d, "film_power"), axis=1)),
    ),
    "wear_depth_max_nm": Headline(
        "Wear depth, largest",
        "nm",
        "Wear",
        "Largest wear depth of any joint.",
        lambda d: peak(column(d, "wear_depth")) * 1e9,
    ),
    **WEAR_NUMBERS,
    "cycle_scatter_percent": Headline(
        "Scatter of the cycles",
        "%",
        "Trust",
        "Range of the largest forces of single cycles over their mean; needs three cycles.",
        _scatter,
        digits=2,
    ),
    "energy_residual_percent": Headline(
        "Energy residual",
        "%",
        "Trust",
        "Error of the energy balance over its largest term.",
        lambda d: 100.0 * float(d.attrs["energy_residual"]),
    ),
}
KEY_NUMBERS: Final = (
    "frequency_Hz_*",
    "error_lasting_*",
    "joint_force_lasting_N",
    "peak_pressure_MPa",
    "offset_max_um",
    "drive_moment_lasting_Nm",
    "joint_force_max_N",
    "energy_residual_percent",
)


def _named(
    label: str, unit: str, group: str, meaning: str, compute: Callable[[xr.Dataset, int], float]
) -> ByPart:
    def made(joint: str) -> Headline:
        number = Headline(label, unit, group, meaning, lambda d: compute(d, of_joint(d, joint)))
        return number.of_part(joint)

    return made


def _pair_named(
    names: tuple[str, str],
    label: str,
    unit: str,
    meaning: str,
    values: Callable[[xr.Dataset, int], FloatArray],
    *,
    scale: float = 1.0,
) -> dict[str, ByPart]:
    """Return the pair of numbers of a joint, see :func:`_pair`."""

    def made(name: str, joint: str) -> Headline:
        pair = _pair(
            names,
            label,
            unit,
            "Joints",
            meaning,
            lambda d: values(d, of_joint(d, joint)),
            scale=scale,
        )
        return pair[name].of_part(joint)

    return {name: partial(made, name) for name in names}


BY_JOINT: Final[dict[str, ByPart]] = {
    **OUTSIDE,
    **_pair_named(
        ("force_lasting_N", "force_max_N"),
        "Force",
        "N",
        "Largest force in this joint",
        lambda d, j: sizes(d, "reaction_force", j),
    ),
    "force_mean_N": _named(
        "Force, mean",
        "N",
        "Joints",
        "Mean force in this joint; wear is proportional to it.",
        lambda d, j: time_mean(d, sizes(d, "reaction_force", j)),
    ),
    "offset_max_um": _named(
        "Offset, largest",
        "µm",
        "Joints",
        "Largest distance of the pin from the centre of the bore.",
        lambda d, j: peak(settled(d, offset(d, j))) * 1e6,
    ),
    **_pair_named(
        ("pressure_lasting_MPa", "peak_pressure_MPa"),
        "Contact pressure",
        "MPa",
        "Highest pressure in this joint",
        lambda d, j: column(d, "pressure_max")[:, j],
        scale=1e-6,
    ),
    "friction_heat_J": _named(
        "Friction heat",
        "J",
        "Joints",
        "Heat of friction in this joint over the run.",
        lambda d, j: float(column(d, "joint_friction")[-1, j]) if of_surfaces(d, j).size else math.nan,
    ),
    "flash_temperature_K": _named(
        "Flash temperature",
        "K",
        "Joints",
        "How much warmer than the surfaces the asperities of this joint get, an estimate.",
        lambda d, j: float(column(d, "flash_temperature")[j]),
    ),
    "film_pressure_max_MPa": _named(
        "Film pressure, peak",
        "MPa",
        "Joints",
        "Largest pressure in the oil film of this joint.",
        lambda d, j: peak(settled(d, column(d, "film_pressure_max")[:, j])) * 1e-6,
    ),
    "film_thickness_min_um": _named(
        "Film thickness, smallest",
        "µm",
        "Joints",
        "Smallest gap of the oil film of this joint.",
        lambda d, j: least(settled(d, column(d, "film_thickness_min")[:, j])) * 1e6,
    ),
    "wear_depth_nm": _named(
        "Wear depth",
        "nm",
        "Joints",
        "Largest wear depth of this joint.",
        lambda d, j: peak(column(d, "wear_depth")[of_surfaces(d, j)]) * 1e9,
    ),
    "wear_rate_nm_per_1000_cycles": _named(
        "Wear rate",
        "nm per 1000 cycles",
        "Joints",
        "Growth of the largest wear depth of this joint, at the last stop of a campaign or in this run.",
        lambda d, j: 1e12 * wear_rate(d, j),
    ),
    "wear_life_cycles": _named(
        "Life by depth",
        "cycles",
        "Joints",
        "Drive cycles until this joint is worn to the depth limit, at its last rate; all of them, those of "
        "the campaign included.",
        wear_life,
    ),
    "bore_life_cycles": _named(
        "Life of the bore",
        "cycles",
        "Joints",
        "Drive cycles until the bore alone is worn to the depth limit, where both partners wear.",
        lambda d, j: wear_life(d, j, 1.0 - partner_share(d, j)),
    ),
    "shaft_life_cycles": _named(
        "Life of the shaft",
        "cycles",
        "Joints",
        "Drive cycles until the shaft alone is worn to the depth limit, where both partners wear.",
        lambda d, j: wear_life(d, j, partner_share(d, j)),
    ),
    "partner_wear_depth_nm": _named(
        "Wear depth of the partner",
        "nm",
        "Joints",
        "Its part of the wear depth of this joint, where both wear.",
        lambda d, j: peak(column(d, "partner_wear_depth")[of_surfaces(d, j)]) * 1e9,
    ),
}
"""Numbers of each joint, by what stands before its name."""
