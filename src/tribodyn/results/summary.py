"""Headline numbers of a run: few, flat, with the unit in the name."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.results.dataset import json_attribute
from tribodyn.results.headline import Headline
from tribodyn.results.law_headlines import LAW_HEADLINES, law_in, named


def _values(dataset: xr.Dataset, name: str) -> FloatArray:
    """Return a variable as an array."""
    return np.asarray(dataset[name].values, dtype=np.float64)


def _norm(dataset: xr.Dataset, *names: str) -> FloatArray:
    """Return the length of a vector given by its components, over time."""
    return np.sqrt(sum(_values(dataset, name) ** 2 for name in names))


def _peak(values: FloatArray) -> float:
    """Return the largest finite size, NaN when there is none."""
    finite = np.abs(values[np.isfinite(values)])
    return float(finite.max()) if finite.size else math.nan


def _reached(dataset: xr.Dataset, attribute: str, values: FloatArray) -> float:
    """Return the peak of a quantity; where it fell between output times, an attribute holds it."""
    return _peak(np.append(values, float(dataset.attrs.get(attribute, math.nan))))


def _time_mean(dataset: xr.Dataset, values: FloatArray) -> float:
    """Return the mean over time (trapezoidal: output times need not be uniform), of the finite part."""
    good = np.isfinite(values)
    time, values = _values(dataset, "time")[good], values[good]
    span = float(time[-1] - time[0]) if time.size else 0.0
    area = 0.5 * float(np.sum((values[1:] + values[:-1]) * np.diff(time)))
    return area / span if span > 0.0 else math.nan


def _angle_error(dataset: xr.Dataset) -> FloatArray:
    """Return the vane-angle error [deg] over time."""
    return np.rad2deg(_values(dataset, "theta_v") - _values(dataset, "theta_v_ideal"))


def _speed_error(dataset: xr.Dataset) -> FloatArray:
    """Return the vane-speed error [deg/s] over time."""
    return np.rad2deg(_values(dataset, "omega_v") - _values(dataset, "omega_v_ideal"))


def _rms(dataset: xr.Dataset, values: FloatArray) -> float:
    """Return the root mean square over time."""
    return math.sqrt(_time_mean(dataset, values**2))


def _cycles(dataset: xr.Dataset) -> float:
    """Return how many cycles of the drive the run holds."""
    time = _values(dataset, "time")
    return float(time[-1] - time[0]) / float(dataset.attrs["cycle_period"]) if time.size else math.nan


def _wear_rate(dataset: xr.Dataset) -> float:
    """Return the greatest wear depth [nm] a thousand cycles would make; NaN before one cycle is complete."""
    if "wear_rate" in dataset:
        return float(_values(dataset, "wear_rate")[-1]) * 1e9 * 1000.0
    cycles = _cycles(dataset)
    whole = cycles >= 1.0 - 1e-9
    return _peak(_values(dataset, "wear_depth")) * 1e9 * 1000.0 / cycles if whole else math.nan


def _statistic(name: str) -> Callable[[xr.Dataset], float]:
    """Return a reader of one entry of the solver statistics."""
    return lambda dataset: float(json_attribute(dataset, "solver", {})[name])


def _real_time_factor(dataset: xr.Dataset) -> float:
    """Return simulated time over wall time; a wear campaign simulates far more than the result holds."""
    if "wear_cycles" in dataset:
        return math.nan
    time = _values(dataset, "time")
    return float(time[-1] - time[0]) / _statistic("wall_time")(dataset)


HEADLINES: Final[dict[str, Headline]] = {
    "vane_angle_error_max_deg": Headline(
        "Vane-angle error, largest",
        "°",
        "Accuracy",
        "How far clearance lets the vane stray from where the drive puts it.",
        lambda d: _peak(_angle_error(d)),
    ),
    "vane_angle_error_rms_deg": Headline(
        "Vane-angle error, rms",
        "°",
        "Accuracy",
        "The same error as an average over the run.",
        lambda d: _rms(d, _angle_error(d)),
    ),
    "vane_speed_error_rms_deg_per_s": Headline(
        "Vane-speed error, rms",
        "°/s",
        "Accuracy",
        "How unsteadily the vane turns compared with a tight joint.",
        lambda d: _rms(d, _speed_error(d)),
    ),
    "contact_force_max_N": Headline(
        "Contact force, largest",
        "N",
        "Load",
        "Peak load on the bushing, usually an impact after a reversal.",
        lambda d: _reached(d, "contact_force_peak", _norm(d, "F_cx", "F_cy")),
    ),
    "contact_force_mean_N": Headline(
        "Contact force, mean",
        "N",
        "Load",
        "Average load on the bushing: what wears it.",
        lambda d: _time_mean(d, _norm(d, "F_cx", "F_cy")),
    ),
    "peak_pressure_MPa": Headline(
        "Peak pressure",
        "MPa",
        "Load",
        "Highest pressure anywhere in the bushing; compare it with the hardness.",
        lambda d: _reached(d, "pressure_peak", _values(d, "p_max")) * 1e-6,
    ),
    "tilt_max_mrad": Headline(
        "Tilt, largest",
        "mrad",
        "Load",
        "How far the trunnion leans in the bushing: tilt loads the edges.",
        lambda d: _peak(_norm(d, "phi_x", "phi_y")) * 1e3,
    ),
    "eccentricity_max_um": Headline(
        "Eccentricity, largest",
        "µm",
        "Load",
        "How far the trunnion centre moves off the bushing axis.",
        lambda d: _peak(_norm(d, "e_x", "e_y")) * 1e6,
    ),
    "drive_moment_max_Nm": Headline(
        "Drive moment, largest",
        "N m",
        "Load",
        "What the actuator must deliver at the crank.",
        lambda d: _peak(_values(d, "M_d")),
    ),
    "wear_depth_max_nm": Headline(
        "Wear depth",
        "nm",
        "Wear",
        "Deepest point of the worn bushing: after the wear campaign, or a linear estimate for this run.",
        lambda d: _peak(_values(d, "wear_depth")) * 1e9,
    ),
    "wear_depth_rate_nm_per_1000_cycles": Headline(
        "Wear rate",
        "nm per 1000 cycles",
        "Wear",
        "Deepest wear if this motion repeats and the pressure stays as it is.",
        _wear_rate,
    ),
    "worn_volume_mm3": Headline(
        "Worn volume",
        "mm³",
        "Wear",
        "What was worn off the bushing, in the campaign or by the same estimate.",
        lambda d: float(d.attrs["worn_volume"]) * 1e9,
    ),
    "wear_cycles": Headline(
        "Cycles of wear",
        "",
        "Wear",
        "Drive cycles that the wear campaign covered.",
        lambda d: float(d.attrs["wear_cycles_reached"]),
    ),
    "wear_life_cycles": Headline(
        "Life",
        "cycles",
        "Wear",
        "Drive cycles until some point is worn to the depth limit; without a campaign a linear estimate.",
        lambda d: float(d.attrs["wear_life_cycles"]),
    ),
    "energy_residual_percent": Headline(
        "Energy residual, whole system",
        "%",
        "Trust",
        "What the energy ledger of everything that moves misses; below 1 % is sound.",
        lambda d: float(d.attrs["energy_residual"]) * 100.0,
    ),
    "clearance_energy_residual_percent": Headline(
        "Energy residual, clearance motion",
        "%",
        "Trust",
        "The stricter ledger of the motion in the clearance alone.",
        lambda d: float(d.attrs["clearance_energy_residual"]) * 100.0,
    ),
    "simulated_time_s": Headline(
        "Simulated time",
        "s",
        "Effort",
        "How much of the motion this result holds.",
        lambda d: float(np.ptp(_values(d, "time"))),
    ),
    "steps": Headline("Steps", "", "Effort", "Accepted steps of the integrator.", _statistic("steps")),
    "rhs_evaluations": Headline(
        "Evaluations", "", "Effort", "Calls of the equations of motion.", _statistic("rhs_evaluations")
    ),
    "wall_time_s": Headline(
        "Wall time", "s", "Effort", "How long the integration took.", _statistic("wall_time")
    ),
    "real_time_factor": Headline(
        "Real-time factor",
        "",
        "Effort",
        "Seconds of motion simulated in a second of computing.",
        _real_time_factor,
    ),
}
"""Every headline number, by its name in ``summary.json``."""

_COUNTS: Final = ("steps", "rhs_evaluations", "rebounds_", "wear_cycles")
"""What the names of whole numbers begin with."""


def known(names: Iterable[str]) -> dict[str, Headline]:
    """Return what is known of those of the names that are headline numbers, in reading order.

    Parameters
    ----------
    names
        Names of a summary. Those of runs with contact laws side by side hold the name of a law.
    """
    given = list(names)
    found = {}
    for template, headline in LAW_HEADLINES.items():
        for name in given:
            law = law_in(name, template)
            if law is not None and name not in HEADLINES:
                found[name] = replace(headline, label=f"{headline.label}, {law}")
    return found | {name: headline for name, headline in HEADLINES.items() if name in given}


def summarise(dataset: xr.Dataset) -> dict[str, float | int | str]:
    """Return the headline numbers of a result.

    A number that the result cannot give (a partial run, another mechanism) is left out.

    Parameters
    ----------
    dataset
        A result.

    Returns
    -------
    dict
        Title, ``status`` (``"complete"`` or ``"failed"``), ``failure`` and ``warnings`` (texts, empty when
        there is none), then numbers by name.
    """
    failure = str(dataset.attrs.get("failure", ""))
    texts: dict[str, float | int | str] = {
        "title": str(dataset.attrs.get("title", "")),
        "status": "failed" if failure else "complete",
        "failure": failure,
        "warnings": "; ".join(json_attribute(dataset, "warnings", [])),
    }
    numbers = _of_each_law(dataset)
    # What runs over the laws has no number that holds for all of them.
    common = dataset.drop_dims("law") if "law" in dataset.dims else dataset
    numbers |= {name: _number(headline, common) for name, headline in HEADLINES.items()}
    return texts | {
        name: int(value) if name.startswith(_COUNTS) else value
        for name, value in numbers.items()
        if math.isfinite(value)
    }


def _of_each_law(dataset: xr.Dataset) -> dict[str, float]:
    """Return the headline numbers of each law of runs side by side."""
    if "law" not in dataset.dims:
        return {}
    runs = {str(law): dataset.isel(law=i) for i, law in enumerate(dataset["law"].values)}
    return {
        named(template, law): _number(headline, run)
        for template, headline in LAW_HEADLINES.items()
        for law, run in runs.items()
    }


def _number(headline: Headline, dataset: xr.Dataset) -> float:
    """Return a headline number, NaN where the result does not hold what it needs."""
    try:
        return headline.compute(dataset)
    except (KeyError, ValueError, ZeroDivisionError, IndexError):
        return math.nan
