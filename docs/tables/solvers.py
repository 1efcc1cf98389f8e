"""Tables that compare the MEBDF with other stiff solvers.

They show what ``python -m benchmarks``, ``benchmarks.solver.work_precision`` and
``benchmarks.solver.dae_peers`` found.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from tables.benchmarks import SOURCE
from tables.markdown import STATIC, Found, Lines, head, row, stored

WORK: Final = STATIC / "mebdf_work_precision.json"
ALGEBRAIC: Final = STATIC / "dae_work_precision.json"
PROBLEMS: Final = {"VDP11": "Van der Pol", "PENDULUM": "Pendulum"}
DECADES: Final = range(3, 11)
DIGITS: Final = ("10⁻³", "10⁻⁴", "10⁻⁵", "10⁻⁶", "10⁻⁷", "10⁻⁸", "10⁻⁹", "10⁻¹⁰")


def work(found: Found) -> Lines:
    """Give the work of MEBDF over that of CVODE at equal digits."""
    costs = ("with differences for J", "LU", "time")
    yield from head("problem", "calls, 5 digits", *costs, "calls, 7.5 digits", *costs)
    for problem, ratios in found["ratios to CVODE"].items():
        yield row(problem, *(f"{ratio:.2f}" for ratio in ratios))


def digits(found: Found) -> Lines:
    """Give the digits beyond the tolerance: means over a decade, and the least one."""
    yield from head("problem", *DIGITS, "least", "least, CVODE")
    for problem, runs in found["runs"].items():
        beyond = {name: _beyond(runs[name]) for name in ("MEBDF", "CVODE")}
        asked, more = beyond["MEBDF"]
        means = (more[np.abs(asked - decade) < 0.51].mean() for decade in DECADES)
        least = (values[1].min() for values in beyond.values())
        yield row(problem, *(f"{value:+.1f}".replace("-", "−") for value in (*means, *least)))


def _beyond(runs: dict[str, list[Any]]) -> tuple[Any, Any]:
    """Return the digits of each tolerance and those reached beyond them, of runs that have not failed."""
    good = ~np.array(runs["failed"])
    asked = -np.log10(np.array(runs["rtol"]))[good]
    return asked, np.array(runs["digits"])[good] - asked


def cash(found: Found) -> Lines:
    """Give the work of Cash's own code and of ours at equal digits."""
    yield from head("", "digits", "steps, Cash", "here", "evaluations, Cash", "here", "LU, Cash", "here")
    for name, title in PROBLEMS.items():
        for line in found["cash"][name]:
            costs = ((f"{line[f'{cost}, Cash']}", _count(line[cost])) for cost in ("steps", "rhs", "lu"))
            yield row(title, f"{line['digits']:.1f}", *(cell for pair in costs for cell in pair))


def _count(value: float) -> str:
    return f"{value:.0f}" if value >= 100.0 else f"{value:.1f}"


def ida(found: Found) -> Lines:
    """Give the work of MEBDF over that of IDA at equal digits, and the most digits of each."""
    yield from head("problem", "residuals", "LU", "time", "most digits, IDA", "most digits, here")
    for problem, ratios in found["ratios to IDA"].items():
        most = (max(run["digits"] for run in found["runs"][problem][name]) for name in ("IDA", "MEBDF"))
        cells = [f"{ratio:.2f}" for ratio in ratios] if ratios else ["–"] * 3
        yield row(problem, *cells, *(f"{value:.1f}" for value in most))


#: Tables by name.
TABLES: Final = {
    "work": stored(WORK, work),
    "digits": stored(WORK, digits),
    "cash": stored(SOURCE, cash),
    "ida": stored(ALGEBRAIC, ida),
}
