"""Headline numbers of the vane mechanism."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.results.headline import Headline
from tribodyn.results.reading import column, cycles, norm, peak, reached, rms, time_mean


def _angle_error(dataset: xr.Dataset) -> FloatArray:
    """Return the vane-angle error [deg] over time."""
    return np.rad2deg(column(dataset, "theta_v") - column(dataset, "theta_v_ideal"))


def _speed_error(dataset: xr.Dataset) -> FloatArray:
    """Return the vane-speed error [deg/s] over time."""
    return np.rad2deg(column(dataset, "omega_v") - column(dataset, "omega_v_ideal"))


def _wear_rate(dataset: xr.Dataset) -> float:
    """Return the greatest wear depth [nm] a thousand cycles would make; NaN before one cycle is complete."""
    if "wear_rate" in dataset:
        return float(column(dataset, "wear_rate")[-1]) * 1e9 * 1000.0
    held = cycles(dataset)
    whole = held >= 1.0 - 1e-9
    return peak(column(dataset, "wear_depth")) * 1e9 * 1000.0 / held if whole else math.nan


HEADLINES: Final[dict[str, Headline]] = {
    "vane_angle_error_max_deg": Headline(
        "Vane-angle error, largest",
        "°",
        "Accuracy",
        "How far clearance lets the vane stray from where the drive puts it.",
        lambda d: peak(_angle_error(d)),
    ),
    "vane_angle_error_rms_deg": Headline(
        "Vane-angle error, rms",
        "°",
        "Accuracy",
        "The same error as an average over the run.",
        lambda d: rms(d, _angle_error(d)),
    ),
    "vane_speed_error_rms_deg_per_s": Headline(
        "Vane-speed error, rms",
        "°/s",
        "Accuracy",
        "How unsteadily the vane turns compared with a tight joint.",
        lambda d: rms(d, _speed_error(d)),
    ),
    "contact_force_max_N": Headline(
        "Contact force, largest",
        "N",
        "Load",
        "Peak load on the bushing, usually an impact after a reversal.",
        lambda d: reached(d, "contact_force_peak", norm(d, "F_cx", "F_cy")),
    ),
    "contact_force_mean_N": Headline(
        "Contact force, mean",
        "N",
        "Load",
        "Average load on the bushing: what wears it.",
        lambda d: time_mean(d, norm(d, "F_cx", "F_cy")),
    ),
    "peak_pressure_MPa": Headline(
        "Peak pressure",
        "MPa",
        "Load",
        "Highest pressure anywhere in the bushing; compare it with the hardness.",
        lambda d: reached(d, "pressure_peak", column(d, "p_max")) * 1e-6,
    ),
    "tilt_max_mrad": Headline(
        "Tilt, largest",
        "mrad",
        "Load",
        "How far the trunnion leans in the bushing: tilt loads the edges.",
        lambda d: peak(norm(d, "phi_x", "phi_y")) * 1e3,
    ),
    "eccentricity_max_um": Headline(
        "Eccentricity, largest",
        "µm",
        "Load",
        "How far the trunnion centre moves off the bushing axis.",
        lambda d: peak(norm(d, "e_x", "e_y")) * 1e6,
    ),
    "drive_moment_max_Nm": Headline(
        "Drive moment, largest",
        "N m",
        "Load",
        "What the actuator must deliver at the crank.",
        lambda d: peak(column(d, "M_d")),
    ),
    "wear_depth_max_nm": Headline(
        "Wear depth",
        "nm",
        "Wear",
        "Deepest point of the worn bushing: after the wear campaign, or a linear estimate for this run.",
        lambda d: peak(column(d, "wear_depth")) * 1e9,
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
        count=True,
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
}
"""By name, in reading order."""

KEY_NUMBERS: Final = (
    "vane_angle_error_max_deg",
    "contact_force_mean_N",
    "contact_force_max_N",
    "peak_pressure_MPa",
    "wear_depth_rate_nm_per_1000_cycles",
    "clearance_energy_residual_percent",
)
"""What a reader wants first."""
