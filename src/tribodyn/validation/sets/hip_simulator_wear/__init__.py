"""Worn volume of a ball joint in a hip simulator: what it depends on, and the interval of one joint."""

import math
from collections.abc import Mapping
from functools import cache
from importlib.resources import as_file
from types import MappingProxyType
from typing import Final

import xarray as xr

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

SWING: Final = 0.95
"""Amplitude of the load over its mean: it is nearly gone between two steps."""
MEAN: Final = 1.0e3
"""Mean of a sinusoidal load of 2 kN at most [N]."""
CLARKE: Final = 11.0
"""Radius of the head of the set ``clarke`` [mm]."""
SAIKKO: Final = 16.0
_NOTHING: Final[Mapping[str, str]] = MappingProxyType({})
_ANGLE: Final = math.radians(23.0)


@cache
def _run(radius: float, load: float, changes: tuple[tuple[str, str], ...]) -> xr.Dataset:
    keys = {
        "joints.hip.clearance.radius": f"{radius} mm",
        "loads.body.force.value": f"{load} N",
        "loads.body.force.amplitude": f"{SWING * load} N",
        **dict(changes),
    }
    return ValidationSet("hip_simulator_wear").simulated("simulator.toml", keys)


def cycle(radius: float, load: float = MEAN, changes: Mapping[str, str] = _NOTHING) -> xr.Dataset:
    """Return a cycle of the simulator.

    Parameters
    ----------
    radius
        Of the head [mm].
    load
        Mean load [N].
    changes
        Of other keys of the case.
    """
    return _run(radius, load, tuple(changes.items()))


def load_path(one: ValidationSet, run: xr.Dataset) -> float:
    """Return the load times the path of a cycle [N m]."""
    return float(run.attrs["worn_volume"]) / one.value("rate")


def ends(one: ValidationSet) -> dict[str, dict[str, str]]:
    """Return the changes of the case at the ends of clearance and modulus, by name."""
    clearance, modulus = one.inputs["clearance"], one.inputs["modulus"]
    return {
        "least clearance": {"joints.hip.clearance.radial": f"{clearance.low} m"},
        "largest clearance": {"joints.hip.clearance.radial": f"{clearance.high} m"},
        "least modulus": {"surfaces.bushing.young_modulus": f"{modulus.low} Pa"},
        "largest modulus": {"surfaces.bushing.young_modulus": f"{modulus.high} Pa"},
    }


def by_hand(radius: float, load: float) -> float:
    """Return the load times the path of a point on a circle about the axis of the load [N m]."""
    return load * 1e-3 * radius * 2.0 * math.pi * math.sin(_ANGLE)


def compare(one: ValidationSet) -> Outcome:
    """Return volumes over clearance and modulus, load times path, the stated interval, and depths."""
    usual = cycle(CLARKE)
    rows = [
        Comparison(
            f"worn volume at the {name}, over that in the middle",
            "",
            load_path(one, cycle(CLARKE, changes=changes)) / load_path(one, usual),
            1.0,
            null=1.0,
            band=one.bands["volume"],
        )
        for name, changes in ends(one).items()
    ]
    rows += [*_saikko(one), _interval(one), *_depths(one)]
    rows.append(
        Comparison(
            "metal on metal, wear of the first million cycles over that of a later one",
            "",
            1.0,
            null=1.0,
            note="Measured: more than 3, by the sign of two abstracts. One wear rate cannot give it.",
        )
    )
    return Outcome(tuple(rows), _plot(one))


def _saikko(one: ValidationSet) -> list[Comparison]:
    """Return load times path over the mean loads of walking, and the loss of weight that follows."""
    load = one.inputs["load"]
    paths = [load_path(one, cycle(SAIKKO, mean)) for mean in (load.value, load.low, load.high)]
    loss = 1e6 * paths[0] * one.value("rate") * 1e9 * one.value("density")
    row = next(row for row in one.rows("wear.csv") if row["set"] == "saikko")
    path = Comparison(
        "saikko, load times path",
        "N m a cycle",
        paths[0],
        u_computed=(paths[0] - paths[1], paths[2] - paths[0]),
        null=by_hand(SAIKKO, load.value),
        band=one.bands["path"],
        spread=(paths[1], paths[2]),
    )
    mean = float(row["wear_rate"])
    weight = Comparison(
        "saikko, loss of weight", "mg in a million cycles", loss, mean,
        u_measured=max(mean - float(row["wear_rate_min"]), float(row["wear_rate_max"]) - mean),
        null=mean, note="Five equal joints lost 0.4 to 7.1 mg.",
    )  # fmt: skip
    return [path, weight]


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
    changes: dict[str, dict[str, str]] = {"middle clearance": {}, **ends(one)}
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
