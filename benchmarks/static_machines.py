"""Static analyses of random mechanisms, and how far their errors are from those of dynamic runs.

    python -m benchmarks static_machines

The mechanisms are the flat loops of ``tests/faults/random_mechanisms.py`` by their seeds, with the path of
the last body as output. Those without a drive that prescribes a motion get one.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Any, Final

import numpy as np
from tests.faults.random_mechanisms import flat_loop

import tribodyn as td
from benchmarks.random_machines import quantiles
from tribodyn.cases.case import Case
from tribodyn.core.errors import TribodynError
from tribodyn.mechanisms.results import summarise

MACHINES: Final = 200
_BEST: Final = "complete"
_OUTPUT: Final = "error_rms_um_last"


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return how analyses ended, and the ratio of static to dynamic rms errors."""
    found = summary([one(seed) for seed in range(3 if quick else MACHINES)])
    print(found, flush=True)
    return found


def summary(runs: list[tuple[str, float]]) -> dict[str, Any]:
    """Return counts and quantiles of what :func:`one` returned."""
    ratios = [ratio for _, ratio in runs if math.isfinite(ratio)]
    off = np.abs(np.array(ratios) - 1.0)
    return {
        "machines": len(runs),
        "outcomes": dict(Counter(outcome for outcome, _ in runs)),
        "compared": len(ratios),
        "static over dynamic": quantiles(ratios) if ratios else {},
        "within 5 %": int(np.sum(off < 0.05)),
        "within 20 %": int(np.sum(off < 0.2)),
    }


def one(seed: int) -> tuple[str, float]:
    """Return how the static analysis of a seed ended, and the ratio of its rms error to the dynamic one."""
    drawing = flat_loop(np.random.default_rng(seed))
    drawing.more["outputs"] = {"last": {"body": "rocker"}}
    if not drawing.case().moves:
        drawing.more["drives"] = {"drive-0": {"joint": "joint-0", "speed": "20 rad/s"}}
    case = drawing.case().replace({"run.positions": 24})
    outcome, static = error_of(case.replace({"run.analysis": "static"}))
    if outcome != _BEST or not static > 0.0:
        return outcome, math.nan
    ended, dynamic = error_of(case)
    return outcome, static / dynamic if ended == _BEST and dynamic > 0.0 else math.nan


def error_of(case: Case) -> tuple[str, float]:
    """Return how a run ended, in words, and the rms error of the output [um]; NaN without one."""
    try:
        result = td.simulate(case)
    except TribodynError as error:
        return f"refused: {str(error).partition(': ')[2][:60]}", math.nan
    if result.attrs["failure"]:
        return f"stopped: {result.attrs['failure'].partition(', ')[2][:60]}", math.nan
    return _BEST, float(summarise(result).get(_OUTPUT, math.nan))


if __name__ == "__main__":
    run()
