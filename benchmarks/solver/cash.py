"""Steps, evaluations and LU decompositions beside Cash's own code, at the digits it reached.

    python -m benchmarks.solver.cash

Published runs: MEBDFDAE of November 1998, results mebdfdae_vdp.res and mebdfdae_pendul0.res in the repository
fons/JavaOdeInt on GitHub; rtol = atol. Ours are lines through runs near by.
"""

from __future__ import annotations

from operator import itemgetter
from typing import Any, Final

import numpy as np

from benchmarks.solver.mebdf_native import mebdf
from benchmarks.solver.problems import PROBLEMS
from benchmarks.solver.work_precision import cost_at

COSTS: Final = ("steps", "rhs", "lu")
#: Digits, steps, evaluations and LU decompositions. Beyond 7.5 digits Van der Pol's do not grow, and the end
#: point that the pendulum was compared with is right to 10.
PUBLISHED: Final = {
    "VDP11": (
        (2.813, 3320, 7260, 502),
        (3.254, 4925, 9379, 609),
        (4.828, 6447, 11693, 684),
        (5.988, 7791, 14234, 744),
        (7.511, 10525, 17641, 1007),
    ),
    "PENDULUM": (
        (2.527, 13, 18, 4),
        (3.961, 16, 21, 4),
        (4.907, 20, 28, 4),
        (5.767, 26, 40, 6),
        (6.663, 33, 47, 6),
        (7.942, 39, 54, 7),
        (9.341, 47, 63, 8),
    ),
}


def run(quick: bool = False) -> dict[str, list[dict[str, Any]]]:
    """Print and return what both took; ``quick``: with fewer runs to draw the line through."""
    tolerances = 10.0 ** -np.arange(1.5, 11.01, 0.5 if quick else 0.1)
    found: dict[str, list[dict[str, Any]]] = {}
    print("problem   digits   steps: Cash  here   evaluations: Cash  here   LU: Cash  here")
    for name, published in PUBLISHED.items():
        runs = [mebdf(PROBLEMS[name], rtol, at_least=0.0) for rtol in tolerances.tolist()]
        found[name] = [_beside(row, runs) for row in published]
        for row in found[name]:
            numbers = [f"{row[f'{cost}, Cash']:9.0f} {row[cost]:7.1f}" for cost in COSTS]
            print(f"{name:9s} {row['digits']:6.2f}", *numbers, sep="  ")
    return found


def _beside(row: tuple[float, ...], runs: list[dict[str, Any]]) -> dict[str, Any]:
    """Return what was published and what we take at the same number of digits."""
    published = {f"{cost}, Cash": value for cost, value in zip(COSTS, row[1:], strict=True)}
    ours = {cost: cost_at(runs, row[0], itemgetter(cost)) for cost in COSTS}
    return {"digits": row[0], **published, **ours}


if __name__ == "__main__":
    run()
