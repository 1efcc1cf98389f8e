"""Static analyses of random mechanisms, and how far their errors are from those of dynamic runs.

    python -m benchmarks static_machines
    python -m benchmarks.static_machines hysteresis [MACHINES]

The mechanisms are the flat loops of ``tests/faults/random_mechanisms.py`` by their seeds, with the path of
the last body as output. Those without a drive that prescribes a motion get one. A run that takes longer than
``LIMIT`` is stopped; both errors are then those of the time that it reached.

With ``hysteresis`` their cranks swing slowly, and both runs have friction that holds at rest, developed at a
hundredth of their speed. The width of the loop is the error on the way there less that on the way back, at
the same position; how far widths differ is over their mean size.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr
from tests.faults.random_mechanisms import flat_loop

import tribodyn as td
from benchmarks.random_machines import quantiles
from tribodyn.cases.case import Case
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import TribodynError
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.results.reading import column

MACHINES: Final = 200
LIMIT: Final = 2.0  #: Processor time of one run [s].
#: The same of a slow run [s], and keys of the two runs whose loops are compared.
SLOW: Final = 10.0
STATIC: Final = {"run.analysis": "static", "run.positions": 200, "friction.rest": True}
AT_REST: Final = {"friction.rest": True, "run.output_interval": f"{2.0 * math.pi / 400} s"}
_BEST: Final = "complete"
_POSITIONS: Final = 12
_REACHED: Final = 0.1  #: Part of a dynamic run that is enough for a comparison.
_REASONS: Final = (
    "along a freedom that no joint, drive or spring holds",
    "come closer than the contact law reaches",
    "out of its bore",
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
    if ended != _BEST or static is None:
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


def hysteresis(machines: int) -> dict[str, Any]:
    """Print and return how far widths of static loops are from those of slow dynamic runs."""
    found: list[FloatArray] = []
    for seed in range(machines):
        case = swinging(seed)
        if any(joint.clearance for joint in case.joints.values()):
            widths = [width(limited(case.replace(keys), SLOW)[1]) for keys in (STATIC, AT_REST)]
            if all(len(one) for one in widths):
                found.append(np.abs(widths[1] - widths[0]) / np.mean(np.abs(widths[1])))
                print(seed, quantiles(found[-1].tolist()), flush=True)
    means = np.array([float(np.mean(one)) for one in found])
    told = {
        "compared": len(found),
        "positions within 2 %": float(np.mean(np.concatenate(found) < 0.02)),
        "machines whose mean is within 2 %": int(np.sum(means < 0.02)),
        "mean of a machine": quantiles(means.tolist()),
    }
    print(told, flush=True)
    return told


def swinging(seed: int) -> MechanismCase:
    """Return the mechanism of a seed with a crank that swings once, there and back, in 2π seconds."""
    drawing = flat_loop(np.random.default_rng(seed))
    angle = {"value": "10 deg", "swing": "10 deg", "angular_frequency": "1 rad/s", "phase": "-90 deg"}
    drawing.more["outputs"] = {"last": {"body": "rocker"}}
    drawing.more["drives"] = {"drive-0": {"joint": "joint-0", "angle": angle}}
    drawing.more["loads"] = {}
    drawing.more["run"] = {"duration": f"{2.0 * math.pi} s"}
    case = drawing.case()
    rubbing = [name for name, joint in case.joints.items() if joint.clearance]
    return case.replace({f"joints.{name}.clearance.slip_velocity": "10 um/s" for name in rubbing})


def width(result: xr.Dataset | None) -> FloatArray:
    """Return the widths of the loop of the output [m or rad] where it has developed; none of a part."""
    if result is None or float(column(result, "time")[-1]) < 2.0 * math.pi * (1.0 - 1e-9):
        return np.empty(0)
    times, error = column(result, "time"), column(result, "output_error")[:, 0]
    there = np.linspace(0.05, 0.45, 81) * times[-1]
    return np.asarray(np.interp(there, times, error) - np.interp(times[-1] - there, times, error))


def limited(case: Case, limit: float = LIMIT) -> tuple[str, xr.Dataset | None]:
    """Return how a run of at most some processor time ended, in words, with its result, if it has rows."""
    end = time.thread_time() + limit
    try:
        result = td.simulate(case, stop=lambda: time.thread_time() > end)
    except TribodynError as error:
        return f"refused: {error}", None
    failure = str(result.attrs["failure"])
    words = next((reason for reason in _REASONS if reason in failure), failure)
    return words or _BEST, result if result.sizes["time"] > 1 else None


if __name__ == "__main__":
    if "hysteresis" in sys.argv:
        hysteresis(int(sys.argv[2]) if len(sys.argv) > 2 else MACHINES)
    else:
        run()
