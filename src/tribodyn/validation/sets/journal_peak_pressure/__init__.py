"""Peak film pressure of the rig, from the equilibrium of a journal in oil."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np
from scipy.optimize import root

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si
from tribodyn.core.errors import InputError
from tribodyn.lubrication import FilmState, film_state
from tribodyn.mechanism.analyses.shaft_in_bore import Journal, equilibrium, journal_of
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied

JUDGED_SPEED: Final = 250.0  #: Speed at which the film is judged [rpm].
_BEARING: Final = "joints.bearing"
_NULL: Final = "isothermal_peak_computed_kPa"


def compare(one: ValidationSet) -> Outcome:
    """Return the peak pressures [kPa] at all points."""
    points = one.rows("peak_pressure.csv")
    places = [(float(row["speed_rpm"]), float(row["load_N"])) for row in points]
    result = varied(lambda given: peaks(given, places), one.inputs.values())
    gauge = one.value("gauge") / 1e3
    rows = []
    for k, ((speed, load), row) in enumerate(zip(places, points, strict=True)):
        low, high = map(float, result.spread("viscosity")[:, k])
        judged = (one.bands["peak_pressure"], (low, high)) if speed == JUDGED_SPEED else (None, None)
        name, value = f"{speed:g} rpm, {load:g} N", float(row["peak_pressure_measured_kPa"])
        widths = result.sides_at(k), gauge
        rows.append(Comparison(name, "kPa", result.values[k], value, *widths, float(row[_NULL]), *judged))
    return Outcome(tuple(rows), _plot(rows, places))


def peaks(given: Mapping[str, float], places: list[tuple[float, float]]) -> FloatArray:
    """Return the peak pressures in the middle plane at (speed [rpm], load [N]), shape (n,) [kPa]."""
    return np.array([_peak(given, math.radians(6.0 * speed), load) / 1e3 for speed, load in places])


def rig(given: Mapping[str, float], load: float) -> Journal:
    """Return the rig under a load [N]."""
    base = load_case("journal-oil")
    keys: dict[str, object] = {
        f"{_BEARING}.clearance.radial": from_si(given["clearance"], "um"),
        f"{_BEARING}.clearance.radius": from_si(given["radius"], "mm"),
        f"{_BEARING}.clearance.length": from_si(given["length"], "mm"),
        "surfaces.trunnion.roughness": f"Ra {from_si(given['roughness_journal'], 'um')}",
        "surfaces.bushing.roughness": f"Ra {from_si(given['roughness_bearing'], 'um')}",
        f"{_BEARING}.film.viscosity": from_si(given["viscosity"], "mPa s"),
        f"{_BEARING}.film.boundary": "groove" if given["groove"] else "periodic",
        f"{_BEARING}.film.grid.theta": int(given["cells"]),
    }
    return journal_of(base.replace(keys), load=load)


def _peak(given: Mapping[str, float], speed: float, load: float) -> float:
    """Return the peak pressure in the middle plane [Pa]; speed in rad/s."""
    journal = rig(given, load)
    film = journal.film
    assert film is not None
    start = equilibrium(journal, speed=speed).centre
    full = given["tilt"] * film.clearance / film.length
    for tilt in (full, 0.5 * full):
        try:
            state = _balanced(journal, speed, start, tilt)
        except InputError:
            continue  # the gap closes at this tilt
        return float(state.pressure[film.grid.z // 2].max())
    raise InputError("no film carries the load at half of the tilt", key="tilt")


def _balanced(journal: Journal, speed: float, start: FloatArray, tilt: float) -> FilmState:
    """Return the film where it carries the load with a tilt of the shaft [rad] in the plane of the load."""
    film, load = journal.film, journal.force
    assert film is not None
    data, memory = film.data(), film.memory()

    def state(share: FloatArray) -> FilmState:
        y = np.concatenate([film.clearance * share, [0.0, tilt], np.zeros(4)])
        return film_state(data, y, omega=speed, memory=memory)

    def residual(share: FloatArray) -> FloatArray:
        missed: FloatArray = np.array(state(share).force) / load + np.array([1.0, 0.0])
        return missed

    found = root(residual, start / film.clearance)
    if not found.success:
        raise InputError("no equilibrium of the film was found", key="tilt")
    return state(np.asarray(found.x))


def _plot(rows: list[Comparison], places: list[tuple[float, float]]) -> Plot:
    curves = []
    for load in dict.fromkeys(load for _, load in places):
        at = [k for k, place in enumerate(places) if place[1] == load]
        speeds, some = [places[k][0] for k in at], [rows[k] for k in at]
        measured = [row.measured for row in some if row.measured is not None]
        widths = [row.u_measured for row in some]
        curves.append(Curve(f"{load:g} N, measured", "measured", speeds, measured, widths))
        curves.append(Curve(f"{load:g} N, computed", "computed", speeds, [row.computed for row in some]))
    return Plot("speed [rpm]", "peak pressure [kPa]", tuple(curves))
