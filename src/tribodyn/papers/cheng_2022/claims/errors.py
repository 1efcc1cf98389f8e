"""Claims on the error of the vane: section 5.3, Fig. 16."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims import all_joints
from tribodyn.papers.cheng_2022.claims.base import (
    ENTRY_VELOCITY,
    FRICTION,
    Claim,
    Finding,
    Trial,
    least_growth,
    listed,
)
from tribodyn.papers.cheng_2022.claims.bounds import above, near
from tribodyn.papers.cheng_2022.claims.smooth import trend
from tribodyn.papers.cheng_2022.runs import CLEARANCES, smooth

_DEGREES: Final = float(np.rad2deg(1.0))


def _angle_error(run: xr.Dataset) -> FloatArray:
    return np.asarray((run["theta_v"].values - run["theta_v_ideal"].values) * _DEGREES)


def mean_angle_error(run: xr.Dataset) -> float:
    """Return the mean size of the angle error in smooth motion [deg]."""
    return float(np.mean(np.abs(_angle_error(smooth(run)))))


def speed_trend(run: xr.Dataset) -> float:
    """Return the median size of the speed error, averaged over 0.2 s, in smooth motion [deg/s]."""
    return trend(run["time"].values, _angle_error(run), run)


def angle_error(trial: Trial, clearance: float) -> Finding:
    """Measure the angle error."""
    value = mean_angle_error(trial.vsv(clearance))
    return Finding(f"{value:.3g} °", value)


def speed_error(trial: Trial, clearance: float) -> Finding:
    """Measure the speed error."""
    value = speed_trend(trial.vsv(clearance))
    return Finding(f"{value:.2g} °/s", value)


def errors_grow(trial: Trial) -> Finding:
    """Measure the least growth of angle and speed error from one clearance to the next."""
    runs = trial.every_clearance()
    angle = np.array([mean_angle_error(run) for run in runs])
    speed = np.array([speed_trend(run) for run in runs])
    text = f"{listed(angle, '°')}; {listed(speed, '°/s')}"
    return Finding(text, min(least_growth(angle), least_growth(speed)))


def _claims(clearance: float, angle: float, speed: float, about: str) -> tuple[Claim, ...]:
    at = f"{clearance * 1e6:g} µm"
    return (
        Claim(
            f"angle error, {at}", "5.3, Fig. 16 (a)", f"at {at} the angle error is {about}{angle:g}°",
            near(angle, "°"), partial(angle_error, clearance=clearance),
            "mean of the smooth motion", varies=(FRICTION, ENTRY_VELOCITY),
        ),
        Claim(
            f"speed error, {at}", "5.3, Fig. 16 (b)", f"at {at} the speed error is {about}{speed:.2e} °/s",
            near(speed, "°/s"), partial(speed_error, clearance=clearance),
            "median of its mean over 0.2 s in smooth motion; the rest rings after the reversals, and the "
            "paper does not say at which instant it was read", varies=(FRICTION, ENTRY_VELOCITY),
        ),
        *all_joints.claims(clearance, angle, speed),
    )  # fmt: skip


CLAIMS: Final = (
    *_claims(CLEARANCES[0], 0.02, 2.5e-4, "about "),
    *_claims(CLEARANCES[-1], 0.043, 7.5e-4, ""),
    Claim(
        "errors grow",
        "5.3, Fig. 16; 6 (3)",
        "as the clearance increases, the errors increase",
        above(0.0, "% a step", by="the paper"),
        errors_grow,
    ),
)
"""Claims on accuracy."""
