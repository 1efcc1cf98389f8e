"""Claims on the error of the vane: section 5.3, Fig. 16."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims import all_joints
from tribodyn.papers.cheng_2022.claims.base import (
    MANY_RUNS,
    Claim,
    Finding,
    Trial,
    above,
    least_growth,
    listed,
    near,
    of_instants,
    trend,
)
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
    """Measure the mean size of the angle error."""
    value = mean_angle_error(trial.vsv(clearance))
    return Finding(f"{value:.3g} °", value)


def speed_error(trial: Trial, clearance: float) -> Finding:
    """Measure the size of the speed error, over all instants."""
    run = trial.vsv(clearance)
    return of_instants(run["time"].values, _angle_error(run), run)


def errors_grow(trial: Trial) -> Finding:
    """Measure the least growth of angle and speed error from one clearance to the next."""
    runs = trial.every_clearance()
    angle = np.array([mean_angle_error(run) for run in runs])
    speed = np.array([speed_trend(run) for run in runs])
    text = f"{listed(angle, '°')}; {listed(speed, '°/s')}"
    return Finding(text, min(least_growth(angle), least_growth(speed)))


def _claims(
    clearance: float, angle: float, speed: float, about: str, sentences: tuple[str, str, str]
) -> tuple[Claim, ...]:
    at = f"{clearance * 1e6:g} µm"
    return (
        Claim(
            f"angle error, {at}", sentences[:1], f"at {at} the angle error is {about}{angle:g}°",
            "smooth motion", near(angle, "°"), partial(angle_error, clearance=clearance),
        ),
        Claim(
            f"speed error, {at}", sentences[1:2], f"at {at} the speed error is {about}{speed:.2e} °/s",
            "smooth motion", near(speed, "°/s"), partial(speed_error, clearance=clearance),
            "the paper does not say at which instant it was read",
        ),
        *all_joints.claims(clearance, angle, speed, sentences[2]),
    )  # fmt: skip


#: Claims on accuracy.
CLAIMS: Final = (
    *_claims(CLEARANCES[0], 0.02, 2.5e-4, "about ", ("C1", "C2", "C3")),
    *_claims(CLEARANCES[-1], 0.043, 7.5e-4, "", ("C5", "C5", "C5")),
    Claim(
        "errors grow",
        ("C4", "A4", "K6"),
        "as the clearance increases, the errors increase",
        "smooth motion",
        above(0.0, "% a step", by="the paper"),
        errors_grow,
        leave=MANY_RUNS,
    ),
)
