"""Numbers of the pages on wear."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from measures.base import Numbers
from tribodyn.papers.cheng_2022.claims.base import Trial
from tribodyn.papers.cheng_2022.claims.wear import profile
from tribodyn.papers.cheng_2022.clearance import worn
from tribodyn.papers.cheng_2022.runs import CLEARANCES, Runs

#: The campaigns that the figures of the page show.
MILLION: Final[dict[str, object]] = {
    "wear.cycles": 1_000_000,
    "wear.jump_limit": 0.1,
    "run.output_interval": "20 ms",
}
#: Changes of a campaign of 100 000 cycles.
HOW_SURE: Final[dict[str, dict[str, object]]] = {
    "default": {},
    "jumps halved": {"wear.jump_limit": 0.025, "wear.jump_depth": 0.125},
    "grid 64 × 32": {"solver.grid.z": 32},
    "grid 144 × 24": {"solver.grid.theta": 144, "solver.grid.z": 24},
}


def million(runs: Runs, clearance: str = "20 um") -> xr.Dataset:
    """Return a campaign of a million cycles."""
    return runs.run("vsv", MILLION | {"joint.clearance": clearance})


def depth_at(run: xr.Dataset, cycles: float) -> float:
    """Return the largest depth after some cycles of a campaign [µm]."""
    return 1e6 * float(np.interp(cycles, run["wear_cycles"].values, run["wear_depth_max"].values))


def first_400(runs: Runs) -> xr.Dataset:
    """Return a campaign of 400 cycles."""
    return runs.run("vsv", {"wear.cycles": 400})


def slowed(runs: Runs) -> str:
    """Return by how much feedback slows wear down over 400 cycles [%]."""
    run = first_400(runs)
    first, last = (float(run["wear_rate"].values[stop]) for stop in (0, -1))
    return f"{100.0 * (1.0 - last / first):.0f}"


def straight(runs: Runs) -> str:
    """Return the depth of a million cycles at the first rate [µm]."""
    return f"{1e12 * float(million(runs)['wear_rate'].values[0]):.0f}"


def error(runs: Runs, stop: int) -> str:
    """Return the rms vane-angle error at the first or the last stop [deg]."""
    return f"{np.degrees(million(runs)['wear_angle_error_rms'].values[stop]):.3f}"


def ratio(runs: Runs, cycles: float) -> str:
    """Return the depth at 40 µm over that at 20 µm after some cycles."""
    wide, narrow = (depth_at(million(runs, clearance), cycles) for clearance in ("40 um", "20 um"))
    return f"{wide / narrow:.1f}"


def campaign(runs: Runs, changes: dict[str, object]) -> xr.Dataset:
    """Return a campaign of 100 000 cycles at 20 µm."""
    return runs.run("vsv", {"wear.cycles": 100_000, **changes})


def stops(runs: Runs, changes: dict[str, object]) -> str:
    """Return how many cycles a campaign simulated."""
    return str(campaign(runs, changes).sizes["jump"])


def depth(runs: Runs, changes: dict[str, object]) -> str:
    """Return the largest depth of a campaign [µm]."""
    return f"{1e6 * float(campaign(runs, changes)['wear_depth_max'].values[-1]):.3f}"


def volume(runs: Runs, changes: dict[str, object]) -> str:
    """Return the worn volume of a campaign [mm³]."""
    return f"{1e9 * float(campaign(runs, changes)['wear_volume'].values[-1]):.5f}"


def by_clearance(runs: Runs) -> str:
    """Return the largest depths after 10 000 cycles with each clearance of the paper [µm]."""
    each = ({"joint.clearance": f"{value * 1e6:g} um", "wear.cycles": 10_000} for value in CLEARANCES)
    depths = (1e6 * float(runs.run("vsv", one)["wear_depth_max"].values[-1]) for one in each)
    return ", ".join(f"{depth:.2f}" for depth in depths)


def paper_depth(runs: Runs, clearance: float) -> str:
    """Return the largest depth in the paper's convention after 400 cycles [1e-4 µm]."""
    run = worn(runs, "paper", clearance, 400)
    return f"{1e10 * float(run['wear_depth'].values.max()):.2g}"


def paper_ratio(runs: Runs, inside: float) -> str:
    """Return the depth at 40 µm over that at 20 µm at a distance from the edge [m]."""
    trial = Trial(runs, "paper")
    return f"{profile(trial, 40e-6)(inside) / profile(trial, 20e-6)(inside):.2f}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "wear, 400 cycles [nm]": lambda runs: f"{1e3 * depth_at(first_400(runs), 400.0):.0f}",
    "wear, 400 cycles, slowed [%]": slowed,
    "wear, a million cycles [µm]": lambda runs: f"{depth_at(million(runs), 1e6):.1f}",
    "wear, a million cycles, straight [µm]": straight,
    "wear, first error [deg]": partial(error, stop=0),
    "wear, last error [deg]": partial(error, stop=-1),
    "wear, 10 000 cycles, by clearance [µm]": by_clearance,
    "wear ratio, early": partial(ratio, cycles=1e3),
    "wear ratio, late": partial(ratio, cycles=1e6),
    **{
        f"wear, {name}, {what}": partial(measure, changes=changes)
        for name, changes in HOW_SURE.items()
        for what, measure in (("stops", stops), ("depth [µm]", depth), ("volume [mm³]", volume))
    },
    **{f"wear as the paper, {at} µm [1e-4 µm]": partial(paper_depth, clearance=at * 1e-6) for at in (20, 40)},
    **{
        f"wear ratio as the paper, {inside:g} mm inside": partial(paper_ratio, inside=inside * 1e-3)
        for inside in (0.0, 0.1, 0.5)
    },
}
