"""Key results of each joint by its name; the sustained maximum of a quantity is shown with its peak."""

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.mechanism.results import joint_readings as readings
from tribodyn.mechanisms.mechanism_protocol import ByPart
from tribodyn.results.reading import column, of_part, peak, rms, settled, sustained, time_mean
from tribodyn.results.summary import KeyResult
from tribodyn.results.wear_numbers import wear_life, wear_rate

if TYPE_CHECKING:
    import xarray as xr

_SAME: Final = 1e-9  #: Difference of efforts over the largest one that counts as none.


def _outside(label: str, unit: str, quantity: str, *, scale: float = 1.0) -> ByPart:
    """Return the largest value outside the impacts after reversals, of one joint or of all of them."""

    def value(dataset: "xr.Dataset", joint: str) -> float:
        values = column(dataset, f"{quantity}_outside")
        return (
            readings.above_zero(peak(values[:, readings.of_joint(dataset, joint)] if joint else values))
            * scale
        )

    def made(joint: str) -> KeyResult:
        name = label if joint else f"{label} in a joint"
        number = KeyResult(
            f"{name}, peak without impacts",
            unit,
            "Joints" if joint else "Load",
            "Once the impacts after reversals of the drive have died away.",
            lambda d: value(d, joint),
        )
        return number.of_part(joint) if joint else number

    return made


#: Numbers of mechanisms whose drives reverse, by name.
OUTSIDE: Final[dict[str, ByPart]] = {
    "force_outside_N": _outside("Force", "N", "joint_force"),
    "pressure_outside_MPa": _outside("Contact pressure", "MPa", "pressure", scale=1e-6),
    "offset_outside_um": _outside("Offset", "µm", "offset", scale=1e6),
    "drive_moment_outside_Nm": _outside("Drive moment", "N m", "drive_moment"),
}


def _driven(label: str, unit: str, meaning: str, reduce: Callable[["xr.Dataset", slice], float]) -> ByPart:
    """Return a number of the drives of some joints: of all, and of each where several are driven."""

    def value(dataset: "xr.Dataset", joint: str) -> float:
        if not joint:
            return reduce(dataset, slice(None))
        several = np.count_nonzero(column(dataset, "drive_power").any(axis=0)) > 1
        k = readings.of_joint(dataset, joint)
        return reduce(dataset, slice(k, k + 1)) if several else math.nan

    def made(joint: str) -> KeyResult:
        number = KeyResult(label, unit, "Drive", meaning, lambda d: value(d, joint))
        return number.of_part(joint) if joint else number

    return made


def _rms(effort: str, dataset: "xr.Dataset", joints: slice) -> float:
    return readings.above_zero(max(rms(dataset, values) for values in column(dataset, effort)[:, joints].T))


def _peak(quantity: str, dataset: "xr.Dataset", joints: slice) -> float:
    return readings.above_zero(peak(settled(dataset, column(dataset, quantity)[:, joints])))


def _rate_at_peak(effort: str, other: str, dataset: "xr.Dataset", joints: slice) -> float:
    values = settled(dataset, column(dataset, effort)[:, joints])
    size, powers = np.abs(values), settled(dataset, column(dataset, "drive_power")[:, joints])
    # A constant effort is at its peak all the time: the fastest point counts.
    peak_power = np.where(size >= (1.0 - _SAME) * np.max(size), np.abs(powers), -1.0)
    where = np.unravel_index(np.argmax(peak_power), values.shape)
    both = settled(dataset, column(dataset, other)[:, joints])[where]
    nothing = both or abs(values[where]) < readings.NOTHING or "mode" in dataset.dims
    return math.nan if nothing else round(float(abs(powers[where] / values[where])), 20)


#: Numbers for the size of motors and actuators, by name.
DRIVEN: Final[dict[str, ByPart]] = {
    "drive_power_rms_W": _driven(
        "Power of the drives, rms",
        "W",
        "Root mean square over the run.",
        lambda d, joints: readings.above_zero(rms(d, column(d, "drive_power")[:, joints].sum(axis=1))),
    ),
    "drive_moment_rms_Nm": _driven(
        "Drive moment, rms",
        "N m",
        "Root mean square over the run, which warms a motor.",
        partial(_rms, "drive_moment"),
    ),
    "drive_speed_at_peak_rad_per_s": _driven(
        "Speed at the peak of the drive moment",
        "rad/s",
        "With the largest moment, a point that the curve of a motor must hold.",
        partial(_rate_at_peak, "drive_moment", "drive_force"),
    ),
    "drive_force_rms_N": _driven(
        "Drive force, rms",
        "N",
        "Root mean square over the run, which warms an actuator.",
        partial(_rms, "drive_force"),
    ),
    "drive_velocity_at_peak_m_per_s": _driven(
        "Velocity at the peak of the drive force",
        "m/s",
        "With the largest force, a point that the curve of an actuator must hold.",
        partial(_rate_at_peak, "drive_force", "drive_moment"),
    ),
}


def pair(
    names: tuple[str, str],
    label: str,
    unit: str,
    group: str,
    meaning: str,
    values: Callable[["xr.Dataset"], FloatArray],
    *,
    scale: float = 1.0,
) -> dict[str, KeyResult]:
    """Return the sustained maximum and the peak with impacts, by their names.

    ``names``: of the two; ``label``, ``unit``, ``group``, ``meaning``: as of a
    :class:`~tribodyn.results.summary.KeyResult`; the meaning ends in the share of time; ``values``: the
    quantities over time, shape (n_t,) or (n_t, n); ``scale``: their unit over that of the number.
    """
    quiet, loud = names
    return {
        quiet: KeyResult(
            f"{label}, sustained",
            unit,
            group,
            f"{meaning} for 99 % of the time; impacts excluded.",
            lambda d: readings.above_zero(sustained(d, values(d))) * scale,
        ),
        loud: KeyResult(
            f"{label}, peak",
            unit,
            group,
            "Largest value at any step of the integration, impacts included.",
            lambda d: readings.above_zero(peak(settled(d, values(d)))) * scale,
            over="cycles",
            span="over {} cycle",
        ),
    }


def _named(
    label: str, unit: str, group: str, meaning: str, compute: Callable[["xr.Dataset", int], float]
) -> ByPart:
    def made(joint: str) -> KeyResult:
        number = KeyResult(label, unit, group, meaning, lambda d: compute(d, readings.of_joint(d, joint)))
        return number.of_part(joint)

    return made


def _pair_named(
    names: tuple[str, str],
    label: str,
    unit: str,
    meaning: str,
    values: Callable[["xr.Dataset", int], FloatArray],
    *,
    scale: float = 1.0,
) -> dict[str, ByPart]:
    """Return the pair of numbers of a joint, see :func:`pair`."""

    def made(name: str, joint: str) -> KeyResult:
        both = pair(
            names,
            label,
            unit,
            "Joints",
            meaning,
            lambda d: values(d, readings.of_joint(d, joint)),
            scale=scale,
        )
        return both[name].of_part(joint)

    return {name: partial(made, name) for name in names}


#: Numbers of each joint, by what stands before its name.
BY_JOINT: Final[dict[str, ByPart]] = {
    **OUTSIDE,
    **DRIVEN,
    **{
        name: _driven(
            f"{label}, peak", unit, "Largest value at any step of the integration.", partial(_peak, quantity)
        )
        for name, label, unit, quantity in (
            ("drive_power_max_W", "Power of the drive", "W", "drive_power"),
            ("drive_moment_max_Nm", "Drive moment", "N m", "drive_moment"),
            ("drive_force_max_N", "Drive force", "N", "drive_force"),
        )
    },
    **_pair_named(
        ("force_sustained_N", "force_max_N"),
        "Force",
        "N",
        "Largest force in this joint",
        lambda d, j: of_part(d, "reaction_force", j, readings.lengths),
    ),
    "force_mean_N": _named(
        "Force, mean",
        "N",
        "Joints",
        "Mean force in this joint; wear is proportional to it.",
        lambda d, j: readings.above_zero(time_mean(d, of_part(d, "reaction_force", j, readings.lengths))),
    ),
    "offset_max_um": _named(
        "Offset, peak",
        "µm",
        "Joints",
        "Largest distance of the pin from the centre of the bore.",
        lambda d, j: peak(settled(d, readings.offset(d, j))) * 1e6,
    ),
    **_pair_named(
        ("pressure_sustained_MPa", "peak_pressure_MPa"),
        "Contact pressure",
        "MPa",
        "Highest pressure in this joint",
        lambda d, j: of_part(d, "pressure_max", j),
        scale=1e-6,
    ),
    "friction_heat_J": _named(
        "Dry friction heat, whole run",
        "J",
        "Joints",
        "Heat of dry friction in this joint since the start of the run; its oil film is not counted.",
        lambda d, j: (
            float(column(d, "joint_friction")[-1, j])
            if readings.of_surfaces(d, j).size and "wear_depth" in d
            else math.nan
        ),
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
        lambda d, j: peak(settled(d, of_part(d, "film_pressure_max", j))) * 1e-6,
    ),
    "film_thickness_min_um": _named(
        "Film thickness, smallest",
        "µm",
        "Joints",
        "Smallest gap of the oil film of this joint.",
        lambda d, j: readings.least(settled(d, of_part(d, "film_thickness_min", j))) * 1e6,
    ),
    "wear_depth_nm": _named(
        "Wear depth",
        "nm",
        "Joints",
        "Largest wear depth of this joint.",
        lambda d, j: peak(column(d, "wear_depth")[readings.of_surfaces(d, j)]) * 1e9,
    ),
    "wear_rate_nm_per_1000_cycles": _named(
        "Wear rate",
        "nm per 1000 cycles",
        "Joints",
        "Growth of the largest wear depth of this joint, at the last stop of a campaign or in this run.",
        lambda d, j: 1e12 * wear_rate(d, readings.of_surfaces(d, j)),
    ),
    "wear_life_cycles": _named(
        "Life by depth",
        "cycles",
        "Joints",
        "Drive cycles until this joint is worn to the depth limit, both partners together, at its last "
        "rate; all of them, those of the campaign included.",
        lambda d, j: wear_life(d, readings.of_surfaces(d, j)),
    ),
    "bore_life_cycles": _named(
        "Life of the bore",
        "cycles",
        "Joints",
        "Drive cycles until the bore alone is worn to the depth limit, where both partners wear.",
        lambda d, j: wear_life(d, readings.of_surfaces(d, j), "bore"),
    ),
    "shaft_life_cycles": _named(
        "Life of the shaft",
        "cycles",
        "Joints",
        "Drive cycles until the shaft alone is worn to the depth limit, where both partners wear.",
        lambda d, j: wear_life(d, readings.of_surfaces(d, j), "shaft"),
    ),
    "partner_wear_depth_nm": _named(
        "Wear depth of the partner",
        "nm",
        "Joints",
        "Its part of the wear depth of this joint, where both wear.",
        lambda d, j: peak(column(d, "partner_wear_depth")[readings.of_surfaces(d, j)]) * 1e9,
    ),
}
