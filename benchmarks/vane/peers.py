"""What the vane mechanism takes elsewhere: other integrators, NumPy, the multibody code Exudyn.

A peer is run again and again in turn with MEBDF at the default tolerances, over the same simulated time.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from typing import Any, Final

import numpy as np

from benchmarks.vane.numpy_vsv import integrate_with_scipy
from benchmarks.vane.vsv_case import one, problem_of, vsv_case
from tribodyn.papers.cheng_2022.reduced.times import output_times

POINT: Final = {"joint.contact": "point-lankarani-nikravesh"}
EVERY: Final = 5e-3  #: Time between rows of Exudyn's runs, as ``run.output_interval`` [s].
#: Cycles over which slow peers are run: a start, a long stretch, a reversal and 0.3 s after it.
PART: Final = 0.55


@dataclass(frozen=True)
class Peer:
    """A way to simulate the mechanism."""

    name: str  #: Shown in the table.
    setting: str  #: Tolerances or step.
    cycles: float  #: Drive cycles over which it is compared.
    #: ``run(cycles)`` returns times, columns and seconds of the thread.
    run: Callable[[float], dict[str, Any]]
    changes: tuple[tuple[str, Any], ...] = ()  #: Keys of the case that the reference for its accuracy has.


def setting(rtol: float, tighter: float) -> str:
    """Return tolerances as shown: the relative one, and the absolute ones where they are not the default."""
    return f"rtol {rtol:.0e}" + (f", atol × {tighter:g}" if tighter != 1.0 else "")


def with_numpy(rtol: float, tighter: float, cycles: float) -> dict[str, Any]:
    """Run SciPy's BDF with the right-hand side in NumPy."""
    case, vsv = vsv_case(cycles)
    problem = problem_of(case, vsv, tighter)
    times = output_times(case, vsv, case.duration)
    begin = time.thread_time()
    found = integrate_with_scipy(problem, vsv.joint, rtol, times)
    return {**found, "seconds": time.thread_time() - begin}


def with_exudyn(contact: str, step: float, cycles: float) -> dict[str, Any]:
    """Run Exudyn; making the model is not counted."""
    from benchmarks.vane.exudyn_model import ExudynModel

    case, vsv = vsv_case(cycles, **(POINT if contact == "point" else {}))
    model = ExudynModel(case, vsv, problem_of(case, vsv), contact)
    begin = time.thread_time()
    t, theta_v = model.solve(case.duration, step, EVERY)
    seconds = time.thread_time() - begin
    inside = t <= case.duration
    return {"t": t[inside], "columns": {"theta_v": theta_v[inside]}, "seconds": seconds}


def peers(tolerances: dict[str, tuple[float, float]], whole: float) -> Iterator[Peer]:
    """Give all peers.

    Parameters
    ----------
    tolerances
        Relative tolerance and factor of the absolute ones at which each integrator with the compiled
        functions is accurate enough.
    whole
        Cycles that fast peers run over.
    """
    for solver, found in tolerances.items():
        yield Peer(solver, setting(*found), whole, partial(one, solver, *found))
    part, as_bdf = min(PART, whole), tolerances.get("bdf", (1e-4, 0.1))
    yield Peer("BDF, NumPy", setting(*as_bdf), part, partial(with_numpy, *as_bdf))
    if find_spec("exudyn") is None:
        print("without Exudyn: pip install tribodyn[bench]")
        return
    point, surface = partial(with_exudyn, "point"), partial(with_exudyn, "surface")
    changes = tuple(POINT.items())
    yield Peer("Exudyn, point contact", "1 ms", whole, partial(point, 1e-3), changes)
    yield Peer("Exudyn, surface contact", "1 ms", part, partial(surface, 1e-3))
    # Here its angle is as accurate as asked, but for the second order of the tilt that ours leaves out.
    yield Peer("Exudyn, surface contact", "50 µs", part, partial(surface, 5e-5))


def paired(peer: Peer, pairs: int, rtol: float) -> dict[str, Any]:
    """Run a peer in turn with MEBDF at ``rtol``; return the median ratio of times and its range."""
    ours, theirs, last = [], [], {}
    for _ in range(pairs):
        ours.append(one("mebdf", rtol, cycles=peer.cycles)["seconds"])
        last = peer.run(peer.cycles)
        theirs.append(last["seconds"])
    ratios = np.array(theirs) / np.array(ours)
    return {
        "ratio": float(np.median(ratios)),
        "least": float(ratios.min()),
        "most": float(ratios.max()),
        "seconds": float(np.median(theirs)),
        "mebdf seconds": float(np.median(ours)),
        "last": last,
    }
