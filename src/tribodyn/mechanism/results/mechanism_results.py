"""Key results of a mechanism as a whole."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.mechanism.results import joint_readings as readings
from tribodyn.mechanism.results.copies import COPIES
from tribodyn.mechanism.results.derived_columns import LIMITS
from tribodyn.mechanism.results.joint_numbers import DRIVEN, OUTSIDE, pair
from tribodyn.mechanisms.mechanism_protocol import ByPart
from tribodyn.results import reading
from tribodyn.results.summary import KeyResult
from tribodyn.results.wear_numbers import WEAR_NUMBERS

if TYPE_CHECKING:
    import xarray as xr

_ROUNDING: Final = 1e-9


def _cycles(dataset: "xr.Dataset") -> float:
    """Return the number of whole cycles evaluated; NaN for none."""
    whole = math.floor(reading.column(dataset, "time")[-1] / reading.period(dataset) + _ROUNDING)
    return readings.above_zero(whole if reading.in_settled(dataset)[0] else whole - 1)


def _scatter(dataset: "xr.Dataset") -> float:
    """Return by how much the largest forces of the cycles looked at differ, of their mean [%]."""
    time, n = reading.settled(dataset, reading.column(dataset, "time")), int(_cycles(dataset))
    force = reading.settled(dataset, readings.sizes(dataset, "reaction_force").max(axis=1))
    edges = np.searchsorted(time, time[0] + reading.period(dataset) * np.arange(1, n))
    found = np.array([part.max() for part in np.split(force, edges)])
    return 100.0 * float(np.ptp(found) / found.mean()) if n > 1 and found.any() else math.nan


def _mean_rate(dataset: "xr.Dataset", energy: FloatArray) -> float:
    """Return the mean power [W] over the run from an energy since its start; NaN where nothing moves."""
    time = reading.column(dataset, "time")
    moves = time[-1] > time[0] and "mode" not in dataset.dims
    return float((energy[-1] - energy[0]) / (time[-1] - time[0])) if moves else math.nan


def _of_limits(dataset: "xr.Dataset") -> FloatArray:
    """Return efforts of drives over their limits, shape (n_t, n); zero where there is none."""
    shares = [
        np.nan_to_num(reading.column(dataset, effort) / reading.column(dataset, f"{effort}_limit"))
        for effort in LIMITS
        if f"{effort}_limit" in dataset.variables
    ]
    return np.hstack(shares or [np.zeros((dataset.sizes["time"], 1))])


def _power(dataset: "xr.Dataset") -> float:
    """Return the mean power of the drives [W]: stored energy and heat by the energy balance, without loads.

    The work itself goes to and fro by many times as much, and the error of its sum over steps with it.
    """
    if np.abs(reading.column(dataset, "drive_power")).max(initial=0.0) < readings.NOTHING:
        return math.nan
    gained, others = (
        sum(reading.column(dataset, name) for name in names if name in dataset.variables)
        for names in (readings.WHOLE.gained, ("energy_loads", "energy_expansion"))
    )
    return _mean_rate(dataset, np.asarray(gained - others))


KEY_RESULTS: Final[dict[str, KeyResult]] = {
    "reversals": KeyResult(
        "Reversals held",
        "",
        "Load",
        "Reversals of a drive in this result with the impacts that follow them.",
        reading.reversals_held,
        count=True,
    ),
    "cycles": KeyResult(
        "Cycles evaluated",
        "",
        "Load",
        "Whole cycles that peaks are taken over; of several, the first is left out as transient.",
        _cycles,
        count=True,
    ),
    **pair(
        ("joint_force_sustained_N", "joint_force_max_N"),
        "Force in a joint",
        "N",
        "Load",
        "Largest force that any joint carries",
        lambda d: readings.sizes(d, "reaction_force"),
    ),
    **pair(
        ("pressure_sustained_MPa", "peak_pressure_MPa"),
        "Contact pressure",
        "MPa",
        "Load",
        "Highest pressure in any joint, to compare with the hardness",
        lambda d: reading.column(d, "pressure_max"),
        scale=1e-6,
    ),
    **pair(
        ("stress_sustained_MPa", "stress_max_MPa"),
        "Stress in elastic bodies",
        "MPa",
        "Load",
        "Largest normal stress at the ends of all pieces, of tension and bending, without notches",
        lambda d: reading.column(d, "beam_stress"),
        scale=1e-6,
    ),
    **{name: made("") for name, made in OUTSIDE.items()},
    "flash_temperature_K": KeyResult(
        "Flash temperature, peak",
        "K",
        "Load",
        "How much warmer than the surfaces their asperities get in any joint, an estimate, where pressure "
        "times speed is largest.",
        lambda d: reading.peak(reading.column(d, "flash_temperature")),
        digits=2,
    ),
    **pair(
        ("drive_moment_sustained_Nm", "drive_moment_max_Nm"),
        "Drive moment",
        "N m",
        "Drive",
        "Largest moment of a motor",
        lambda d: reading.column(d, "drive_moment"),
    ),
    **pair(
        ("drive_force_sustained_N", "drive_force_max_N"),
        "Drive force",
        "N",
        "Drive",
        "Largest force of an actuator",
        lambda d: reading.column(d, "drive_force"),
    ),
    **pair(
        ("drive_of_limit_sustained_percent", "drive_of_limit_max_percent"),
        "Drive, of its limit",
        "%",
        "Drive",
        "Largest force or moment of a drive over its limit",
        _of_limits,
        scale=100.0,
    ),
    **pair(
        ("drive_power_sustained_W", "drive_power_max_W"),
        "Power of the drives",
        "W",
        "Drive",
        "Power of all drives, motors and controllers together",
        lambda d: reading.column(d, "drive_power").sum(axis=1),
    ),
    "drive_power_mean_W": KeyResult(
        "Power of the drives, mean",
        "W",
        "Drive",
        "Mean power of all drives, motors and controllers over the run; below zero where they brake.",
        _power,
    ),
    "load_power_mean_W": KeyResult(
        "Power of the loads, mean",
        "W",
        "Drive",
        "Mean power of all loads over the run; below zero where they take what drives give.",
        lambda d: _mean_rate(d, reading.column(d, "energy_loads")),
    ),
    **{name: made("") for name, made in DRIVEN.items()},
    "offset_max_um": KeyResult(
        "Offset in a joint, peak",
        "µm",
        "Accuracy",
        "Largest distance of a pin from the centre of its bore.",
        lambda d: reading.peak(reading.settled(d, readings.offset(d))) * 1e6,
    ),
    "friction_heat_J": KeyResult(
        "Dry friction heat, whole run",
        "J",
        "Loss",
        "Heat of dry friction in all joints since the start of the run; oil films are not counted.",
        lambda d: float(reading.column(d, "energy_friction")[-1]) if "wear_depth" in d else math.nan,
    ),
    "film_pressure_max_MPa": KeyResult(
        "Film pressure, peak",
        "MPa",
        "Oil film",
        "Largest pressure in the oil film of any joint.",
        lambda d: reading.peak(reading.settled(d, reading.column(d, "film_pressure_max"))) * 1e-6,
    ),
    "film_thickness_min_um": KeyResult(
        "Film thickness, smallest",
        "µm",
        "Oil film",
        "Smallest gap of any oil film; below a few rms roughnesses asperities carry a part of the load.",
        lambda d: readings.least(reading.settled(d, reading.column(d, "film_thickness_min"))) * 1e6,
    ),
    "film_power_mean_W": KeyResult(
        "Film friction power, mean",
        "W",
        "Oil film",
        "Mean power that all oil films dissipate.",
        lambda d: reading.time_mean(d, np.nansum(reading.column(d, "film_power"), axis=1)),
    ),
    "wear_depth_max_nm": KeyResult(
        "Wear depth, peak",
        "nm",
        "Wear",
        "Largest wear depth of any joint.",
        lambda d: reading.peak(reading.column(d, "wear_depth")) * 1e9,
    ),
    **WEAR_NUMBERS,
    **COPIES,
    "cycle_scatter_percent": KeyResult(
        "Scatter of the cycles",
        "%",
        "Trust",
        "Range of the largest forces of single cycles over their mean; needs three cycles.",
        _scatter,
        digits=2,
    ),
    "energy_residual_percent": KeyResult(
        "Energy residual",
        "%",
        "Trust",
        "Error of the energy balance over its largest term.",
        lambda d: 100.0 * float(d.attrs["energy_residual"]),
    ),
}
KEY_NUMBERS: Final = (
    "frequency_Hz_*",
    "copies_*",
    "error_sustained_*",
    "joint_force_sustained_N",
    "peak_pressure_MPa",
    "offset_max_um",
    "drive_moment_sustained_Nm",
    "drive_force_sustained_N",
    "drive_of_limit_sustained_percent",
    "joint_force_max_N",
    "energy_residual_percent",
)


def _of_mode(
    label: str, unit: str, meaning: str, variable: str, reduce: Callable[[FloatArray], float], digits: int = 6
) -> ByPart:
    def made(mode: str) -> KeyResult:
        def compute(dataset: "xr.Dataset") -> float:
            number = [str(name) for name in dataset["mode"].values].index(mode)
            return reduce(reading.column(dataset, variable)[:, number])

        return KeyResult(label, unit, "Modes", meaning, compute, digits=digits).of_part(mode)

    return made


def _over_positions(reduce: Callable[[FloatArray], float]) -> Callable[[FloatArray], float]:
    """Return the reduction of the values at several positions; of one there is nothing to compare."""
    return lambda values: reduce(values) if values.size > 1 else np.nan


#: Numbers of each mode, by what stands before its number.
BY_MODE: Final[dict[str, ByPart]] = {
    "frequency_Hz": _of_mode(
        "Frequency at the start",
        "Hz",
        "Natural frequency at the first position; motions that nothing holds are no modes.",
        "natural_frequency",
        lambda values: float(values[0]),
    ),
    "damping_ratio": _of_mode(
        "Damping ratio",
        "",
        "At the first position; one without oscillation, below zero where the position is unstable.",
        "damping_ratio",
        lambda values: float(values[0]),
        digits=3,
    ),
    "frequency_min_Hz": _of_mode(
        "Lowest frequency",
        "Hz",
        "Lowest of all positions along the drives.",
        "natural_frequency",
        _over_positions(lambda values: float(np.nanmin(values))),
    ),
    "frequency_max_Hz": _of_mode(
        "Highest frequency",
        "Hz",
        "Highest of all positions along the drives.",
        "natural_frequency",
        _over_positions(lambda values: float(np.nanmax(values))),
    ),
}
