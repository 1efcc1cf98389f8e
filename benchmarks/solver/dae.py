"""Differential-algebraic problems beside Cash's own codes: steps, evaluations, decompositions and digits.

    python -m benchmarks.solver.dae

Published runs: MEBDFDAE of November 1998 and MEBDFI of September 1999, results in the repository
fons/JavaOdeInt on GitHub; rtol = atol, exact Jacobians, which ours are given, too.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import itemgetter
from typing import Any, Final

import numpy as np

from benchmarks.solver.dae_problems import DaeBenchmark, andrews, caraxis, pendulum, transistor
from benchmarks.solver.work_precision import cost_at
from tribodyn.integrate import MEBDF

COSTS: Final = ("steps", "rhs", "lu")
MOST_STEPS: Final = 50_000

# fmt: off
PUBLISHED: Final[dict[str, tuple[tuple[float, ...], ...]]] = {
    "pendulum, index 1": (
        (13, 38, 4, 2.779), (16, 48, 5, 3.891), (22, 61, 5, 4.922), (29, 81, 7, 6.186), (36, 94, 8, 7.151),
        (53, 132, 11, 8.303), (59, 142, 11, 9.249), (75, 188, 14, 10.495), (96, 222, 16, 10.524),
    ),
    "pendulum, index 2": (
        (13, 38, 4, 2.425), (16, 43, 4, 3.288), (21, 51, 4, 4.545), (28, 72, 4, 5.074), (39, 90, 6, 5.933),
        (45, 109, 8, 7.536), (69, 165, 9, 7.691), (84, 213, 15, 9.412), (113, 275, 19, 9.745),
    ),
    "pendulum, index 3": (
        (9, 30, 3, 1.168), (14, 37, 3, 2.119), (20, 58, 5, 2.563), (28, 88, 5, 3.092), (49, 137, 10, 5.504),
        (62, 157, 11, 4.884), (70, 192, 14, 5.970), (101, 251, 16, 7.238), (127, 305, 19, 7.305),
    ),
    "transistor": (
        (734, 5411, 225, 1.12), (1072, 6579, 224, 3.13), (1481, 8231, 246, 4.58), (2032, 10505, 289, 5.26),
        (2748, 13662, 375, 6.43), (3468, 16814, 399, 7.26), (4592, 21022, 488, 7.59),
        (5952, 25877, 624, 8.92), (7767, 32162, 713, 10.12),
    ),
    "car axis": (
        (44, 245, 8, -0.69), (164, 735, 14, -0.74), (267, 1123, 19, 0.43), (379, 1762, 38, 0.82),
        (502, 2216, 43, 2.46), (654, 2764, 49, 2.90), (814, 3455, 62, 3.19), (1087, 4468, 74, 4.10),
        (1398, 5629, 75, 4.74),
    ),
    "Andrews' squeezer": (
        (46, 215, 19, 0.07), (80, 350, 22, -0.21), (108, 466, 23, 0.37), (173, 736, 29, 2.49),
        (240, 993, 39, 4.01), (302, 1310, 40, 3.13), (422, 1674, 56, 5.59), (506, 2026, 64, 5.49),
        (645, 2564, 73, 5.79),
    ),
}
# fmt: on
"""Steps, evaluations, LU decompositions and digits at tolerances 1e-2, 1e-3, …, 1e-10."""
PROBLEMS: Final[dict[str, Callable[[], DaeBenchmark]]] = {
    **{f"pendulum, index {index}": (lambda index=index: pendulum(index)) for index in (1, 2, 3)},
    "transistor": transistor,
    "car axis": caraxis,
    "Andrews' squeezer": andrews,
}
REACHED: Final = 0.5  #: Digits from which a run counts as one that has found the solution.


def solve(problem: DaeBenchmark, tolerance: float) -> dict[str, Any]:
    """Integrate at rtol = atol; return digits and counts, and the reason of a failure."""
    options: dict[str, Any] = {"mass": problem.mass, "index": problem.index, "jac": problem.jac}
    solver = MEBDF(problem.fun, 0.0, problem.y0, problem.t_end, rtol=tolerance, atol=tolerance, **options)
    message = None
    number = solver._state.number
    while solver.status == "running" and number("steps") < MOST_STEPS:
        message = solver.step()
    fields = {"steps": "steps", "rhs": "n_f", "lu": "n_lu", "rejected": "rejected"}
    costs = {name: number(field) for name, field in fields.items()}
    done = solver.status == "finished"
    return {"failed": not done, "message": message, "digits": problem.digits(solver.y), **costs}


def beside(name: str, a_decade: int = 4) -> dict[str, Any]:
    """Return our runs at the published tolerances, and the ratios of costs at equal digits, geometric means.

    The costs are read off lines through our runs near by, ``a_decade`` of them to a decade.
    """
    problem = PROBLEMS[name]()
    exponents = np.arange(2.0, 10.0 + 1e-9, 1.0 / a_decade)
    runs = [solve(problem, 10.0**-exponent) for exponent in exponents.tolist()]
    rows = [row for row in PUBLISHED[name] if row[3] > REACHED]
    ratios = [
        [cost_at(runs, row[3], itemgetter(cost)) / row[k] for k, cost in enumerate(COSTS)] for row in rows
    ]
    mean = np.exp(np.mean(np.log(ratios), axis=0))
    return {"runs": runs, "at": runs[::a_decade], "ratios": dict(zip(COSTS, mean.tolist(), strict=True))}


def run(quick: bool = False) -> dict[str, dict[str, Any]]:
    """Print and return what all problems took; ``quick``: with fewer runs to draw lines through."""
    found = {}
    for name, published in PUBLISHED.items():
        found[name] = beside(name, 2 if quick else 8)
        print(
            f"{name}: over Cash's at equal digits", {k: round(v, 2) for k, v in found[name]["ratios"].items()}
        )
        for decade, (theirs, ours) in enumerate(zip(published, found[name]["at"], strict=True), 2):
            numbers = " ".join(f"{theirs[k]:6.0f} {ours[cost]:6d}" for k, cost in enumerate(COSTS))
            digits = f"{theirs[3]:6.2f} {ours['digits']:6.2f}"
            print(f"  1e-{decade:02d} {numbers} {digits}  {ours['message'] or ''}")
    return found


if __name__ == "__main__":
    run()
