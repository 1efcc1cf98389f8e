"""Static analyses of random mechanisms, and how far their errors are from those of dynamic runs.

    python -m benchmarks static_machines

The mechanisms are the flat loops of ``tests/faults/mechanisms/random_mechanisms.py`` by their seeds, with the
path of the last body as output. Those without a drive that prescribes a motion get one. A run that takes
longer than ``LIMIT`` is stopped; both errors are then those of the time that it reached.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr
from tests.faults.mechanisms.random_mechanisms import flat_loop

import tribodyn as td
from benchmarks.mechanisms.random_machines import quantiles
from tribodyn.cases.case import Case
from tribodyn.core.errors import TribodynError
from tribodyn.results.reading import column

MACHINES: Final = 200
LIMIT: Final = 2.0  #: Processor time of one run [s].
COMPLETE: Final = "complete"  #: Words of a run that reached its end.
_POSITIONS: Final = 12
_REACHED: Final = 0.1  #: Part of a dynamic run that is enough for a comparison.
_REASONS: Final = (
    "along a freedom that no joint, drive or spring holds",
    "come closer than the contact law reaches",
    "out of its bore",
    "with ideal joints, too, no position at rest was found",
    "did not converge",
    "come apart",
)


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return how analyses ended, and the ratio of static to dynamic rms errors."""
    found = summary([one(seed) for seed in range(3 if quick else MACHINES)])
    print(found, flush=True)
    return found


def summary(runs: list[tuple[str, str, float]]) -> dict[str, Any]:
    """Return counts and quantiles of what :func:`one` returned."""
    ratios = np.array([ratio for _, _, ratio in runs if math.isfinite(ratio)])
    off = np.abs(ratios - 1.0)
    return {
        "machines": len(runs),
        "static": dict(Counter(static for static, _, _ in runs)),
        "dynamic": dict(Counter(dynamic for _, dynamic, _ in runs if dynamic)),
        "compared": len(ratios),
        "static over dynamic": quantiles(ratios.tolist()) if ratios.size else {},
        "difference": quantiles(off.tolist()) if ratios.size else {},
        **{f"within {part} %": int(np.sum(off < part / 100)) for part in (1, 5, 20, 50)},
    }


def one(seed: int) -> tuple[str, str, float]:
    """Return how both analyses of a seed ended, and the ratio of static to dynamic rms error; NaN if none."""
    drawing = flat_loop(np.random.default_rng(seed))
    drawing.more["outputs"] = {"last": {"body": "rocker"}}
    if not drawing.case().moves:
        drawing.more["drives"] = {"drive-0": {"joint": "joint-0", "speed": "20 rad/s"}}
    case = drawing.case().replace({"run.positions": _POSITIONS})
    if not any(joint.clearance for joint in case.joints.values()):
        return "no clearance", "", math.nan
    ended, static = limited(case.replace({"run.analysis": "static"}))
    if ended != COMPLETE or static is None:
        return ended, "", math.nan
    ended_later, dynamic = limited(case)
    reached = 0.0 if dynamic is None else float(column(dynamic, "time")[-1])
    if dynamic is None or not reached > _REACHED * float(column(static, "time")[-1]):
        return ended, ended_later, math.nan
    ratio = rms(static, reached) / rms(dynamic, reached)
    return ended, ended_later, ratio


def rms(result: xr.Dataset, end: float) -> float:
    """Return the root mean square of the error of the output until a time [s], in metres; NaN without one."""
    times, error = column(result, "time"), column(result, "output_error")[:, 0]
    at = np.linspace(0.0, end, 1000)
    found = math.sqrt(float(np.mean(np.interp(at, times, error) ** 2)))
    return found if found > 0.0 else math.nan


def limited(case: Case, limit: float = LIMIT) -> tuple[str, xr.Dataset | None]:
    """Return how a run of at most some processor time ended, in words, with its result, if it has rows."""
    end = time.thread_time() + limit
    try:
        result = td.simulate(case, stop=lambda: time.thread_time() > end)
    except TribodynError as error:
        return f"refused: {error}", None
    failure = str(result.attrs["failure"])
    words = next((reason for reason in _REASONS if reason in failure), failure)
    return words or COMPLETE, result if result.sizes["time"] > 1 else None
