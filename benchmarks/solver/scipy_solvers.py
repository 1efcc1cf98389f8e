"""SciPy's stiff solvers on a benchmark problem, with the same compiled functions."""

from __future__ import annotations

import time
import warnings
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.solver.problems import Benchmark, FloatArray


def scipy_solver(method: str, problem: Benchmark, rtol: float) -> dict[str, Any]:
    """Integrate with ``BDF``, ``Radau`` or ``LSODA``; return digits, counts and time [s], Python included."""
    n = problem.y0.size
    calls = {"rhs": 0, "jac": 0}

    def rhs(t: float, y: FloatArray) -> FloatArray:
        calls["rhs"] += 1
        f = np.empty(n)
        problem.rhs(t, np.ascontiguousarray(y), f)
        return f

    def jac(t: float, y: FloatArray) -> FloatArray:
        calls["jac"] += 1
        jacobian = np.empty((n, n))
        problem.jac(t, np.ascontiguousarray(y), jacobian)
        return jacobian

    options = {"method": method, "jac": jac, "rtol": rtol, "atol": problem.atol * rtol}
    begin = time.thread_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        solution = solve_ivp(rhs, (0.0, problem.t_end), problem.y0, **options)
    seconds = time.thread_time() - begin
    return {
        "failed": not solution.success,
        "digits": problem.digits(solution.y[:, -1]) if np.isfinite(solution.y[:, -1]).all() else -1.0,
        "steps": solution.t.size - 1,
        **calls,
        "lu": int(solution.nlu),
        "seconds": seconds,
    }
