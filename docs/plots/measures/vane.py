"""Numbers of the pages on the vane mechanism, its energy, its accuracy and its stability."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np

import tribodyn as td
from measures.base import PEAK, SOLVERS, Numbers, force, key_result, spread, vsv
from mebdf.arrays import FloatArray
from tribodyn.mechanisms.bushing import grid_of
from tribodyn.papers.cheng_2022.claims.base import Trial
from tribodyn.papers.cheng_2022.claims.damping import MOMENTS, under_moment
from tribodyn.papers.cheng_2022.runs import Runs, smooth

CLEARANCES: Final = (20, 40, 80, 160)  #: Of the table of default grids [µm].


def by_cycle(runs: Runs, name: str, clearance: str) -> float:
    """Return what an energy grows by in the second cycle [J]."""
    run = vsv(runs, joint__clearance=clearance)
    period, energy = float(run.attrs["cycle_period"]), run[name].values
    first, second = np.interp([period, 2.0 * period], run["time"].values, energy)
    return float(second - first)


def damping_heat(runs: Runs, clearance: str) -> str:
    """Return the heat of contact damping in a cycle [mJ]."""
    return f"{1e3 * by_cycle(runs, 'energy_damping', clearance):.2f}"


def over_solvers(runs: Runs, formulation: str) -> str:
    """Return the largest range of the peak force of a reversal over the solvers, over its mean [%]."""
    found = np.array(
        [
            vsv(runs, solver__name=name, mechanism__formulation=formulation)["contact_force_impact"].values[
                1:
            ]
            for name in SOLVERS
        ]
    )
    return f"{max(spread(of_one) for of_one in found.T):.0f}"


def impact_length(runs: Runs) -> str:
    """Return how long the force of the hardest impact in `paper` exceeds half its peak [µs]."""
    run = vsv(runs, mechanism__formulation="paper")
    size, time = force(run), run["time"].values
    late = time > 3.0
    size, time = size[late], time[late]
    peak = int(size.argmax())
    high = size > 0.5 * size[peak]
    first = peak - int(np.argmin(high[peak::-1])) + 1
    last = peak + int(np.argmin(high[peak:])) - 1
    return f"{1e6 * (time[last] - time[first]):.0f}"


def pin_force(runs: Runs) -> str:
    """Return the largest vertical force of the pin in smooth motion [N]."""
    return f"{float(np.abs(smooth(vsv(runs))['F_43z'].values).max()):.1f}"


def lever_force(runs: Runs) -> str:
    """Return the mean horizontal force of the ring on the lever in smooth motion [N]."""
    run = smooth(vsv(runs))
    return f"{float(np.hypot(run['F_43x'].values, run['F_43y'].values).mean()):.0f}"


def range_of_vane(runs: Runs, end: int) -> str:
    """Return an end of the range of the vane [deg]."""
    angle = np.degrees(vsv(runs)["theta_v_ideal"].values)
    return f"{(angle.min(), angle.max())[end]:.1f}"


def unstable(runs: Runs, end: int) -> str:
    """Return the least or largest drag moment at which the damped run in `paper` ends early [N m]."""
    trial = Trial(runs, "paper")
    ended = [moment for moment in MOMENTS if under_moment(trial, moment).attrs["failure"]]
    return f"{(min(ended), max(ended))[end]:.2f}"


def rise_of_tilt(runs: Runs, name: str) -> str:
    """Return how many times as large a smooth mean is in `exact` as in `paper`."""
    means = [
        float(np.abs(smooth(vsv(runs, mechanism__formulation=one))[name].values).mean())
        for one in ("exact", "paper")
    ]
    return f"{means[0] / means[1]:.0f}"


def grid_error(runs: Runs, clearance: str) -> str:
    """Return the error of the contact force that a run finds on its grid [%]."""
    return f"{100.0 * vsv(runs, joint__clearance=clearance).attrs['grid_force_error']:.1g}"


def default_grid(runs: Runs, clearance: str) -> str:
    """Return the nodes around and along that a clearance is given."""
    theta, z = grid_of(td.load_case("vsv").replace({"joint.clearance": clearance}))
    return f"{theta} × {z}"


def floors(runs: Runs) -> FloatArray:
    """Return the peak force with a least entry velocity of 1 µm/s and of 1 mm/s [N]."""
    return np.array(
        [key_result(vsv(runs, contact__minimum_entry_velocity=floor), PEAK) for floor in ("1 um/s", "1 mm/s")]
    )


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "damping heat, 20 µm [mJ]": partial(damping_heat, clearance="20 um"),
    "damping heat, 40 µm [mJ]": partial(damping_heat, clearance="40 um"),
    "work of the loads [J]": lambda runs: f"{abs(by_cycle(runs, 'energy_loads', '20 um')):.1f}",
    "peaks over solvers, exact [%]": partial(over_solvers, formulation="exact"),
    "peaks over solvers, paper [%]": partial(over_solvers, formulation="paper"),
    "impact in paper [µs]": impact_length,
    "pin force, vertical [N]": pin_force,
    "lever force [N]": lever_force,
    "vane range, least [deg]": partial(range_of_vane, end=0),
    "vane range, most [deg]": partial(range_of_vane, end=1),
    "unstable moment, least [N m]": partial(unstable, end=0),
    "unstable moment, most [N m]": partial(unstable, end=1),
    "tilt about Y, exact over paper": partial(rise_of_tilt, name="phi_y"),
    "peak pressure, exact over paper": partial(rise_of_tilt, name="p_max"),
    **{f"grid, {c} µm": partial(default_grid, clearance=f"{c} um") for c in CLEARANCES},
    **{f"grid error, {c} µm [%]": partial(grid_error, clearance=f"{c} um") for c in CLEARANCES},
    "peak, v_min 1 µm/s over 1 mm/s": lambda runs: f"{floors(runs)[0] / floors(runs)[1]:.1f}",
}
