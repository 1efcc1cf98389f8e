"""Largest difference of fitted friction laws from the measured torque of screw drives."""

import math
from typing import Final

import numpy as np

from tribodyn.studies.least_squares import LeastSquares
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet
from tribodyn.validation.sets.screw_drive_friction.laws import LAWS, fitted, measured

JUDGED: Final = {
    ("1", "Coulomb + viscous"): "null_1",
    ("1", "Stribeck"): "fit_1",
    ("2", "Stribeck"): "fit_2",
    ("3", "Coulomb + viscous"): "null_3",
    ("3", "Stribeck"): "null_3",
    ("3", "Stribeck by direction"): "fit_3",
}
"""Bands by drive and law; other fits are reported."""


def compare(one: ValidationSet) -> Outcome:
    """Return the largest differences of all fits, and the part of the payload."""
    fits = {(drive, law): fitted(one, drive, law) for drive in "123" for law in LAWS}
    rows = [_payload(one, fits["1", "Stribeck"])]
    for (drive, law), found in fits.items():
        band = JUDGED.get((drive, law))
        rows.append(
            Comparison(
                f"drive {drive}, {law}, largest difference",
                "%",
                computed=_largest(found),
                measured=0.0,
                u_measured=one.value(f"spread_{drive}"),
                null=_largest(fits[drive, "Coulomb + viscous"]),
                band=None if band is None else one.bands[band],
            )
        )
    return Outcome(tuple(rows), _plot(one, fits))


def _largest(found: LeastSquares) -> float:
    return 100.0 * float(np.abs(found.residuals).max())


def _payload(one: ValidationSet, found: LeastSquares) -> Comparison:
    """Return the fitted torque of the payload beside that of an ideal screw, W l/2π."""
    ideal = 1e3 * one.value("payload") * one.value("lead") / (2.0 * math.pi)
    return Comparison(
        "drive 1, torque of the payload",
        "mN m",
        computed=abs(found.named["payload"]),
        measured=ideal,
        u_computed=found.half_width("payload"),
        null=ideal,
        band=one.bands["payload"],
        note="The measured value is that of an ideal screw, payload times lead over 2 pi.",
    )


def _plot(one: ValidationSet, fits: dict[tuple[str, str], LeastSquares]) -> Plot:
    best = {"1": "Stribeck", "2": "Stribeck", "3": "Stribeck by direction"}
    curves = []
    for drive, name in best.items():
        speed, torque = measured(one, drive)
        rpm, order = np.degrees(speed) / 6.0, np.argsort(speed)
        width = 0.01 * one.value(f"spread_{drive}") * np.abs(torque)
        values = LAWS[name][0](fits[drive, name].named, speed)
        curves.append(
            Curve(f"drive {drive}, measured", "measured", rpm.tolist(), torque.tolist(), width.tolist())
        )
        curves.append(
            Curve(f"drive {drive}, {name}", "computed", rpm[order].tolist(), values[order].tolist())
        )
    return Plot("input speed [rpm]", "input torque [mN m]", tuple(curves))
