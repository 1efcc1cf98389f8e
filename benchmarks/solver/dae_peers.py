"""Differential-algebraic problems of index 1 and 2 beside IDA: work and precision, with the same functions.

    python -m benchmarks.solver.dae_peers

IDA is that of scikit-sundae. Both get exact Jacobians, consistent values and the same tolerances. But IDA has
no option there to leave variables of higher index out of its error test: their absolute tolerance is free for
it. Writes ``docs/_static/dae_work_precision.json`` and ``.png`` and prints ratios at equal digits.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from functools import partial
from operator import itemgetter
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from benchmarks.solver.dae_index_2 import slider_crank, stabilised_caraxis
from benchmarks.solver.dae_problems import DaeBenchmark, andrews, pendulum, transistor
from benchmarks.solver.problems import PROBLEMS as ORDINARY
from benchmarks.solver.work_precision import cost_at, rounded
from tribodyn.figures.style import INK, VERMILION
from tribodyn.integrate import MEBDF

FloatArray = NDArray[np.float64]
TARGET: Final = Path(__file__).parents[2] / "docs" / "_static" / "dae_work_precision"
TOLERANCES: Final = 10.0 ** -np.arange(3.0, 9.1, 0.75)
FREE: Final = 1e10
MOST_STEPS: Final = 100_000
COSTS: Final = ("calls", "lu", "seconds")
LABELS: Final = {"calls": "residuals", "lu": "LU decompositions", "seconds": "time [s]"}
LOOKS: Final[dict[str, dict[str, Any]]] = {
    "MEBDF": {"color": VERMILION, "linewidth": 1.8},
    "IDA": {"color": INK, "linewidth": 1.0},
}


def robertson() -> DaeBenchmark:
    """Return Robertson's reaction with the sum of its species as an equation."""
    ordinary = ORDINARY["ROBER"]

    def fun(t: float, y: Any) -> Any:
        slow, fast, last = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
        return np.array([fast - slow, slow - fast - last, y[0] + y[1] + y[2] - 1.0])

    return DaeBenchmark(
        "Robertson", fun, np.diag([1.0, 1.0, 0.0]), (1, 1, 1), ordinary.y0, ordinary.t_end, ordinary.end, 3
    )


PROBLEMS: Final[dict[str, Callable[[], DaeBenchmark]]] = {
    "Robertson, index 1": robertson,
    "pendulum, index 1": partial(pendulum, 1),
    "transistor, index 1": transistor,
    "pendulum, index 2": partial(pendulum, 2),
    "car axis, index 2": stabilised_caraxis,
    "slider-crank, index 2": slider_crank,
    "pendulum, index 3": partial(pendulum, 3),
    "Andrews' squeezer, index 3": andrews,
}


def absolute(problem: DaeBenchmark, tolerance: float) -> FloatArray:
    """Return absolute tolerances: the tolerance itself, times the size of small species."""
    scale = ORDINARY["ROBER"].atol if problem.name == "Robertson" else np.ones(problem.y0.size)
    return tolerance * scale


def with_mebdf(problem: DaeBenchmark, tolerance: float) -> dict[str, Any]:
    """Return digits and costs here."""
    options: dict[str, Any] = {"mass": problem.mass, "index": problem.index, "jac": problem.jac}
    found = solve_ivp(
        problem.fun, (0.0, problem.t_end), problem.y0, method=MEBDF,
        rtol=tolerance, atol=absolute(problem, tolerance), **options,
    )  # fmt: skip
    digits = problem.digits(found.y[:, -1])
    return {"failed": not found.success, "digits": digits, "calls": found.nfev, "lu": found.nlu}


def with_ida(problem: DaeBenchmark, tolerance: float) -> dict[str, Any]:
    """Return digits and costs of IDA."""
    from sksundae.ida import IDA

    counts = {"calls": 0, "lu": 0}

    def residual(t: float, y: FloatArray, slope: FloatArray, out: FloatArray) -> None:
        counts["calls"] += 1
        out[:] = problem.mass @ slope - problem.fun(t, y)

    def jacobian(
        t: float, y: FloatArray, slope: FloatArray, out: FloatArray, c: float, J: FloatArray
    ) -> None:
        counts["lu"] += 1
        J[:, :] = c * problem.mass - problem.jac(t, y)

    atol = np.where(np.array(problem.index) > 1, FREE, absolute(problem, tolerance))
    slope = np.linalg.lstsq(problem.mass, problem.fun(0.0, problem.y0))[0]
    solver = IDA(
        residual, jacfn=jacobian, rtol=tolerance, atol=atol, max_num_steps=MOST_STEPS,
        algebraic_idx=np.flatnonzero(~problem.mass.any(axis=0)) if problem.name != "transistor" else None,
    )  # fmt: skip
    found = solver.solve(np.array([0.0, problem.t_end]), problem.y0, slope)
    y = np.asarray(found.y)[-1]
    failed = not found.success or not np.isfinite(y).all()
    return {"failed": failed, "digits": -1.0 if failed else problem.digits(y), **counts}


SOLVERS: Final = {"MEBDF": with_mebdf, "IDA": with_ida}


def measure(problem: DaeBenchmark, tolerances: list[float]) -> dict[str, list[dict[str, Any]]]:
    """Return the runs of both, in turn, with the time of the thread [s]."""
    import time

    runs: dict[str, list[dict[str, Any]]] = {name: [] for name in SOLVERS}
    for tolerance in tolerances:
        for name, solver in SOLVERS.items():
            begin = time.thread_time()
            found = solver(problem, tolerance)
            runs[name].append({"tolerance": tolerance, **found, "seconds": time.thread_time() - begin})
    return runs


def ratios(runs: dict[str, list[dict[str, Any]]]) -> list[float] | None:
    """Return costs here over those of IDA, geometric means over the digits that both reach; or nothing."""
    good = [[run["digits"] for run in found if not run["failed"]] for found in runs.values()]
    if not all(good) or min(map(max, good)) <= 0.0:
        return None
    low, high = max(max(map(min, good)), 0.0), min(map(max, good))
    if high - low < 1.0:
        return None
    at = np.linspace(low, high, 5)
    logs = [
        [
            np.log(cost_at(runs["MEBDF"], d, itemgetter(c)) / cost_at(runs["IDA"], d, itemgetter(c)))
            for c in COSTS
        ]
        for d in at.tolist()
    ]
    mean: list[float] = np.exp(np.mean(logs, axis=0)).tolist()
    return mean


def draw(everything: dict[str, dict[str, list[dict[str, Any]]]]) -> None:
    """Draw digits against costs, a row a problem."""
    with mpl.rc_context({"font.size": 9, "axes.titlesize": 9}):
        figure = Figure(figsize=(8.0, 1.75 * len(everything) + 0.6), layout="constrained", facecolor="white")
        axes = figure.subplots(len(everything), len(COSTS), squeeze=False)
        for row, (name, runs) in zip(axes, everything.items(), strict=True):
            for axis, cost in zip(row, COSTS, strict=True):
                axis.set(yscale="log")
                axis.yaxis.set_minor_formatter(NullFormatter())
                axis.grid(alpha=0.3)
                for solver, look in LOOKS.items():
                    good = [run for run in runs[solver] if not run["failed"] and run["digits"] > 0.0]
                    axis.plot([run["digits"] for run in good], [run[cost] for run in good], **look)
            row[0].set_ylabel(name.replace(", ", ",\n"))
        for above, below, cost in zip(axes[0], axes[-1], COSTS, strict=True):
            above.set_title(LABELS[cost])
            below.set_xlabel("correct digits")
        figure.legend(axes[0, 0].get_lines(), LOOKS, loc="outside upper center", ncols=len(LOOKS))
        figure.savefig(TARGET.with_suffix(".png"), dpi=110, pil_kwargs={"optimize": True})


def run(quick: bool = False) -> dict[str, list[float] | None]:
    """Measure, print and return the ratios; unless ``quick``, which takes two problems, store and draw."""
    names = ("pendulum, index 1", "pendulum, index 2") if quick else tuple(PROBLEMS)
    everything, table = {}, {}
    for name in names:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # multipliers of the car axis are changed at the start
            everything[name] = measure(PROBLEMS[name](), TOLERANCES[:: 4 if quick else 1].tolist())
        table[name] = ratios(everything[name])
        failed = [sum(run["failed"] for run in runs) for runs in everything[name].values()]
        best = [max(run["digits"] for run in runs) for runs in everything[name].values()]
        text = " ".join(f"{value:5.2f}" for value in table[name] or [])
        print(f"{name:28s} residuals, LU, time over IDA: {text or 'none'}; failed {failed}, best {best}")
    if not quick:
        text = json.dumps(rounded({"ratios to IDA": table, "runs": everything}), separators=(",", ":"))
        TARGET.with_suffix(".json").write_text(text + "\n", encoding="utf-8")
        draw(everything)
    return table


if __name__ == "__main__":
    run()
