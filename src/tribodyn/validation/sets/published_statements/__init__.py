"""Sign and order of published effects: torque, wear and impacts over clearance, cycles and speed."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si
from tribodyn.mechanism.analyses.shaft_in_bore import equilibrium, journal_of
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate
from tribodyn.validation.base import Band, Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied

MEASURED_RATIO: Final = 1.5  #: Ratio of the first torques with interference and with clearance.
CLEARANCES: Final = (20.0, 40.0, 80.0)  #: Radial clearances of the wrist of the slider-crank [um].
SPEEDS: Final = (500.0, 1000.0, 2000.0)  #: Speeds of its motor [rpm].


def compare(one: ValidationSet) -> Outcome:
    """Return torque ratios, growth of wear, and growth of impacts."""
    order = replace(one.bands["order"], at_least=0.0)
    narrow, wide = one.value("narrow"), one.value("wide")
    ratios = varied(
        lambda given: np.array([torque_ratio(given, narrow), torque_ratio(given, wide)]), one.inputs.values()
    )
    rows, band = [], one.bands["ratio"]
    for k, (label, null) in enumerate((("narrow", 0.5 * np.pi), ("wide", 1.0))):
        name, (low, high) = f"torque / (mu W R), {label} clearance", ratios.spread("load", "liner")[:, k]
        sides = ratios.sides_at(k)
        rows.append(Comparison(name, "", ratios.values[k], None, sides, 0.0, null, band, (low, high)))
    quotient, name = float(ratios.values[0] / ratios.values[1]), "torque, narrow over wide clearance"
    note = "The measured ratio belongs to an interference fit, which adds pressure of its own."
    rows.append(Comparison(name, "", quotient, MEASURED_RATIO, null=0.5 * np.pi, note=note))
    rows += [*_wear(one, order), *_impacts(order)]
    return Outcome(tuple(rows), _plot(one))


def torque_ratio(given: Mapping[str, float], clearance: float) -> float:
    """Return friction torque over μ W R of a PTFE bushing with a radial clearance [m]."""
    keys: dict[str, object] = {
        "surfaces.bushing.material": "ptfe",
        "contact.law": "gt",
        "contact.damping_factor": "none",
        "joints.bearing.clearance.radial": from_si(clearance, "um"),
        "joints.bearing.clearance.friction_coefficient": given["friction"],
        "joints.bearing.clearance.liner.thickness": from_si(given["liner"], "mm"),
    }
    journal = journal_of(load_case("journal-dry").replace(keys), load=given["load"])
    return equilibrium(journal, speed=1.0).friction_coefficient / given["friction"]


def _wear(one: ValidationSet, order: Band) -> list[Comparison]:
    """Return the least growth of the worn volume between stops, and its distance from a straight line."""
    run = simulate(load_case("vsv").replace({"wear.cycles": int(one.value("wear_cycles"))}))
    cycles, volume = run["wear_cycles"].values, run["wear_volume"].values
    line = volume[-1] * cycles / cycles[-1]
    growth, steady = (float(np.diff(values).min() * 1e12) for values in (volume, line))
    name = "worn volume, least growth between two stops"
    apart = 100.0 * float(np.abs(volume - line).max() / volume[-1])
    of_line = "worn volume, largest distance from a straight line"
    return [
        Comparison(name, "1e-3 mm3", growth, null=steady, band=order),
        Comparison(of_line, "% of the last", apart, 0.0, null=0.0),
    ]


def impact_force(clearance: float, speed: float) -> float:
    """Return the peak contact force of the slider-crank [N] at a clearance [um] and a speed [rpm]."""
    changes = {
        "joints.wrist.clearance.radial": f"{clearance} um",
        "drives.motor.speed": f"{speed} rpm",
        "run.cycles": 1,
    }
    return float(simulate(load_case("slider-crank").replace(changes))["contact_force"].max())


def _impacts(order: Band) -> list[Comparison]:
    rows = []
    by_clearance = [impact_force(clearance, SPEEDS[1]) for clearance in CLEARANCES]
    by_speed = [impact_force(CLEARANCES[0], speed) for speed in SPEEDS]
    # Null model: forces of inertia alone, as without clearance.
    for name, places, forces, unit, power in (
        ("clearance", CLEARANCES, by_clearance, "um", 0),
        ("speed", SPEEDS, by_speed, "rpm", 2),
    ):
        for k in range(2):
            label = f"growth of the peak force with {name}, {places[k]:g} to {places[k + 1]:g} {unit}"
            null = forces[k] * ((places[k + 1] / places[k]) ** power - 1.0)
            rows.append(Comparison(label, "N", forces[k + 1] - forces[k], null=null, band=order))
    return rows


def _plot(one: ValidationSet) -> Plot:
    given = {name: known.value for name, known in one.inputs.items()}
    clearances: FloatArray = np.geomspace(one.value("narrow"), one.value("wide"), 9)
    ratios = [torque_ratio(given, float(clearance)) for clearance in clearances]
    micrometres = 1e6 * clearances
    return Plot(
        "radial clearance [um]",
        "torque / (mu W R)",
        (
            Curve("PTFE bushing", "computed", micrometres, ratios),
            Curve("line contact", "null", micrometres, [1.0] * len(micrometres)),
            Curve(
                "uniform pressure over a half circle", "null", micrometres, [0.5 * np.pi] * len(micrometres)
            ),
        ),
    )
