"""What keeps the vane mechanism from being smooth, and what each costs: two cycles with and without it.

    python -m benchmarks kinks

Variants change the physics; their motions are other motions. What they tell is what could be won at most by
treating a kink as the integrator would like it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, Final
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from benchmarks.vane.vsv_case import RTOL, problem_of, ranges, vsv_case
from mebdf.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.integrate import integrate
from tribodyn.kernels.jit import entry, new_record
from tribodyn.kernels.joints.bushing import Collar
from tribodyn.kernels.mebdf.drive import AFTER_STEP
from tribodyn.kernels.vsv.data import VsvData, VsvMemory

#: About the default, whose counts alone scatter by some percent: means are taken.
TOLERANCES: Final = (0.9 * RTOL, RTOL, 1.1 * RTOL)
#: What lets compiled code pause by the clock, where here it pauses after every step.
TICKING: Final = "tribodyn.integrate.mebdf._ticking"


@entry
def _forget_nothing(t: float, y: FloatArray, data: VsvData, memory: VsvMemory) -> None:
    """Leave the memory as it is."""


def _frozen(problem: Problem, entry_velocity: float) -> Problem:
    """Return the problem with one entry velocity everywhere and for ever [m/s]; 0: none."""
    problem.memory.joint.entry_velocity[:] = entry_velocity
    return replace(problem, functions=replace(problem.functions, accept=_forget_nothing))


def _one_entry_velocity(problem: Problem) -> Problem:
    return _frozen(problem, float(problem.data.joint.surface.surfaces[0]["minimum_entry_velocity"]))


def _no_memory(problem: Problem) -> Problem:
    return _frozen(problem, 0.0)


def _no_collar(problem: Problem) -> Problem:
    return replace(problem, data=problem.data._replace(collar=new_record(Collar)))


def _same(problem: Problem) -> Problem:
    return problem


@dataclass(frozen=True)
class Variant:
    """A change of the default case: keys, and what no key changes."""

    name: str
    keys: dict[str, Any] = field(default_factory=dict)
    alter: Callable[[Problem], Problem] = _same


_NO_CLIP: Final = {"contact.tensile_clip": False}
_WIDE: Final = {"loads.switch_width": "0.1 rad"}
_SLIP: Final = {"joint.slip_velocity": "1 mm/s"}
VARIANTS: Final = (
    Variant("as it is"),
    Variant("no clip", _NO_CLIP),
    Variant("entry velocity v_min, for ever", alter=_one_entry_velocity),
    Variant("no memory: |approach| of the moment", alter=_no_memory),
    Variant("no moment of the collar", alter=_no_collar),
    Variant("air force switched over 10 times the angle", _WIDE),
    Variant("traction developed at 100 times the slip", _SLIP),
    Variant("friction as a moment", {"joint.friction": "moment"}),
    Variant(
        "no clip, v_min, no collar, wide switches",
        {**_NO_CLIP, **_WIDE, **_SLIP},
        lambda problem: _no_collar(_one_entry_velocity(problem)),
    ),
)


def count(variant: Variant, cycles: float, rtol: float) -> dict[str, float]:
    """Return what a variant takes, where its steps lie after a reversal, and whether the memory matters.

    The last three belong to the first 50 ms: how often points of the bushing came into contact or left it at
    the end of a step, and the shares [%] of the steps that are shorter than the one before, after such a step
    and after the others.
    """
    case, vsv = vsv_case(cycles, **variant.keys)
    problem = variant.alter(problem_of(case, vsv))
    reached: list[float] = []
    in_contact: list[NDArray[np.bool_]] = []
    pauses: list[NDArray[np.int64]] = []

    @contextmanager
    def ask_in_look(pause: NDArray[np.int64]) -> Iterator[None]:
        pauses.append(pause)
        yield

    def look(t: float) -> None:
        pauses[0][0] = AFTER_STEP
        reached.append(t)
        in_contact.append(problem.memory.joint.entry_velocity > 0.0)

    with patch(TICKING, ask_in_look):
        solution = integrate(problem, rtol=rtol, output_times=[case.duration], progress=look)
    assert solution.complete, solution.failure
    statistics = solution.statistics
    assert len(reached) >= statistics.steps
    far, between = ranges(np.array(reached))
    near = ~far & ~between
    steps = np.diff(reached)
    shorter = steps[1:] < 0.95 * steps[:-1]
    changed = np.array([np.any(a != b) for a, b in pairwise(in_contact)])[:-1]
    after, others = changed & near[2:], ~changed & near[2:]
    return {
        "steps": statistics.steps,
        "rejected": statistics.rejected,
        "evaluations": statistics.rhs_evaluations,
        "LU": statistics.lu_decompositions,
        "steps to 50 ms": near.sum(),
        "50 to 100 ms": between.sum(),
        "later": far.sum(),
        "changes of contact": after.sum(),
        "shorter after them": _percent(shorter[after]),
        "after others": _percent(shorter[others]),
    }


def _percent(what: NDArray[np.bool_]) -> float:
    return 100.0 * float(what.mean()) if what.size else 0.0


def means(variant: Variant, cycles: float, tolerances: tuple[float, ...]) -> dict[str, float]:
    """Return the means of the counts over some tolerances."""
    found = [count(variant, cycles, rtol) for rtol in tolerances]
    return {key: round(float(np.mean([each[key] for each in found])), 1) for key in found[0]}


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return the counts of all variants; ``quick``: over a moment, for nothing but a trial."""
    cycles, tolerances = (0.05, TOLERANCES[:1]) if quick else (2.0, TOLERANCES)
    found = {variant.name: means(variant, cycles, tolerances) for variant in VARIANTS}
    print(f"{'':43s}", *next(iter(found.values())))
    for name, row in found.items():
        print(f"{name:43s}", *row.values())
    return found


if __name__ == "__main__":
    run()
