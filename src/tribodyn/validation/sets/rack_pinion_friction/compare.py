"""Root mean square difference of a fitted Stribeck law from the friction force of a rack and pinion."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.friction import FrictionLimit
from tribodyn.studies.least_squares import FitParameter, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

PARAMETERS: Final = (
    FitParameter("coulomb", 0.0, 60.0),
    FitParameter("viscous", 0.0, 300.0),
    FitParameter("stribeck", 0.0, 100.0),
    FitParameter("stribeck_speed", 1e-3, 0.5, True),
)
"""Forces [N], viscous coefficient [N s/m], speed [m/s]."""


def compare(one: ValidationSet) -> Outcome:
    """Return the root mean square difference, and that of the authors' law."""
    rows = one.rows("measured_curve.csv")
    speed = np.array([float(row["speed_m_s"]) for row in rows])
    force = np.array([float(row["friction_force_N"]) for row in rows])
    found = fit(lambda given: law(given, speed) - force, PARAMETERS)
    line = np.polyval(np.polyfit(speed, force, 1), speed)
    authors = {row["parameter"]: float(row["value"]) for row in one.rows("authors_fit.csv")}
    theirs = _authors(authors, speed)
    oscillation = one.value("oscillation") / math.sqrt(2.0)
    fitted = Comparison(
        "fitted Stribeck law, root mean square difference",
        "N",
        computed=_rms(found.residuals),
        measured=0.0,
        u_measured=math.hypot(oscillation, one.value("reading")),
        null=_rms(line - force),
        band=one.bands["rms"],
    )
    published = Comparison(
        "law of the authors, root mean square difference",
        "N",
        computed=_rms(theirs - force),
        measured=4.1,
        null=_rms(line - force),
        note="The measured value is the one stated by the collection: a check of its formula.",
    )
    measured = Curve(
        "measured", "measured", speed.tolist(), force.tolist(), [one.value("reading")] * len(rows)
    )
    fit_curve = Curve("fitted Stribeck law", "computed", speed.tolist(), law(found.named, speed).tolist())
    null = Curve("straight line", "null", speed.tolist(), line.tolist())
    return Outcome(
        (fitted, published), Plot("speed [m/s]", "friction force [N]", (measured, fit_curve, null))
    )


def law(given: Mapping[str, float], speed: FloatArray) -> FloatArray:
    """Return the friction force [N] at speeds [m/s]."""
    return FrictionLimit(**given, stribeck_exponent=1.0)(speed)


def _authors(given: Mapping[str, float], speed: FloatArray) -> FloatArray:
    rise = (given["F_max"] - given["dry"]) * math.e / given["v_strib"]
    return np.asarray(
        given["dry"] + given["viscous"] * speed + speed * rise * np.exp(-speed / given["v_strib"])
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
