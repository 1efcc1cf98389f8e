"""Work and precision of the MEBDF beside CVODE and SciPy's stiff solvers, all in one run.

    python -m benchmarks.solver.work_precision          # or: make bench

writes ``docs/_static/mebdf_work_precision.json`` and ``.png`` and prints the ratios to CVODE at equal digits.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from benchmarks.solver.cvode_native import cvode
from benchmarks.solver.mebdf_native import mebdf
from benchmarks.solver.problems import PROBLEMS, Benchmark
from benchmarks.solver.scipy_solvers import scipy_solver
from tribodyn.figures.style import BLUE, GREEN, INK, ORANGE, VERMILION

TARGET = Path(__file__).parents[2] / "docs" / "_static" / "mebdf_work_precision"
COMPILED = 10.0 ** -np.arange(2.5, 11.1, 0.25)
IN_PYTHON = 10.0 ** -np.arange(3.0, 10.1, 1.0)
TOO_LONG_IN_PYTHON = ("RING", "VDP11")
REPEATS = 5  #: Compiled runs are timed this often; the shortest counts. The solvers take turns.
DIGITS = (5.0, 7.5)

Everything = dict[str, dict[str, list[dict[str, Any]]]]  #: Runs by problem and solver.
Run = Callable[[Benchmark, float], dict[str, Any]]
#: Given the exact Jacobian too; the evaluations for differences are added in the ratios.
DIFFERENCED = "MEBDF, J by differences"
COMPILED_SOLVERS: dict[str, Run] = {
    "MEBDF": mebdf,
    DIFFERENCED: partial(mebdf, differenced=True),
    "CVODE": cvode,
}
PYTHON_SOLVERS: dict[str, Run] = {
    f"SciPy {method}": partial(scipy_solver, method) for method in ("BDF", "Radau", "LSODA")
}

QUANTITIES = (
    ("rhs", 1.0, "right-hand sides"),
    ("lu", 1.0, "LU decompositions"),
    ("seconds", 1e3, "time [ms]"),
)
#: How the solvers drawn look.
LOOKS: dict[str, dict[str, Any]] = {
    "MEBDF": {"color": VERMILION, "linewidth": 1.8},
    "CVODE": {"color": INK, "linewidth": 1.0},
    "SciPy BDF": {"color": BLUE, "linewidth": 1.0, "linestyle": "--"},
    "SciPy Radau": {"color": GREEN, "linewidth": 1.0, "linestyle": "-."},
    "SciPy LSODA": {"color": ORANGE, "linewidth": 1.0, "linestyle": ":"},
}


def timed(problem: Benchmark, rtol: float) -> dict[str, dict[str, Any]]:
    """Return a run of each compiled solver with the shortest of several times."""
    repeats = 1 if problem.name == "RING" else REPEATS
    runs: dict[str, list[dict[str, Any]]] = {name: [] for name in COMPILED_SOLVERS}
    for _ in range(repeats):
        for name, solver in COMPILED_SOLVERS.items():
            runs[name].append(solver(problem, rtol))
    return {name: min(found, key=lambda run: run["seconds"]) for name, found in runs.items()}


def measure(problem: Benchmark) -> dict[str, list[dict[str, Any]]]:
    """Return the runs of every solver."""
    results: dict[str, list[dict[str, Any]]] = {}
    for rtol in (COMPILED[::2] if problem.name == "RING" else COMPILED).tolist():
        for name, run in timed(problem, rtol).items():
            run.pop("y", None)
            results.setdefault(name, []).append({"rtol": rtol, **run})
    if problem.name not in TOO_LONG_IN_PYTHON:
        for name, solver in PYTHON_SOLVERS.items():
            results[name] = [{"rtol": rtol, **solver(problem, rtol)} for rtol in IN_PYTHON.tolist()]
    return results


def cost_at(runs: list[dict[str, Any]], digits: float, cost: Callable[[dict[str, Any]], float]) -> float:
    """Return the cost at a number of digits: a line through its logarithm over the runs near by."""
    found = [(run["digits"], cost(run)) for run in runs if not run["failed"] and cost(run) > 0.0]
    distance, value = np.array(found).T
    distance = distance - digits
    weight = np.exp(-0.5 * (distance / 0.7) ** 2)
    terms = np.stack((np.ones_like(distance), distance), axis=1) * weight[:, None]
    return float(np.exp(np.linalg.lstsq(terms, np.log(value) * weight)[0][0]))


def ratios(name: str, results: dict[str, list[dict[str, Any]]]) -> list[float]:
    """Return MEBDF over CVODE at each number of digits: calls, calls with differences for J, LU, time."""
    n = PROBLEMS[name].y0.size
    costs: tuple[tuple[str, Callable[[dict[str, Any]], float]], ...] = (
        ("MEBDF", lambda run: run["rhs"]),
        (DIFFERENCED, lambda run: run["rhs"] + n * run["jac"]),
        ("MEBDF", lambda run: run["lu"]),
        ("MEBDF", lambda run: run["seconds"]),
    )
    return [
        cost_at(results[ours], digits, cost) / cost_at(results["CVODE"], digits, cost)
        for digits in DIGITS
        for ours, cost in costs
    ]


def rounded(value: Any) -> Any:
    """Return numbers, in whatever mappings and lists, with four significant digits."""
    if isinstance(value, dict):
        return {name: rounded(entry) for name, entry in value.items()}
    if isinstance(value, list):
        return [rounded(entry) for entry in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value


def store(everything: Everything, table: dict[str, list[float]]) -> None:
    """Write the numbers, the runs of a solver as columns."""
    runs = {
        name: {
            solver: {key: [run[key] for run in runs] for key in runs[0]} for solver, runs in results.items()
        }
        for name, results in everything.items()
    }
    text = json.dumps(rounded({"ratios to CVODE": table, "runs": runs}), separators=(",", ":"))
    TARGET.with_suffix(".json").write_text(text + "\n", encoding="utf-8")


def draw(everything: Everything, target: Path) -> None:
    """Draw digits against calls, decompositions and time, a row a problem."""
    with mpl.rc_context({"font.size": 9, "axes.titlesize": 9}):
        figure = Figure(figsize=(8.0, 1.75 * len(everything) + 0.6), layout="constrained", facecolor="white")
        axes = figure.subplots(len(everything), len(QUANTITIES), squeeze=False)
        for row, (name, results) in zip(axes, everything.items(), strict=True):
            for axis, (key, factor, label) in zip(row, QUANTITIES, strict=True):
                axis.set(yscale="log", title=f"{name}: {label}")
                axis.yaxis.set_minor_formatter(NullFormatter())
                axis.grid(alpha=0.3)
                for solver, look in LOOKS.items():
                    good = [
                        run for run in results.get(solver, []) if not run["failed"] and run["digits"] > 0.0
                    ]
                    axis.plot([run["digits"] for run in good], [factor * run[key] for run in good], **look)
        for axis in axes[-1]:
            axis.set_xlabel("correct digits")
        figure.legend(axes[0, 0].get_lines(), LOOKS, loc="outside upper center", ncols=len(LOOKS))
        figure.savefig(target, dpi=110, pil_kwargs={"optimize": True})


def main() -> None:
    """Measure, store, draw and print."""
    for problem in PROBLEMS.values():  # compile before anything is timed
        for solver in COMPILED_SOLVERS.values():
            solver(problem, 1e-3)
    everything = {name: measure(problem) for name, problem in PROBLEMS.items()}
    table = {name: ratios(name, results) for name, results in everything.items()}
    mean = np.exp(np.mean(np.log(list(table.values())), axis=0)).tolist()
    store(everything, {**table, "geometric mean": mean})
    draw(everything, TARGET.with_suffix(".png"))
    print("MEBDF / CVODE at 5 and 7.5 digits: calls, calls with differences for J, LU, time")
    for name, values in (*table.items(), ("geometric mean", mean)):
        print(f"{name:15s}", " ".join(f"{value:5.2f}" for value in values))


if __name__ == "__main__":
    main()
