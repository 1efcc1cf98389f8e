"""Largest difference of fitted friction laws from the measured torque of screw drives."""

import math
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.friction import FrictionLimit
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

Values = Mapping[str, float]
Law = Callable[[Values, FloatArray], FloatArray]
_PAYLOAD: Final = FitParameter("payload", -3.0, 3.0)
_MOVING: Final = (FitParameter("coulomb", 0.0, 10.0), FitParameter("viscous", 0.0, 1.0))
_STRIBECK: Final = (FitParameter("stribeck", -3.0, 3.0), FitParameter("stribeck_speed", 0.05, 50.0, True))


def friction(given: Values, speed: FloatArray, suffix: str = "") -> FloatArray:
    """Return friction [mN m] against the motion, shape of ``speed`` [rad/s]."""
    law = FrictionLimit(
        coulomb=given["coulomb" + suffix],
        viscous=given["viscous" + suffix],
        stribeck=given.get("stribeck" + suffix, 0.0),
        stribeck_speed=given.get("stribeck_speed" + suffix, 1.0),
        stribeck_exponent=1.0,
    )
    return np.asarray(np.sign(speed) * law(speed))


def symmetric(given: Values, speed: FloatArray) -> FloatArray:
    """Return the torque of a drive with one friction law and a payload."""
    return np.asarray(given["payload"] + friction(given, speed))


def by_direction(given: Values, speed: FloatArray) -> FloatArray:
    """Return the torque of a drive with a friction law for each direction."""
    return np.where(speed > 0.0, friction(given, speed, " forward"), friction(given, speed, " backward"))


def _both(parameters: tuple[FitParameter, ...]) -> tuple[FitParameter, ...]:
    return tuple(
        FitParameter(f"{one.name} {way}", one.low, one.high, one.logarithmic)
        for way in ("forward", "backward")
        for one in parameters
    )


#: Laws by name, with the parameters that are fitted; torques in mN m, speeds in rad/s.
LAWS: Final[dict[str, tuple[Law, tuple[FitParameter, ...]]]] = {
    "Coulomb + viscous": (symmetric, (_PAYLOAD, *_MOVING)),
    "Stribeck": (symmetric, (_PAYLOAD, *_MOVING, *_STRIBECK)),
    "Stribeck by direction": (by_direction, _both((*_MOVING, *_STRIBECK))),
}


def measured(one: ValidationSet, drive: str) -> tuple[FloatArray, FloatArray]:
    """Return speeds [rad/s] and mean torques [mN m] of a drive, shapes (n,)."""
    names = ("input_speed_rpm_mean", "input_torque_mN_m_mean")
    rpm, torque = one.columns("steady_state.csv", *names, where=("drive", drive))
    return np.radians(6.0 * rpm), torque


def fitted(one: ValidationSet, drive: str, name: str) -> LeastSquares:
    """Return the fit of a law to a drive; its residuals are relative differences [1]."""
    law, parameters = LAWS[name]
    speed, torque = measured(one, drive)
    return fit(lambda given: (law(given, speed) - torque) / np.abs(torque), parameters)


#: Bands by drive and law; other fits are reported.
JUDGED: Final = {
    ("1", "Coulomb + viscous"): "null_1",
    ("1", "Stribeck"): "fit_1",
    ("2", "Stribeck"): "fit_2",
    ("3", "Coulomb + viscous"): "null_3",
    ("3", "Stribeck"): "null_3",
    ("3", "Stribeck by direction"): "fit_3",
}


def compare(one: ValidationSet) -> Outcome:
    """Return the largest differences of all fits, and the part of the payload."""
    fits = {(drive, law): fitted(one, drive, law) for drive in "123" for law in LAWS}
    rows = [_payload(one, fits["1", "Stribeck"])]
    for (drive, law), found in fits.items():
        name, spread = f"drive {drive}, {law}, largest difference", one.value(f"spread_{drive}")
        null, band = _largest(fits[drive, "Coulomb + viscous"]), one.bands.get(JUDGED.get((drive, law), ""))
        rows.append(Comparison(name, "%", _largest(found), 0.0, 0.0, spread, null, band))
    return Outcome(tuple(rows), _plot(one, fits))


def _largest(found: LeastSquares) -> float:
    return 100.0 * float(np.abs(found.residuals).max())


def _payload(one: ValidationSet, found: LeastSquares) -> Comparison:
    """Return the fitted torque of the payload beside that of an ideal screw, W l/2π."""
    ideal = 1e3 * one.value("payload") * one.value("lead") / (2.0 * math.pi)
    note = "The measured value is that of an ideal screw, payload times lead over 2 pi."
    widths, name = (found.half_width("payload"), 0.0), "drive 1, torque of the payload"
    values, band = (abs(found.named["payload"]), ideal), one.bands["payload"]
    return Comparison(name, "mN m", *values, *widths, ideal, band, note=note)


def _plot(one: ValidationSet, fits: dict[tuple[str, str], LeastSquares]) -> Plot:
    best = {"1": "Stribeck", "2": "Stribeck", "3": "Stribeck by direction"}
    curves = []
    for drive, name in best.items():
        speed, torque = measured(one, drive)
        rpm, order = np.degrees(speed) / 6.0, np.argsort(speed)
        width = 0.01 * one.value(f"spread_{drive}") * np.abs(torque)
        values = LAWS[name][0](fits[drive, name].named, speed)
        curves.append(Curve(f"drive {drive}, measured", "measured", rpm, torque, width))
        curves.append(Curve(f"drive {drive}, {name}", "computed", rpm[order], values[order]))
    return Plot("input speed [rpm]", "input torque [mN m]", tuple(curves))
