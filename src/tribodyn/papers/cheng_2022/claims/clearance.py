"""Claims on the size of the clearance: section 5.3."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, number, truth
from tribodyn.papers.cheng_2022.runs import CLEARANCES, Runs, smooth

JOINTS: Final = 7
"""Joints of the mechanism; the paper multiplies the errors of one by their number."""
_DEGREES: Final = float(np.rad2deg(1.0))


def _runs(runs: Runs, formulation: str, friction: float | None) -> list[xr.Dataset]:
    return [_run(runs, formulation, friction, value) for value in CLEARANCES]


def _run(runs: Runs, formulation: str, friction: float | None, clearance: float) -> xr.Dataset:
    changes = {} if friction is None else {"joint.friction_coefficient": friction}
    return runs.vsv(formulation, clearance, changes)


def _error(run: xr.Dataset, name: str) -> FloatArray:
    return np.asarray(np.abs(run[name].values - run[f"{name}_ideal"].values) * _DEGREES)


def angle_error(
    runs: Runs, formulation: str, friction: float | None, clearance: float, paper: float, joints: int = 1
) -> Finding:
    """Measure the mean size of the angle error in smooth motion."""
    run = smooth(_run(runs, formulation, friction, clearance))
    return number(joints * float(np.mean(_error(run, "theta_v"))), paper, "°")


def speed_error(
    runs: Runs, formulation: str, friction: float | None, clearance: float, paper: float, joints: int = 1
) -> Finding:
    """Measure the median size of the speed error in smooth motion."""
    run = smooth(_run(runs, formulation, friction, clearance))
    return number(joints * float(np.median(_error(run, "omega_v"))), paper, "°/s")


def _means(runs: Runs, formulation: str, friction: float | None, name: str) -> FloatArray:
    return np.array([np.abs(smooth(run)[name].values).mean() for run in _runs(runs, formulation, friction)])


def _peaks(runs: Runs, formulation: str, friction: float | None, part: str) -> FloatArray:
    """Return the largest force of a kind after the reversals [N], by clearance."""
    peaks = []
    for run in _runs(runs, formulation, friction):
        half = 0.5 * float(run.attrs["cycle_period"])
        moving = run["time"].values >= half
        size = np.hypot(run[f"F_{part}x"].values, run[f"F_{part}y"].values)
        peaks.append(float(size[moving].max()))
    return np.array(peaks)


def _listed(values: FloatArray, unit: str) -> str:
    return f"{', '.join(f'{value:.3g}' for value in values)} {unit}"


def forces_alike(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the mean contact force in smooth motion by clearance."""
    force = np.hypot(*(_means(runs, formulation, friction, f"F_c{axis}") for axis in "xy"))
    spread = float(np.ptp(force) / force.mean())
    text = f"mean {_listed(force, 'N')}: a spread of {100.0 * spread:.2g} %"
    return truth(spread < 0.05, text, partly=spread < 0.2)


def oscillation(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how much the contact force differs from its running mean in smooth motion, by clearance."""
    ripple = np.array([_ripple(smooth(run)) for run in _runs(runs, formulation, friction)])
    wide, narrow = ripple[-2:].mean(), ripple[:3].mean()
    return truth(
        bool(wide > 1.5 * narrow), f"ripple {_listed(ripple * 1e3, 'mN')}", partly=bool(wide > narrow)
    )


def _ripple(run: xr.Dataset) -> float:
    """Return the mean size of the second difference of the contact force on uniform rows [N]."""
    time = np.arange(run["time"].values[0], run["time"].values[-1], 5e-3)
    size = np.interp(time, run["time"].values, np.hypot(run["F_cx"].values, run["F_cy"].values))
    jump = np.abs(np.diff(size, 2))
    return float(np.median(jump) if jump.size else 0.0)


def damping_grows(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the largest damping force after reversals by clearance."""
    peaks = _peaks(runs, formulation, friction, "d")
    return truth(
        bool(np.all(np.diff(peaks) > 0.0)), f"peaks {_listed(peaks, 'N')}", partly=bool(peaks[-1] > peaks[0])
    )


def rigid_smaller(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the largest rigid force after reversals by clearance."""
    peaks = _peaks(runs, formulation, friction, "k")
    wide, narrow = peaks[3:], peaks[:3]
    text = f"peaks {_listed(peaks, 'N')}"
    return truth(bool(wide.max() < narrow.min()), text, partly=bool(wide.mean() < narrow.mean()))


def attitude_grows(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure mean displacement and tilt in smooth motion by clearance."""
    shift = _means(runs, formulation, friction, "e_x") * 1e6
    tilt = _means(runs, formulation, friction, "phi_x") * 1e3
    grow = bool(np.all(np.diff(shift) > 0.0) and np.all(np.diff(tilt) > 0.0))
    return truth(grow, f"|e_x| {_listed(shift, 'µm')}; φ_x {_listed(tilt, 'mrad')}")


_IMPACTS: Final = (
    "peaks of impacts are not repeatable with the friction moment: a point that enters contact slowly is "
    "damped by the least entry velocity, and rows of the result are 0.2 ms apart"
)
_SPEED: Final = "median of the smooth motion; the paper does not say at which instant it was read"
_ALL_JOINTS: Final = "not simulated: the paper, and so we, multiply the error of one joint by seven"

CLAIMS: Final = (
    Claim(
        "angle error, 20 µm", "5.3, Fig. 16", "the angle error is about 0.02°",
        partial(angle_error, clearance=20e-6, paper=0.02), "mean of the smooth motion", True,
    ),
    Claim(
        "angle error, 40 µm", "5.3, Fig. 16", "the angle error is 0.043°",
        partial(angle_error, clearance=40e-6, paper=0.043), "mean of the smooth motion", True,
    ),
    Claim(
        "speed error, 20 µm", "5.3, Fig. 16", "the speed error is about 2.5e-4 °/s",
        partial(speed_error, clearance=20e-6, paper=2.5e-4),
        _SPEED, True,
    ),
    Claim(
        "speed error, 40 µm", "5.3, Fig. 16", "the speed error is 7.5e-4 °/s",
        partial(speed_error, clearance=40e-6, paper=7.5e-4),
        _SPEED, True,
    ),
    Claim(
        "angle error, all joints", "5.3", "about 0.14° with clearance in all joints at 20 µm",
        partial(angle_error, clearance=20e-6, paper=0.14, joints=JOINTS), _ALL_JOINTS,
    ),
    Claim("forces alike", "5.3, Fig. 17", "contact forces are almost equal for all clearances", forces_alike),
    Claim(
        "oscillation above 30 µm", "5.3, Fig. 17", "above 30 µm forces oscillate in the continuous motion",
        oscillation, "the ringing after a reversal lasts longer in a wide clearance",
    ),
    Claim(
        "damping force grows", "5.3, Fig. 17", "the damping force grows with the clearance",
        damping_grows, _IMPACTS,
    ),
    Claim(
        "rigid force smaller", "5.3, Fig. 17",
        "at 35 and 40 µm the rigid forces of the collision are smaller",
        rigid_smaller, _IMPACTS,
    ),
    Claim(
        "attitude grows", "5.3, Fig. 18", "displacement and deflection grow with the clearance",
        attitude_grows,
    ),
)  # fmt: skip
"""Claims on the effect of the clearance."""
