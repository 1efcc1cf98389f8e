"""The MEBDF with compiled functions of a benchmark problem: the integration alone, and by ``solve_ivp``."""

from __future__ import annotations

import time
from functools import cache
from typing import Any

import numba as nb
from scipy.integrate import solve_ivp

from benchmarks.solver.problems import PROBLEMS, Benchmark
from mebdf import MEBDF
from mebdf.kernels.state import HISTORY

LONG_ENOUGH = 0.01  #: Least time of a measured call [s].
AT_ONCE = 1000  #: Steps in compiled code between two looks of Python.
MOST_CALLS = 10**7  #: Evaluations after which a run is ended as failed.
_NUMBERS = nb.types.CPointer(nb.float64)
_SIGNATURE = nb.void(nb.float64, _NUMBERS, _NUMBERS, _NUMBERS)


@cache
def c_functions(name: str) -> tuple[Any, Any]:
    """Return right-hand side and Jacobian of a problem as C functions."""
    rhs, jac, n = PROBLEMS[name].rhs, PROBLEMS[name].jac, PROBLEMS[name].y0.size

    @nb.cfunc(_SIGNATURE)
    def c_rhs(t, y, f, data):  # type: ignore[no-untyped-def]
        rhs(t, nb.carray(y, n), nb.carray(f, n))

    @nb.cfunc(_SIGNATURE)
    def c_jac(t, y, jacobian, data):  # type: ignore[no-untyped-def]
        jac(t, nb.carray(y, n), nb.carray(jacobian, (n, n)))

    return c_rhs, c_jac


def options_of(problem: Benchmark, rtol: float, *, differenced: bool) -> tuple[Any, dict[str, Any]]:
    """Return the right-hand side and the options of a problem."""
    rhs, jac = c_functions(problem.name)
    return rhs, {"rtol": rtol, "atol": problem.atol * rtol, "jac": None if differenced else jac}


def mebdf(
    problem: Benchmark,
    rtol: float,
    settings: dict[str, float] | None = None,
    at_least: float = LONG_ENOUGH,
    differenced: bool = False,
) -> dict[str, Any]:
    """Integrate; return digits, counts and the time of the integration alone [s].

    Short integrations are repeated for ``at_least`` so long [s]. ``differenced`` takes the Jacobian from
    differences, whose evaluations are not counted.
    """
    rhs, options = options_of(problem, rtol, differenced=differenced)
    repeats, seconds = 0, 0.0
    while repeats == 0 or seconds < at_least:
        solver = MEBDF(rhs, 0.0, problem.y0, problem.t_end, steps_at_once=AT_ONCE, **options)
        for name, value in (settings or {}).items():
            solver._state.numbers["settings"][name] = value
        begin = time.thread_time()
        while solver.status == "running" and solver.nfev < MOST_CALLS:
            solver.step()
        seconds += time.thread_time() - begin
        repeats += 1
    fields = {"steps": "steps", "rhs": "n_f", "jac": "n_j", "lu": "n_lu", "rejected": "rejected"}
    counts = {name: solver._state.number(field) for name, field in fields.items()}
    y = solver._state.rows[HISTORY].copy()
    failed = solver.status != "finished"
    return {"failed": failed, "digits": problem.digits(y), **counts, "seconds": seconds / repeats, "y": y}


def by_scipy(
    problem: Benchmark, rtol: float, at_once: int = 1, *, differenced: bool = False
) -> dict[str, Any]:
    """Call SciPy's ``solve_ivp``; return digits and the time of the whole call [s]."""
    rhs, options = options_of(problem, rtol, differenced=differenced)
    span, repeats, begin = (0.0, problem.t_end), 0, time.thread_time()
    while repeats == 0 or time.thread_time() - begin < LONG_ENOUGH:
        solution = solve_ivp(rhs, span, problem.y0, method=MEBDF, steps_at_once=at_once, **options)
        repeats += 1
    seconds = (time.thread_time() - begin) / repeats
    return {"failed": not solution.success, "digits": problem.digits(solution.y[:, -1]), "seconds": seconds}
