"""Shape of a Stribeck curve in mixed friction."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si
from tribodyn.mechanism.analyses.shaft_in_bore import equilibria, journal_of
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied

#: Speeds of the measured curves [rpm], falling, so that each equilibrium starts from the one before.
SPEEDS: Final = np.array([140.0, 130.0, 120.0, 110.0, 100.0, 90.0, 80.0, 70.0, 60.0, 55.0, 50.0, 45.0, 42.0])
_BEARING: Final = "joints.bearing"
_SEARCHED: Final = (
    "The inputs were searched for with the band known; 27 of 300 random choices have the shape."
)
_HOURS: Final = ("3h", "6h", "30h", "36h", "60h")


def compare(one: ValidationSet) -> Outcome:
    """Return place of the minimum, both ratios, and the least friction."""
    result = varied(lambda given: shape(curve(given)), one.inputs.values())
    measured = _measured(one)
    names = ("speed of least friction", "mu(140 rpm) / mu(min)", "mu(42 rpm) / mu(min)", "least friction")
    units = ("rpm", "", "", "1e-3")
    nulls = (0.5 * (SPEEDS[0] + SPEEDS[-1]), 1.0, 1.0, 1e3 * petroff(one, measured[0][0]))
    bands = (one.bands["minimum"], one.bands["fast"], one.bands["slow"], None)
    rows = []
    for k, (value, width) in enumerate(measured):
        known, why = (names[k], units[k], result.values[k]), "" if bands[k] is None else _SEARCHED
        sides = result.sides_at(k)
        rows.append(Comparison(*known, value, sides, width, nulls[k], bands[k], not_judged=why))
    return Outcome(tuple(rows), _plot(one))


def petroff(one: ValidationSet, speed: float) -> float:
    """Return the friction coefficient of a centred journal at a speed [rpm], by N. Petroff's formula."""
    pressure, gap = one.value("pressure"), one.value("clearance")
    surface_speed = math.radians(6.0 * speed) * one.value("radius")
    return math.pi * one.value("viscosity") * surface_speed / (gap * pressure)


def curve(given: Mapping[str, float]) -> FloatArray:
    """Return the friction coefficient at :data:`SPEEDS` [1], shape (13,)."""
    each, cells = given["roughness"] / math.sqrt(2.0), int(given["cells"])
    tip = given["roughness"] / given["tip_ratio"]
    keys: dict[str, object] = {
        f"{_BEARING}.clearance.radius": from_si(given["radius"], "mm"),
        f"{_BEARING}.clearance.length": from_si(given["length"], "mm"),
        f"{_BEARING}.clearance.radial": from_si(given["clearance"], "um"),
        f"{_BEARING}.clearance.friction_coefficient": given["boundary_friction"],
        f"{_BEARING}.film.viscosity": from_si(given["viscosity"], "mPa s"),
        f"{_BEARING}.film.grid.theta": cells,
        "solver.grid.theta": cells,
        "surfaces.trunnion.roughness": from_si(each, "um"),
        "surfaces.bushing.roughness": from_si(each, "um"),
        "surfaces.bushing.young_modulus": from_si(given["young_bushing"], "GPa"),
        "asperities.radius": from_si(tip, "um"),
        "asperities.density": from_si(given["asperities"] / (tip * given["roughness"]), "1/um^2"),
        "contact.law": "gt",
        "contact.damping_factor": "none",
    }
    load = given["pressure"] * 2.0 * given["radius"] * given["length"]
    journal = journal_of(load_case("journal-oil").replace(keys), load=load)
    return np.array([point.friction_coefficient for point in equilibria(journal, np.radians(6.0 * SPEEDS))])


def shape(friction: FloatArray) -> FloatArray:
    """Return speed of the minimum [rpm], both ratios and the least friction [1e-3], shape (4,).

    Inside the range the minimum is that of the parabola through its three lowest neighbours.
    """
    k = int(friction.argmin())
    speed, least = SPEEDS[k], friction[k]
    if 0 < k < SPEEDS.size - 1:
        a, b, c = np.polyfit(SPEEDS[k - 1 : k + 2], friction[k - 1 : k + 2], 2)
        speed, least = -b / (2.0 * a), c - b**2 / (4.0 * a)
    return np.array([speed, friction[0] / least, friction[-1] / least, 1e3 * least])


def _curves(one: ValidationSet) -> dict[str, FloatArray]:
    """Return the measured curves at :data:`SPEEDS` [1e-3]; NaN where one is hidden under another."""
    rows = {float(row["speed_rpm"]): row for row in one.rows("stribeck_curves.csv")}
    return {
        hours: np.array([float(rows[s][f"friction_coefficient_1e-3_after_{hours}"] or "nan") for s in SPEEDS])
        for hours in _HOURS
    }


def _measured(one: ValidationSet) -> list[tuple[float, float]]:
    """Return mean and half range over the curves of the four quantities."""
    names = ("speed_at_minimum_rpm", "minimum_friction_coefficient_1e-3")
    speeds, least = one.columns("minimum.csv", *names)
    curves = np.array(list(_curves(one).values()))
    columns = (speeds, curves[:, 0] / least, curves[:, -1] / least, least)
    return [(float(np.nanmean(x)), float(0.5 * (np.nanmax(x) - np.nanmin(x)))) for x in columns]


def _plot(one: ValidationSet) -> Plot:
    given = {name: known.value for name, known in one.inputs.items()}
    computed = curve(given)
    measured = [
        Curve(f"measured after {hours}", "measured", SPEEDS, (values / np.nanmin(values)))
        for hours, values in _curves(one).items()
    ]
    own = Curve("computed", "computed", SPEEDS, (computed / computed.min()))
    return Plot("speed [rpm]", "friction over least friction", (*measured, own))
