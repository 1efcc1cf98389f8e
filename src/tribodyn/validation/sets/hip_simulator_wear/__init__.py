"""Worn volume of a ball joint in a hip simulator: what it depends on, and the interval of one joint."""

import math
from functools import cache
from importlib.resources import as_file
from typing import Final

import xarray as xr

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

SWING: Final = 0.95  #: Amplitude of the load over its mean: it is nearly gone between two steps.
MEAN: Final = 1.0e3  #: Mean of a sinusoidal load of 2 kN at most [N].
CLARKE: Final = 11.0  #: Radius of the head of the set ``clarke`` [mm].
SAIKKO: Final = 16.0
_ANGLE: Final = math.radians(23.0)


@cache
def cycle(radius: float, load: float = MEAN, changes: tuple[tuple[str, str], ...] = ()) -> xr.Dataset:
    """Return a cycle of the simulator with a radius of the head [mm], a mean load [N] and changed keys."""
    keys = {
        "joints.hip.clearance.radius": f"{radius} mm",
        "loads.body.force.value": f"{load} N",
        "loads.body.force.amplitude": f"{SWING * load} N",
        **dict(changes),
    }
    return ValidationSet("hip_simulator_wear").simulated("simulator.toml", keys)


def load_path(one: ValidationSet, run: xr.Dataset) -> float:
    """Return the load times the path of a cycle [N m]."""
    return float(run.attrs["worn_volume"]) / one.value("rate")


def ends(one: ValidationSet) -> dict[str, tuple[tuple[str, str], ...]]:
    """Return the changes of the case at the ends of clearance and modulus, by name."""
    clearance, modulus = one.inputs["clearance"], one.inputs["modulus"]
    return {
        "least clearance": (("joints.hip.clearance.radial", f"{clearance.low} m"),),
        "largest clearance": (("joints.hip.clearance.radial", f"{clearance.high} m"),),
        "least modulus": (("surfaces.bushing.young_modulus", f"{modulus.low} Pa"),),
        "largest modulus": (("surfaces.bushing.young_modulus", f"{modulus.high} Pa"),),
    }


def by_hand(radius: float, load: float) -> float:
    """Return the load times the path of a point on a circle about the axis of the load [N m]."""
    return load * 1e-3 * radius * 2.0 * math.pi * math.sin(_ANGLE)


def compare(one: ValidationSet) -> Outcome:
    """Return volumes over clearance and modulus, load times path, the stated interval, and depths."""
    usual, rows = load_path(one, cycle(CLARKE)), []
    for end, changes in ends(one).items():
        name = f"worn volume at the {end}, over that in the middle"
        ratio = load_path(one, cycle(CLARKE, changes=changes)) / usual
        rows.append(Comparison(name, "", ratio, 1.0, null=1.0, band=one.bands["volume"]))
    name = "metal on metal, wear of the first million cycles over that of a later one"
    note = "Measured: more than 3, by the sign of two abstracts. One wear rate cannot give it."
    rows += [*_saikko(one), _interval(one), *_depths(one), Comparison(name, "", 1.0, null=1.0, note=note)]
    return Outcome(tuple(rows), _plot(one))


def _saikko(one: ValidationSet) -> list[Comparison]:
    """Return load times path over the mean loads of walking, and the loss of weight that follows."""
    load = one.inputs["load"]
    paths = [load_path(one, cycle(SAIKKO, mean)) for mean in (load.value, load.low, load.high)]
    loss = 1e6 * paths[0] * one.value("rate") * 1e9 * one.value("density")
    row = next(row for row in one.rows("wear.csv") if row["set"] == "saikko")
    sides, null = (paths[0] - paths[1], paths[2] - paths[0]), by_hand(SAIKKO, load.value)
    judged = None, sides, 0.0, null, one.bands["path"], (paths[1], paths[2])
    mean, least, most = (float(row[f"wear_rate{end}"]) for end in ("", "_min", "_max"))
    measured = mean, 0.0, max(mean - least, most - mean), mean
    note = "Five equal joints lost 0.4 to 7.1 mg."
    return [
        Comparison("saikko, load times path", "N m a cycle", paths[0], *judged),
        Comparison("saikko, loss of weight", "mg in a million cycles", loss, *measured, note=note),
    ]


def _interval(one: ValidationSet) -> Comparison:
    """Return the interval that is stated for one joint from a rate alone, over the nominal wear."""
    with as_file(one.folder / "simulator.toml") as model:
        low, high = load_case(str(model)).wear_scatter()["hip"]
    return Comparison(
        "stated interval of the wear of one joint", "of the nominal", 1.0, null=1.0,
        band=one.bands["interval"], spread=(low, high),
    )  # fmt: skip


def _depths(one: ValidationSet) -> list[Comparison]:
    """Return the depths of a million cycles at three clearances, by the volume of the set ``clarke``."""
    row = next(row for row in one.rows("wear.csv") if row["set"] == "clarke")
    volume = float(row["wear_rate"]) * 1e-9
    changes = {"middle clearance": (), **ends(one)}
    rows = []
    for name in ("least clearance", "middle clearance", "largest clearance"):
        run = cycle(CLARKE, changes=changes[name])
        depth = 1e6 * volume * float(run["wear_depth"].max()) / float(run.attrs["worn_volume"])
        shell = 1e6 * volume / (2.0 * math.pi * (1e-3 * CLARKE) ** 2)
        note = "From one cycle, without the worn shape; the null model spreads the volume over half the ball."
        rows.append(Comparison(f"clarke, depth at the {name}", "um", depth, null=shell, note=note))
    return rows


def _plot(one: ValidationSet) -> Plot:
    radii = (CLARKE, 14.0, SAIKKO)
    values = [load_path(one, cycle(radius)) for radius in radii]
    hand = [by_hand(radius, MEAN) for radius in radii]
    curves = Curve("computed", "computed", radii, values), Curve("by hand", "null", radii, hand)
    return Plot("radius of the head [mm]", "load times path [N m a cycle]", curves)
