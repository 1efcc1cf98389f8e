"""Root mean square difference of a fitted Stribeck law from the friction force of a rack and pinion."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.friction import FrictionLimit
from tribodyn.studies.least_squares import FitParameter, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot, rms
from tribodyn.validation.catalogue import ValidationSet

#: Forces [N], viscous coefficient [N s/m], speed [m/s].
PARAMETERS: Final = (
    FitParameter("coulomb", 0.0, 60.0),
    FitParameter("viscous", 0.0, 300.0),
    FitParameter("stribeck", 0.0, 100.0),
    FitParameter("stribeck_speed", 1e-3, 0.5, True),
)


def compare(one: ValidationSet) -> Outcome:
    """Return the root mean square difference, and that of the authors' law."""
    speed, force = one.columns("measured_curve.csv", "speed_m_s", "friction_force_N")
    found = fit(lambda given: law(given, speed) - force, PARAMETERS)
    line = np.polyval(np.polyfit(speed, force, 1), speed)
    authors = {row["parameter"]: float(row["value"]) for row in one.rows("authors_fit.csv")}
    theirs = _authors(authors, speed)
    oscillation = one.value("oscillation") / math.sqrt(2.0)
    width, straight = math.hypot(oscillation, one.value("reading")), rms(line - force)
    name = "root mean square difference"
    note = "The measured value is the one stated by the collection: a check of its formula."
    values = rms(found.residuals), 0.0, 0.0, width, straight, one.bands["rms"]
    fitted = Comparison(f"fitted Stribeck law, {name}", "N", *values)
    of_authors = rms(theirs - force), 4.1, 0.0, 0.0, straight
    published = Comparison(f"law of the authors, {name}", "N", *of_authors, note=note)
    measured = Curve("measured", "measured", speed, force, [one.value("reading")] * speed.size)
    fit_curve = Curve("fitted Stribeck law", "computed", speed, law(found.named, speed))
    null = Curve("straight line", "null", speed, line)
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
