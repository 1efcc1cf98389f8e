"""Play and compliance of a servo joint, fitted to its deviation with and without load."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.units import number_in
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import Input, ValidationSet

SINGLE: Final = "single STS3215"
#: Play and dead band [deg], compliance [deg/(N m)], torque [N m].
PARAMETERS: Final = (
    FitParameter("play", 0.0, 3.0),
    FitParameter("compliance", 0.0, 20.0),
    FitParameter("torque", 0.0, 1.0),
    FitParameter("dead_band", 0.0, 1.0),
)


def compare(one: ValidationSet) -> Outcome:
    """Return play and compliance with intervals, and the deviations of the fit."""
    rows = []
    for name in ("single STS3215", "single STS3250"):
        found = fitted(one, name)
        low, high = interval(found, "play")
        judged = name == SINGLE
        band = one.bands["play"] if judged else None
        play = band.covers[0] if band is not None and band.covers else None
        facts = 0.5 * (high - low), 0.0, measured(one, name)["released"], band, (low, high)
        rows.append(Comparison(f"{name}, play", "deg", found.named["play"], play, *facts))
        low, high = interval(found, "compliance")
        note = "The measured value is the droop of servo_gear_friction at 12 V." if judged else ""
        value, droop = found.named["compliance"], one.value("droop") if judged else None
        # As if there were no play.
        straight = 0.5 * measured(one, name)["loaded"] / one.inputs["torque"].value
        facts = 0.5 * (high - low), 0.0, straight, None, (low, high)
        rows.append(Comparison(f"{name}, compliance", "deg per N m", value, droop, *facts, note=note))
    return Outcome(tuple(rows), _plot(one))


def deviations(given: Mapping[str, float]) -> FloatArray:
    """Return released and loaded deviation [deg], shape (2,)."""
    released = given["play"] + given["dead_band"]
    return np.array([released, released + 2.0 * given["compliance"] * given["torque"]])


def measured(one: ValidationSet, name: str) -> dict[str, float]:
    """Return released and loaded deviation of a configuration [deg]."""
    rows = [row for row in one.rows("deviation.csv") if row["configuration"] == name]
    return {row["state"]: float(row["recomputed_deg"]) for row in rows}


def fitted(one: ValidationSet, name: str) -> LeastSquares:
    """Return the fit to a configuration; residuals are over half widths."""
    deviation = measured(one, name)
    data = np.array([deviation["released"], deviation["loaded"]])
    errors = np.array([_in_degrees(one.inputs[f"{state}_error"]) for state in ("released", "loaded")])
    torque, band = one.inputs["torque"], one.inputs["dead_band"]
    middle = _in_degrees(band)

    def residuals(given: Mapping[str, float]) -> FloatArray:
        known = [
            (given["torque"] - torque.value) / (0.5 * (torque.high - torque.low)),
            (given["dead_band"] - middle) / middle,
        ]
        return np.append((deviations(given) - data) / errors, known)

    return fit(residuals, PARAMETERS, starts=2)


def interval(found: LeastSquares, name: str) -> tuple[float, float]:
    """Return the interval of a parameter from the half widths of data and inputs."""
    k = [parameter.name for parameter in found.parameters].index(name)
    half = float(np.sqrt(found.covariance(known_noise=True)[k, k]))
    return found.named[name] - half, found.named[name] + half


def _in_degrees(given: Input) -> float:
    return number_in(given.value, "deg")


def _plot(one: ValidationSet) -> Plot:
    curves = []
    for name in ("single STS3215", "single STS3250"):
        found = fitted(one, name)
        values, data = deviations(found.named), measured(one, name)
        widths = [_in_degrees(one.inputs[f"{state}_error"]) for state in ("released", "loaded")]
        torque = found.named["torque"]
        points = [data["released"], data["loaded"]]
        curves.append(Curve(f"{name}, measured", "measured", [0.0, torque], points, widths))
        curves.append(Curve(f"{name}, fitted", "computed", [0.0, torque], values))
    return Plot("alternating torque [N m]", "deviation [deg]", tuple(curves))
