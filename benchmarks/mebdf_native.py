"""The MEBDF in compiled code on a benchmark problem, with nothing around it."""

from __future__ import annotations

import time
from functools import cache
from typing import Any

import numba as nb
from numba.core.types import FunctionType

from benchmarks.problems import JAC, RHS, Benchmark
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mebdf.core import resume
from tribodyn.kernels.mebdf.phases import FAILED, NEED_F, NEED_JACOBIAN
from tribodyn.kernels.mebdf.state import (
    HISTORY,
    JACOBIAN,
    N_F,
    N_J,
    N_LU,
    N_SOLVES,
    REJECTED,
    STEPS,
    T_END,
    T_EVAL,
    F,
    T,
    Y,
    new_state,
)


@kernel
def _run(rhs, jac, real, counts, rows, matrices):  # type: ignore[no-untyped-def]
    """Integrate to the end."""
    y, f, jacobian = rows[Y], rows[F], matrices[JACOBIAN]
    while True:
        request = resume(real, counts, rows, matrices)
        if request == NEED_F:
            rhs(real[T_EVAL], y, f)
        elif request == NEED_JACOBIAN:
            jac(real[T_EVAL], y, jacobian)
        elif request == FAILED:
            return True
        elif real[T] == real[T_END]:
            return False


@kernel
def _nothing(rhs, jac, real, counts, rows, matrices):  # type: ignore[no-untyped-def]
    """Do nothing with the same arguments."""
    return False


@cache
def _compiled() -> tuple[Any, Any]:
    floats, square, cube = nb.float64[::1], nb.float64[:, ::1], nb.float64[:, :, ::1]
    types = (FunctionType(RHS), FunctionType(JAC), floats, nb.int64[::1], square, cube)
    return _run.compile(types), _nothing.compile(types)


def mebdf(problem: Benchmark, rtol: float, settings: dict[int, float] | None = None) -> dict[str, Any]:
    """Integrate; return digits, counts and the time of the integration alone [s]."""
    loop, idle = _compiled()
    state = new_state(0.0, problem.y0, problem.t_end, rtol, problem.atol * rtol)
    for place, value in (settings or {}).items():
        state.real[place] = value
    begin = time.perf_counter()
    failed = loop(problem.rhs, problem.jac, *state)
    seconds = time.perf_counter() - begin
    # Reaching a function that is an argument takes numba some 100 µs, once an integration: not the method's.
    overhead = []
    for _ in range(3):
        begin = time.perf_counter()
        idle(problem.rhs, problem.jac, *state)
        overhead.append(time.perf_counter() - begin)
    seconds -= min(overhead)
    names = {"steps": STEPS, "rhs": N_F, "jac": N_J, "lu": N_LU, "solves": N_SOLVES, "rejected": REJECTED}
    counts = {name: int(state.counts[place]) for name, place in names.items()}
    return {
        "failed": failed, "digits": problem.digits(state.rows[HISTORY]), **counts, "seconds": seconds,
        "y": state.rows[HISTORY].copy(),
    }  # fmt: skip
