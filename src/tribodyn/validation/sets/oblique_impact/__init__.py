"""Tangential restitution of an oblique impact, with and without tangential compliance."""

import math
from collections.abc import Mapping
from functools import partial
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.validation.base import Band, Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied
from tribodyn.validation.sets.oblique_impact.rebound import ImpactingSphere, Rebound, TangentialLaw, rebound

LAWS: Final[tuple[TangentialLaw, ...]] = ("regularised", "compliant")
SLIDING: Final = 30.0  #: Angle from which both laws are judged alike [deg].
STICKING: Final = 25.0  #: Angle below which the contact sticks for a part of the time [deg].
PLAIN_FAILS: Final = 10.0  #: Angle below which regularised friction must be shown failing [deg].


def compare(one: ValidationSet) -> Outcome:
    """Return the tangential restitution at every angle by both laws."""
    points = one.rows("tangential_restitution.csv")
    angles = [float(row["impact_angle_from_normal_deg"]) for row in points]
    measured = [float(row["tangential_restitution"]) for row in points]
    rows, curves = [], []
    for law in LAWS:
        result = varied(partial(restitutions, angles, law), one.inputs.values())
        curves.append(Curve(f"{law} friction", "computed", angles, result.values))
        for k, angle in enumerate(angles):
            name, widths = f"{law}, {angle:.1f} deg", (result.sides_at(k), one.value("reading"))
            by_hand, band = null_model(one, angle), _band(one, law, angle)
            rows.append(Comparison(name, "", result.values[k], measured[k], *widths, by_hand, band))
    width = [one.value("reading")] * len(angles)
    points_of = Curve("measured", "measured", angles, measured, width)
    null = Curve("momentum and Coulomb", "null", angles, [null_model(one, angle) for angle in angles])
    return Outcome(
        tuple(rows), Plot("angle from the normal [deg]", "tangential restitution", (points_of, *curves, null))
    )


def impact(given: Mapping[str, float], angle: float, law: TangentialLaw) -> Rebound:
    """Return the rebound at an angle of incidence [deg]."""
    sphere = ImpactingSphere(
        radius=0.5 * given["diameter"],
        density=given["density"],
        young_modulus=(given["young_sphere"], given["young_plate"]),
        poisson_ratio=(given["poisson_sphere"], given["poisson_plate"]),
        friction=given["friction"],
        restitution=given["restitution"],
        slip_velocity=given["slip_velocity"],
    )
    return rebound(sphere, given["speed"], math.radians(angle), law, steps=int(given["steps"]))


def restitutions(angles: list[float], law: TangentialLaw, given: Mapping[str, float]) -> FloatArray:
    """Return the tangential restitution at angles of incidence [deg], shape (n,)."""
    return np.array([impact(given, angle, law).tangential for angle in angles])


def null_model(one: ValidationSet, angle: float) -> float:
    """Return the restitution by momentum and Coulomb's law [1] at an angle of incidence [deg]."""
    return by_momentum({name: given.value for name, given in one.inputs.items()}, angle)


def by_momentum(given: Mapping[str, float], angle: float) -> float:
    """Return the restitution by momentum and Coulomb's law [1] for inputs; see :func:`null_model`."""
    lost = given["friction"] * (1.0 + given["restitution"]) / math.tan(math.radians(angle))
    return max(1.0 - lost, 5.0 / 7.0) if angle < SLIDING else 1.0 - lost


def _band(one: ValidationSet, law: TangentialLaw, angle: float) -> Band | None:
    if angle >= SLIDING:
        return one.bands["sliding"]
    if law == "compliant":
        return one.bands["compliant"] if angle < STICKING else None
    return one.bands["plain"] if angle < PLAIN_FAILS else None
