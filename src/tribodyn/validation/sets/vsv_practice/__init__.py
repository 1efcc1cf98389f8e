"""Pull force of an actuation ring, and torque of a bush over a wear campaign."""

from collections.abc import Mapping
from typing import Final, cast

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.simulation import simulate
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied

#: Changes of the case for a ring that is pulled by hand.
STILL_AIR: Final = {
    "loads.air_force_x": "0 N",
    "loads.air_force_y": "0 N",
    "loads.air_moment": "0 N m",
    "run.cycles": 1,
}


def compare(one: ValidationSet) -> Outcome:
    """Return pull forces of a healthy and a seized ring, and the change of a bush's torque."""
    known = one.inputs
    healthy = varied(lambda given: _forces(given, None), [known["vanes"], known["friction"]])
    bores = [known["vanes"], known["friction"], known["seized_clearance"]]
    seized = varied(lambda given: _forces(given, given["seized_clearance"]), bores)
    worn = simulate(load_case("vsv").replace({"wear.cycles": int(one.value("wear_cycles"))}))
    ratio = _torque(worn) / _torque(simulate(load_case("vsv").replace({"run.cycles": 1})))
    rows = []
    for state, found in (("healthy", healthy), ("seized", seized)):
        name, sides = f"pull force of a {state} ring", found.sides_at(0)
        spread = found.spread(*found.ends)
        ends = float(spread[0, 0]), float(spread[1, 0])
        rows.append(Comparison(name, "N", found.values[0], None, sides, band=one.bands[state], spread=ends))
    note = f"Depth worn: {float(worn['wear_depth'].max()) * 1e6:.2g} um."
    name = "torque of a bush, worn over new"
    rows.append(Comparison(name, "", ratio, 1.0, null=1.0, band=one.bands["torque"], note=note))
    return Outcome(tuple(rows), _plot(worn))


def _forces(given: Mapping[str, float], clearance: float | None) -> FloatArray:
    """Return the pull force of a ring [N], shape (1,)."""
    changes: dict[str, object] = STILL_AIR | {"joint.friction_coefficient": given["friction"]}
    if clearance is not None:
        changes["joint.clearance"] = from_si(clearance, "um")
    case = cast(VsvCase, load_case("vsv").replace(changes))
    run = simulate(case)
    turned = float(np.trapezoid(np.abs(run["omega_v"].values), run["time"].values))
    lost = abs(float(run["energy_friction"][-1])) + abs(float(run["energy_collar_friction"][-1]))
    return np.array([given["vanes"] * lost / turned / case.mechanism.lever_length])


def _torque(run: xr.Dataset) -> float:
    """Return the mean magnitude of the friction moment of the bush over the last drive cycle [N m]."""
    time = run["time"].values
    last = time >= time[-1] - run.attrs["cycle_period"]
    moment = np.abs(run["M_jf"].values[last])
    return float(np.trapezoid(moment, time[last]) / run.attrs["cycle_period"])


def _plot(worn: xr.Dataset) -> Plot:
    cycles = worn["wear_cycles"].values
    depth = worn["wear_depth_max"].values * 1e6
    curve = Curve("greatest depth", "computed", cycles, depth)
    return Plot("drive cycles", "depth worn [um]", (curve,))
