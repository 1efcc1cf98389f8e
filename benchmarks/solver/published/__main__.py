"""Digits against calls on problems of the published sets: MEBDF beside CVODE, IDA, BDF and Radau.

    python -m benchmarks.solver.published

writes ``docs/_static/mebdf_published.csv``. Calls are all those of the right-hand side, with those for
differences. CVODE and IDA are those of scikit-sundae. The two-bit adder is not stated here.
"""

from __future__ import annotations

import csv
import warnings
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np
from scipy.integrate import solve_ivp
from sksundae.cvode import CVODE
from sksundae.ida import IDA

from benchmarks.solver.published.definitions import Published, beam, fekete, medical_akzo, plate, water_tube
from benchmarks.solver.published.emep import emep
from benchmarks.solver.published.wheelset import wheelset
from mebdf import MEBDF

TARGET: Final = Path(__file__).parents[2] / "docs" / "_static" / "mebdf_published.csv"
PROBLEMS: Final = {
    "plate": plate, "beam": beam, "beam, order 4": partial(beam, max_order=4), "medical Akzo": medical_akzo,
    "EMEP": emep, "water tube": water_tube, "wheelset": wheelset,
    **{f"Fekete, {n} points": partial(fekete, n) for n in (8, 20, 32)},
}  # fmt: skip
TOLERANCES: Final = (1e-3, 1e-5, 1e-7)
MOST_CALLS: Final = 200_000


class TooManyError(Exception):
    """More calls than a run is worth."""


def solve(problem: Published, solver: str, rtol: float) -> tuple[float, int]:
    """Return digits, NaN for a failed run, and calls."""
    calls, span, atol = 0, (problem.start, problem.t_end), rtol * problem.unit

    def fun(t: float, y: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls > MOST_CALLS:
            raise TooManyError
        return problem.fun(t, np.ascontiguousarray(y))

    def into(t: float, y: Any, out: Any) -> None:
        out[:] = fun(t, y)

    def residual(t: float, y: Any, slope: Any, out: Any) -> None:
        out[:] = mass * slope - fun(t, y)

    options = problem.options
    bands = {name: options[name] for name in ("lband", "uband") if name in options}
    mass = options.get("mass", np.ones(problem.y0.size))
    try:
        if solver == "MEBDF":
            found = solve_ivp(fun, span, problem.y0, method=MEBDF, rtol=rtol, atol=atol, **options)
        elif solver in ("BDF", "Radau"):
            sparsity = np.tri(problem.y0.size, k=2) * np.tri(problem.y0.size, k=2).T if bands else None
            found = solve_ivp(
                fun, span, problem.y0, method=solver, rtol=rtol, atol=atol, jac_sparsity=sparsity
            )
        elif solver == "CVODE":
            linear = {"linsolver": "band", **bands} if bands else {}
            made = CVODE(into, rtol=rtol, atol=atol, max_num_steps=MOST_CALLS, **linear)
            found = made.solve(np.array(span), problem.y0)
            found.y = found.y.T
        else:
            free = np.where(mass > 0.0, atol, 1e10)
            algebraic = np.flatnonzero(mass == 0.0)
            made = IDA(residual, rtol=rtol, atol=free, algebraic_idx=algebraic, max_num_steps=MOST_CALLS)
            found = made.solve(np.array(span), problem.y0, mass * fun(problem.start, problem.y0))
            found.y = found.y.T
        return (problem.digits(found.y[:, -1]) if found.success else np.nan), calls
    except Exception:  # a solver's refusal is its result
        return np.nan, calls


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return digits and calls; ``quick``: of one problem at one tolerance."""
    found: dict[str, Any] = {}
    for name in list(PROBLEMS)[:1] if quick else PROBLEMS:
        problem = PROBLEMS[name]()
        solvers = ("MEBDF", "IDA") if "mass" in problem.options else ("MEBDF", "CVODE", "BDF", "Radau")
        solvers = ("MEBDF",) if "max_order" in problem.options else solvers
        for solver in solvers:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                rows = [solve(problem, solver, rtol) for rtol in TOLERANCES[: 1 if quick else None]]
            found[f"{name}, {solver}"] = rows
            shown = "  ".join(f"{digits:5.2f} {calls:7d}" for digits, calls in rows)
            print(f"{name:18s} {solver:6s} {shown}", flush=True)
    if not quick:
        heads = [f"{what} at {rtol:g}" for rtol in TOLERANCES for what in ("digits", "calls")]
        lines = [
            [*name.rsplit(", ", 1), *(f"{n:.4g}" for row in rows for n in row)]
            for name, rows in found.items()
        ]
        with TARGET.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([["problem", "solver", *heads], *lines])
    return found


if __name__ == "__main__":
    run()
