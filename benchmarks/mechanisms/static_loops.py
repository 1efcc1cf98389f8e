"""Hysteresis of static analyses of random mechanisms, and how far it is from that of slow dynamic runs.

    python -m benchmarks static_loops      # an hour
    python -m benchmarks.mechanisms.static_loops SEED ...

The mechanisms are those of :mod:`~.static_machines`. Their cranks swing slowly, and both runs have friction
that holds at rest, developed at a ten-thousandth of their speed. The width of the loop is the place of the
last body on the way there less that on the way back, as a vector, at the same angle of the crank; how far
widths differ is over their mean size. Where the slow run does not agree with itself, more slowly and with a
tighter tolerance, there is no quasi-static loop to compare with: contacts chatter, or it depends on what the
integration resolves. Nor is there one where moments of inertia change it. Bodies yield under the asperities
in both runs or in none.
"""

from __future__ import annotations

import math
import sys
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr
from scipy.interpolate import PchipInterpolator
from tests.faults.mechanisms.random_mechanisms import flat_loop

from benchmarks.mechanisms.random_machines import quantiles
from benchmarks.mechanisms.static_machines import COMPLETE, MACHINES, limited
from mebdf.arrays import FloatArray
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.results.reading import column

SLOW: Final = 60.0  #: Processor time of one run [s].
SLOWER: Final = 3.0  #: Factor by which a slow run is slowed down to see whether it has settled.
HEAVY: Final = 8.0  #: Factor of moments of inertia by which a slow run is asked whether inertia has part.
SAME: Final = 0.02  #: Difference of widths over their mean size that counts as none.
ELSEWHERE: Final = 0.02  #: Turn of a body from one start to another that no clearance gives [rad].
#: Keys of static runs, of those with positions closer to each other, and of slow runs.
STATIC: Final = {"run.analysis": "static", "run.positions": 400, "friction.rest": True}
CLOSER: Final[dict[str, object]] = {"run.positions": 1200}
AT_REST: Final = {"friction.rest": True, "friction.presliding": "0.02 um"}


def run(*, quick: bool = False) -> dict[str, Any]:
    """Print and return how comparisons ended, and differences of loops by the seeds of their mechanisms."""
    return compared(range(1, 3) if quick else range(MACHINES))


def compared(seeds: range | list[int]) -> dict[str, Any]:
    """Print and return the same of some seeds."""
    ended: Counter[str] = Counter()
    means: dict[str, float] = {}
    for seed in seeds:
        words, far = loop(seed)
        ended[words.split(", static off")[0]] += 1
        if far.size:
            means[str(seed)] = float(np.mean(far))
        print(seed, words, f"{np.mean(far):.5f}" if far.size else "", flush=True)
    told = {
        "machines": len(seeds),
        "ended": dict(ended),
        "within 2 %": sum(mean < SAME for mean in means.values()),
        "difference": quantiles(list(means.values())) if means else {},
    }
    print(told, flush=True)
    return {**told, "means": means}


def loop(seed: int) -> tuple[str, FloatArray]:
    """Return how the comparison of a seed ended, and differences of widths over their mean size.

    It is one where the slow run agrees with itself, ``SLOWER`` once or twice and with tighter tolerances, and
    begins where the static one does: friction keeps bodies anywhere along freedoms. Statics that are off have
    a second try with ``CLOSER`` positions. They know no inertia: where they are still off, and a slow run
    with other moments of inertia differs by more than ``SAME`` from that without, a shaft snaps, and no
    static loop could agree with both.
    """
    words, found = runs(seed)
    if not found:
        return words, np.empty(0)
    static, slow, slower = found
    if np.max(turned(static, slower)) > ELSEWHERE:
        return "elsewhere along a freedom", np.empty(0)
    yields = elastic(slower)
    if np.mean(differences(slow, slower)) > 0.5 * SAME:
        slowest = slowly(seed, SLOWER**2, yields=yields)
        if slowest is None or np.mean(differences(slower, slowest)) > 0.5 * SAME:
            return "slow runs differ", np.empty(0)
        slower = slowest
    far = differences(static, slower)
    if np.mean(far) >= SAME:
        words, closer = statically(seed, yields=yields, **CLOSER)
        far = differences(closer, slower) if words == COMPLETE and closer is not None else far
    if np.mean(far) >= SAME:
        heavy = slowly(seed, inertia=HEAVY, yields=yields)
        if heavy is not None and np.mean(differences(heavy, slower)) > SAME:
            return f"inertia decides, static off by {np.mean(far):.4f}", np.empty(0)
    return COMPLETE, far


def runs(seed: int, *, yields: bool = False) -> tuple[str, list[xr.Dataset]]:
    """Return how the runs of a seed ended, and those of statics, slow and ``SLOWER``; none if one failed.

    Bodies yield under their asperities in all if in one.
    """
    if not swinging(seed).real:
        return "no clearance", []
    words, static = statically(seed, yields=yields)
    if words != COMPLETE:
        return f"static: {words}", []
    found = [static, *(slowly(seed, slow, yields=yields) for slow in (1.0, SLOWER))]
    known = [one for one in found if one is not None]
    if len(known) < len(found):
        return "no slow run", []
    return (words, known) if len(set(map(elastic, known))) == 1 else runs(seed, yields=True)


def statically(seed: int, *, yields: bool, **keys: object) -> tuple[str, xr.Dataset | None]:
    """Return how the static run of a seed ended, some keys changed, and its result."""
    case = swinging(seed).replace({**STATIC, **keys})
    return limited((case.yielding() if yields else None) or case, SLOW)


def slowly(seed: int, slow: float = 1.0, inertia: float = 1.0, *, yields: bool = False) -> xr.Dataset | None:
    """Return the complete slow run of a seed, see :func:`swinging`; None without one."""
    case = swinging(seed, slow, inertia).replace(AT_REST)
    words, result = limited((case.yielding() if yields else None) or case, SLOW)
    return result if words == COMPLETE else None


def elastic(result: xr.Dataset) -> bool:
    """Return whether bodies under the asperities yielded: runs begin again so where asperities end."""
    return 'bulk = "conformal"' in result.attrs["case"]


def turned(one: xr.Dataset, other: xr.Dataset) -> FloatArray:
    """Return the angles between the bodies of two results at their starts [rad]."""
    cosines = np.sum(one["orientation"].values[0] * other["orientation"].values[0], axis=1)
    return np.asarray(2.0 * np.arccos(np.minimum(np.abs(cosines), 1.0)))


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
    speed = f"{0.2 / slow} um/s"
    return case.replace({f"joints.{name}.clearance.slip_velocity": speed for name in case.real})


def width(result: xr.Dataset) -> FloatArray:
    """Return the widths of the loop of the last body [m] where it has developed, shape (n, 3).

    They are its places on the way there less those on the way back, where the drive is at the same angle. Its
    first way there is left out: it still depends on where shafts lay at the start.
    """
    times, rows = np.unique(column(result, "time"), return_index=True)
    place = PchipInterpolator(times, result["position"].values[rows, -1])
    away = np.linspace(0.1, 0.9, 81)
    back, there = (place((2.0 + side * away) * times[-1] / 3.0) for side in (-1.0, 1.0))
    return np.asarray(there - back)


def differences(one: xr.Dataset, slower: xr.Dataset) -> FloatArray:
    """Return by how much the widths of a loop differ from those of a slower one, over their mean size."""
    widths = width(slower)
    return norm(width(one) - widths) / np.mean(norm(widths))


def norm(vectors: FloatArray) -> FloatArray:
    """Return the lengths of vectors (n, 3), shape (n,)."""
    return np.asarray(np.linalg.norm(vectors, axis=1))


if __name__ == "__main__":
    compared(list(map(int, sys.argv[1:])))
