"""Tuned limits of the MEBDF: what each costs at another value, as calls at equal digits over the test set.

    python -m benchmarks.solver.limits

writes the table in ``docs/_static/mebdf_limits.csv``, in a few minutes. Numbers are evaluations over those
at the default, geometric means over problems and two numbers of digits, with the evaluations that differences
for each Jacobian take; "!" marks failed runs. Beside them: the digits gained at equal tolerances. One per
cent is scatter.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, Final

import numpy as np

from benchmarks.solver import mebdf_native
from benchmarks.solver.mebdf_native import mebdf
from benchmarks.solver.problems import PROBLEMS
from benchmarks.solver.work_precision import cost_at
from mebdf.kernels.state import Settings

TARGET: Final = Path(__file__).parents[2] / "docs" / "_static" / "mebdf_limits.csv"
FACTORS: Final = (0.5, 0.8, 1.25, 2.0)
NAMES: Final = tuple(name for name in PROBLEMS if name not in ("RING", "PENDULUM"))
DIGITS: Final = (4.0, 6.0)
TOLERANCES: Final = 10.0 ** -np.arange(2.5, 9.01, 0.2)
MOST_CALLS: Final = 100_000


def measured(settings: dict[str, Any], tolerances: Any = TOLERANCES) -> tuple[Any, float, int]:
    """Return logarithms of calls by problem and digits, mean digits, and the number of failures."""
    costs, digits, failures = [], [], 0
    mebdf_native.MOST_CALLS = MOST_CALLS
    for name in NAMES:
        n = PROBLEMS[name].y0.size
        runs = [mebdf(PROBLEMS[name], rtol, settings, at_least=0.0) for rtol in tolerances.tolist()]
        failures += sum(run["failed"] for run in runs)
        digits.append(np.mean([run["digits"] for run in runs]))
        costs += [np.log(cost_at(runs, d, lambda run, n=n: run["rhs"] + n * run["jac"])) for d in DIGITS]
    return np.array(costs), float(np.mean(digits)), failures


def run(quick: bool = False) -> list[list[Any]]:
    """Print, write and return the table; ``quick``: two limits at few tolerances, not written."""
    tolerances = TOLERANCES[::10] if quick else TOLERANCES
    default, digits, _ = measured({}, tolerances)
    rows: list[list[Any]] = [
        ["limit", "value", *(f"calls x {f:g}" for f in FACTORS), *(f"digits x {f:g}" for f in FACTORS)]
    ]
    print(*rows[0], sep=",")
    for name in list(Settings.__annotations__)[: 2 if quick else None]:
        value: Any = getattr(Settings, name)
        found = [measured({name: np.multiply(factor, value)}, tolerances) for factor in FACTORS]
        calls = [
            f"{np.exp(np.mean(costs - default)):.3f}" + ("!" if failed else "") for costs, _, failed in found
        ]
        shown = " ".join(map(str, np.ravel(value)))
        rows.append([name, shown, *calls, *(f"{each - digits:+.2f}" for _, each, _ in found)])
        print(*rows[-1], sep=",", flush=True)
    if not quick:
        with TARGET.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
    return rows


if __name__ == "__main__":
    run()
