"""Compiled functions through SciPy's ``solve_ivp`` beside native CVODE, as ratios of times at equal digits.

    python -m benchmarks.solver.door

CVODE is called once for the whole integration, and only that is timed; it has the exact Jacobian. Of ours
the whole call of ``solve_ivp`` is timed, but for the first column. The solvers take turns, the shortest of
several times counts, and times are read off lines through runs near by.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from benchmarks.solver.cvode_native import cvode
from benchmarks.solver.mebdf_native import AT_ONCE, by_scipy, mebdf
from benchmarks.solver.problems import PROBLEMS, Benchmark
from benchmarks.solver.work_precision import cost_at

NAMES = ("VDP", "ROBER", "HIRES", "OREGO", "RING")
DIGITS = (5.0, 7.5)
TOLERANCES = 10.0 ** -np.arange(3.0, 11.1, 0.5)
SOLVERS: dict[str, Callable[[Benchmark, float], dict[str, Any]]] = {
    "CVODE": cvode,
    "integration alone": mebdf,
    "solve_ivp": by_scipy,
    "differences": partial(by_scipy, differenced=True),
    "steps at once": partial(by_scipy, at_once=AT_ONCE),
}


def beside(name: str, passes: int = 3) -> dict[str, list[float]]:
    """Return the times of all ways over CVODE's at each number of digits."""
    problem, runs = PROBLEMS[name], {solver: [] for solver in SOLVERS}
    few = name == "RING"
    for rtol in TOLERANCES[: 12 if few else None : 2 if few else 1].tolist():
        best: dict[str, dict[str, Any]] = {}
        for _, (solver, solve) in product(range(1 if few else passes), SOLVERS.items()):
            found = solve(problem, rtol)
            best[solver] = min(best.get(solver, found), found, key=lambda run: run["seconds"])
        for solver, found in best.items():
            runs[solver].append(found)
    seconds = {s: [cost_at(runs[s], d, lambda run: run["seconds"]) for d in DIGITS] for s in SOLVERS}
    return {s: [a / b for a, b in zip(seconds[s], seconds["CVODE"], strict=True)] for s in SOLVERS}


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return the ratios; ``quick``: of one problem."""
    print(f"times over CVODE's at {DIGITS[0]:g} and {DIGITS[1]:g} digits:", ", ".join(list(SOLVERS)[1:]))
    found = {}
    for name in NAMES[1:2] if quick else NAMES:
        found[name] = beside(name, 1 if quick else 3)
        print(f"{name:8s}", *(f"{a:5.2f} {b:5.2f}  " for a, b in list(found[name].values())[1:]), flush=True)
    return found


if __name__ == "__main__":
    run()
