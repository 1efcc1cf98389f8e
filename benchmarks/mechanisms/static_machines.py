"""Static analyses of random mechanisms, and how far their errors are from those of dynamic runs.

    python -m benchmarks static_machines
    python -m benchmarks.mechanisms.static_machines hysteresis [[FIRST] END]

The mechanisms are the flat loops of ``tests/faults/mechanisms/random_mechanisms.py`` by their seeds, with the
path of the last body as output. Those without a drive that prescribes a motion get one. A run that takes
longer than ``LIMIT`` is stopped; both errors are then those of the time that it reached.

With ``hysteresis`` their cranks swing slowly, and both runs have friction that holds at rest, developed at a
ten-thousandth of their speed. The width of the loop is the error on the way there less that on the way back,
at the same position; how far widths differ is over their mean size. Where the slow run does not agree with
itself, more slowly and with a tighter tolerance, there is no quasi-static loop to compare with: contacts
chatter, or it depends on what the integration resolves. Nor is there one where moments of inertia change it.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr
from tests.faults.mechanisms.random_mechanisms import flat_loop

import tribodyn as td
from benchmarks.mechanisms.random_machines import quantiles
from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.core.errors import TribodynError
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.results.reading import column

MACHINES: Final = 200
LIMIT: Final = 2.0  #: Processor time of one run [s].
#: The same of a run whose loop is compared [s], and keys of static and slow ones.
SLOW: Final = 60.0
SLOWER: Final = 3.0  #: Factor by which a slow run is slowed down to see whether it has settled.
HEAVY: Final = 8.0  #: Factor of moments of inertia by which a slow run is asked whether inertia has part.
SAME: Final = 0.02  #: Difference of widths over their mean size that counts as none.
STATIC: Final = {"run.analysis": "static", "run.positions": 400, "friction.rest": True}
AT_REST: Final = {"friction.rest": True, "friction.presliding": "0.02 um"}
_BEST: Final = "complete"
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


def hysteresis(machines: range) -> dict[str, Any]:
    """Print and return how far widths of static loops are from those of slow dynamic runs."""
    ended: Counter[str] = Counter()
    found: list[FloatArray] = []
    for seed in machines:
        words, far = loop(seed)
        ended[words] += 1
        found += [far] if words == _BEST else []
        print(seed, words, f"{np.mean(far):.5f}" if far.size else "", flush=True)
    means = np.array([float(np.mean(one)) for one in found])
    told: dict[str, Any] = {"ended": dict(ended)}
    if found:
        told |= {
            "positions within 2 %": float(np.mean(np.concatenate(found) < SAME)),
            "machines whose mean is within 2 %": int(np.sum(means < SAME)),
            "mean of a machine": quantiles(means.tolist()),
        }
    print(told, flush=True)
    return told


def loop(seed: int) -> tuple[str, FloatArray]:
    """Return how the comparison of a seed ended, and differences of widths over their mean size.

    It is one where the slow run agrees with itself, ``SLOWER`` and with a tighter tolerance. Statics know no
    inertia: where they are off, and a slow run with other moments of inertia differs by more than ``SAME``
    from that without, a shaft snaps, and no static loop could agree with both.
    """
    case = swinging(seed)
    if not any(joint.clearance for joint in case.joints.values()):
        return "no clearance", np.empty(0)
    words, static = limited(case.replace(STATIC), SLOW)
    if words != _BEST:
        return f"static: {words}", np.empty(0)
    slow, slower = (width(limited(one.replace(AT_REST), SLOW)[1]) for one in (case, swinging(seed, SLOWER)))
    if not slow.size or not slower.size:
        return "no slow run", np.empty(0)
    size = np.mean(np.abs(slower))
    if np.mean(np.abs(slow - slower)) > 0.5 * SAME * size:
        return "slow runs differ", np.empty(0)
    far = np.abs(width(static) - slower) / size
    if np.mean(far) < SAME:
        return words, far
    heavy = width(limited(swinging(seed, inertia=HEAVY).replace(AT_REST), SLOW)[1])
    if heavy.size and np.mean(np.abs(slow - heavy)) > SAME * size:
        return f"inertia decides, static off by {np.mean(far):.4f}", np.empty(0)
    return words, far


def swinging(seed: int, slow: float = 1.0, inertia: float = 1.0) -> MechanismCase:
    """Return the mechanism of a seed with a crank that swings there, back and there again in 3π seconds.

    It is slower by a factor ``slow``, by which its tolerance is tighter. Its moments of inertia are larger by
    a factor ``inertia``, its masses not.
    """
    drawing = flat_loop(np.random.default_rng(seed))
    angle = {"value": "0 deg", "swing": "20 deg", "angular_frequency": f"{1.0 / slow} rad/s"}
    drawing.more["outputs"] = {"last": {"body": "rocker"}}
    drawing.more["drives"] = {"drive-0": {"joint": "joint-0", "angle": angle}}
    drawing.more["loads"] = {}
    for body in drawing.bodies.values():
        body["inertia"] = [f"{inertia * float(moment.split()[0])} kg m^2" for moment in body["inertia"]]
    end = 3.0 * math.pi * slow
    drawing.more["run"] = {"duration": f"{end} s", "output_interval": f"{end / 3000.0} s"}
    drawing.more["solver"]["rtol"] /= slow
    case = drawing.case()
    rubbing = [name for name, joint in case.joints.items() if joint.clearance]
    speed = f"{0.2 / slow} um/s"
    return case.replace({f"joints.{name}.clearance.slip_velocity": speed for name in rubbing})


def width(result: xr.Dataset | None) -> FloatArray:
    """Return the widths of the loop of the output [m] where it has developed; none of a part.

    Its first way there is left out: it still depends on where shafts lay at the start.
    """
    if result is None or result.attrs["failure"]:
        return np.empty(0)
    times, error = column(result, "time"), column(result, "output_error")[:, 0]
    away = np.linspace(0.1, 0.9, 81)
    back, there = (np.interp((2.0 + side * away) * times[-1] / 3.0, times, error) for side in (-1.0, 1.0))
    return np.asarray(there - back)


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
        hysteresis(range(*map(int, sys.argv[2:])) if len(sys.argv) > 2 else range(MACHINES))
    else:
        run()
