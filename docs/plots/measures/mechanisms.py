"""Numbers of the pages on user-defined mechanisms."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np

from measures.base import Numbers, force, key_result, span, spread
from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.runs import Runs, is_smooth

NEAR: Final = 10.0 ** np.linspace(-0.1, 0.1, 7)  #: Factors on a tolerance, within 1.6 of each other.
BRONZE: Final = {
    "joints.wrist.clearance.radial": "50 um",
    "surfaces.trunnion.material": "steel-52100",
    "surfaces.bushing.material": "bronze-c93200",
}


def four_bar(runs: Runs, name: str) -> str:
    """Return a key result of the four-bar linkage."""
    return f"{key_result(runs.run('four-bar'), name):.0f}"


def four_bar_spread(runs: Runs, name: str) -> str:
    """Return the range of a key result over neighbouring tolerances, over its mean [%]."""
    found = [key_result(runs.run("four-bar", {"solver.rtol": 1e-5 * near}), name) for near in NEAR]
    return f"{spread(np.array(found)):.1g}"


def wrist(runs: Runs, rtol: float, name: str) -> FloatArray:
    """Return a key result of the slider-crank with bronze in its wrist about a tolerance."""
    return np.array(
        [key_result(runs.run("slider-crank", {**BRONZE, "solver.rtol": rtol * near}), name) for near in NEAR]
    )


def wrist_pressure(runs: Runs, rtol: float) -> str:
    """Return the range of the largest contact pressure about a tolerance [MPa]."""
    return span(wrist(runs, rtol, "peak_pressure_MPa"), ".1f")


def both(runs: Runs, clearance: int) -> dict[str, float]:
    """Return how far the two models of the vane mechanism are apart in smooth motion of a cycle."""
    wide, cycle = f"{clearance} um", {"run.cycles": 1, "solver.rtol": 1e-4}
    built_in = runs.run("vsv", {**cycle, "joint.clearance": wide})
    drawn = runs.run("vsv-free", {**cycle, "joints.trunnion.clearance.radial": wide})
    time = drawn["time"].values
    quiet = is_smooth(built_in, time)

    def at(values: FloatArray) -> FloatArray:
        return np.interp(time[quiet], built_in["time"].values, values)

    displaced = drawn["displacement"].sel(joint="trunnion").values[quiet]
    off = np.hypot(displaced[:, 0] - at(built_in["e_x"].values), displaced[:, 1] - at(built_in["e_y"].values))
    forces = np.linalg.norm(drawn["contact_force"].sel(joint="trunnion").values[quiet][:, :2], axis=1)
    ours = at(force(built_in))
    return {
        "eccentricity": 1e6 * float(off.mean()),
        "force": 100.0 * abs(float(forces.mean() / ours.mean()) - 1.0),
    }


def apart(runs: Runs, clearance: int, what: str) -> str:
    """Return how far the two models are apart."""
    return f"{both(runs, clearance)[what]:.2g}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "four-bar, sustained [N]": partial(four_bar, name="joint_force_sustained_N"),
    "four-bar, peak [N]": partial(four_bar, name="joint_force_max_N"),
    "four-bar, peaks over tolerances [%]": partial(four_bar_spread, name="joint_force_max_N"),
    "four-bar, means over tolerances [%]": partial(four_bar_spread, name="force_mean_N_main"),
    **{
        f"wrist pressure about {rtol} [MPa]": partial(wrist_pressure, rtol=float(rtol))
        for rtol in ("1e-4", "1e-5", "1e-6")
    },
    **{
        f"two models, {what}, {clearance} µm": partial(apart, clearance=clearance, what=what)
        for what in ("eccentricity", "force")
        for clearance in (20, 40)
    },
}
