"""Claims on wear: section 5.3, Fig. 19."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, number, truth
from tribodyn.papers.cheng_2022.runs import CLEARANCES, Runs
from tribodyn.papers.cheng_2022.wear import CYCLES, worn

_NANOMETRE: Final = 1e-9


def _deepest(runs: Runs, formulation: str, clearance: float, cycles: int, friction: float | None) -> float:
    """Return the largest depth [m]."""
    return float(worn(runs, formulation, clearance, cycles, friction)["wear_depth"].max())


def depth_at_40(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the largest depth at 40 µm after 400 cycles."""
    return number(_deepest(runs, formulation, 40e-6, 400, friction) / _NANOMETRE, 0.2, "nm")


def ratio_to_20(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the depth at 40 µm over that at 20 µm."""
    depths = [_deepest(runs, formulation, clearance, 400, friction) for clearance in (40e-6, 20e-6)]
    return number(depths[0] / depths[1], 1.85, "times")


def grows(values: FloatArray, what: str) -> Finding:
    """Return whether depths [m] grow one by one."""
    text = ", ".join(f"{value / _NANOMETRE:.3g}" for value in values)
    return truth(
        bool(np.all(np.diff(values) > 0.0)), f"{text} nm {what}", partly=bool(values[-1] > values[0])
    )


def grows_with_cycles(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the depth after 100 to 400 cycles at 20 µm."""
    depths = [_deepest(runs, formulation, 20e-6, cycles, friction) for cycles in CYCLES]
    return grows(np.array(depths), "after 100 to 400 cycles")


def grows_with_clearance(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the depth after 400 cycles with each clearance."""
    depths = [_deepest(runs, formulation, clearance, 400, friction) for clearance in CLEARANCES]
    return grows(np.array(depths), "at 20 to 40 µm")


def at_the_edges(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the depth in the middle half against that at the edges."""
    run = worn(runs, formulation, 20e-6, 400, friction)
    depth, z = run["wear_depth"].values, run["z"].values
    inner = float(depth[:, np.abs(z) < 0.25 * np.ptp(z)].max() / depth.max())
    text = f"the middle half is worn to {100.0 * inner:.2g} % of the largest depth"
    return truth(inner < 0.05, text, partly=inner < 0.2)


_PRESSURE: Final = "the edge pressure is several times higher with the lever moment that the paper leaves out"

CLAIMS: Final = (
    Claim("wear at the edges", "5.3, Fig. 19", "wear is concentrated on the edges", at_the_edges),
    Claim("wear grows with cycles", "5.3, Fig. 19", "wear deepens with the cycles", grows_with_cycles),
    Claim("wear grows with clearance", "5.3, Fig. 19", "wear grows with the clearance", grows_with_clearance),
    Claim(
        "wear depth, 40 µm", "5.3, Fig. 19", "2e-4 µm at 40 µm after 400 cycles", depth_at_40,
        f"specific wear rate divided by 65, as the paper's numbers demand; {_PRESSURE}", True,
    ),
    Claim("wear ratio", "5.3, Fig. 19", "at 40 µm 1.85 times the depth at 20 µm", ratio_to_20, "", True),
)  # fmt: skip
"""Claims on wear."""
