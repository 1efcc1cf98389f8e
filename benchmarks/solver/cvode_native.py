"""CVODE called without Python in between: the SUNDIALS libraries that scikit-sundae brings, through ctypes.

The right-hand side and the Jacobian are the compiled functions of the benchmark, wrapped as C functions.
"""

from __future__ import annotations

import ctypes as ct
import time
from functools import cache
from typing import Any

import numba as nb
import numpy as np

from benchmarks.solver.mebdf_native import LONG_ENOUGH
from benchmarks.solver.problems import Benchmark
from benchmarks.solver.sundials import CV_NORMAL, Cvode, columns, counts, library, numbers


@cache
def _callbacks(name: str) -> tuple[Any, Any]:
    """Return the C functions of a problem."""
    from benchmarks.solver.problems import PROBLEMS

    problem = PROBLEMS[name]
    rhs, jac, n = problem.rhs, problem.jac, problem.y0.size
    address = nb.types.intp

    @nb.cfunc(nb.int32(nb.float64, address, address, address))
    def c_rhs(t, y, f, user):  # type: ignore[no-untyped-def]
        rhs(t, numbers(y, n), numbers(f, n))
        return 0

    @nb.cfunc(nb.int32(nb.float64, address, address, address, address, address, address, address))
    def c_jac(t, y, f, matrix, user, a, b, c):  # type: ignore[no-untyped-def]
        filled = columns(matrix, n)
        rows = np.empty((n, n))
        jac(t, numbers(y, n), rows)
        for i in range(n):
            for j in range(n):
                filled[j, i] = rows[i, j]
        return 0

    return c_rhs, c_jac


def cvode(problem: Benchmark, rtol: float) -> dict[str, Any]:
    """Integrate with CVODE; return digits, counts and the time of the integration alone [s].

    As with the MEBDF, the last step may go beyond the end, and short integrations are repeated.
    """
    c_rhs, c_jac = _callbacks(problem.name)
    y = problem.y0.copy()
    solver = Cvode(c_rhs.address, c_jac.address, 0.0, y, rtol, problem.atol * rtol)
    reached, end = ct.c_double(0.0), ct.c_double(problem.t_end)
    function = library()["cvode"].CVode
    flag, repeats, seconds = 0, 0, 0.0
    while flag >= 0 and seconds < LONG_ENOUGH:
        y[:] = problem.y0
        solver("CVodeReInit", ct.c_double(0.0), solver.y)
        begin = time.thread_time()
        flag = function(solver.memory, end, solver.y, ct.byref(reached), CV_NORMAL)
        seconds += time.thread_time() - begin
        repeats += 1
    found = counts(solver.memory)
    solver.free()
    return {"failed": flag < 0, "digits": problem.digits(y), **found, "seconds": seconds / repeats}
