"""The MEBDF in compiled code on a benchmark problem, with nothing around it."""

from __future__ import annotations

import time
from functools import cache
from typing import Any

import numba as nb
import numpy as np
from numba.core.types import FunctionType

from benchmarks.problems import JAC, RHS, Benchmark
from mebdf.kernels.arrays import copy
from mebdf.kernels.core import resume
from mebdf.kernels.jit import entry, kernel
from mebdf.kernels.phases import FAILED, NEED_F, NEED_JACOBIAN
from mebdf.kernels.state import HISTORY, JACOBIAN, F, Y, new_state

LONG_ENOUGH = 0.01
"""Least time of a measured call [s]."""


@kernel
def _run(rhs, jac, state):  # type: ignore[no-untyped-def]
    """Integrate to the end."""
    record, rows, matrices, pivots, mass, places = state
    numbers, y, f, jacobian = record[0], rows[Y], rows[F], matrices[JACOBIAN]
    while True:
        request = resume(record, rows, matrices, pivots, mass, places)
        if request == NEED_F:
            rhs(numbers.t_eval, y, f)
        elif request == NEED_JACOBIAN:
            jac(numbers.t_eval, y, jacobian)
        elif request == FAILED:
            return True
        elif numbers.t == numbers.t_end:
            return False


@entry
def _repeated(rhs, jac, state, start, repeats):  # type: ignore[no-untyped-def]
    """Integrate again and again from the same start."""
    failed = False
    for _ in range(repeats):
        copy(start[0], state.numbers)
        copy(start[1].reshape(-1), state.rows.reshape(-1))
        failed = _run(rhs, jac, state)
    return failed


@cache
def _compiled() -> Any:
    state = new_state(0.0, np.zeros(1), 1.0, 1e-3, np.ones(1))
    types = map(nb.typeof, (state, tuple(state)[:2]))
    return _repeated.compile((FunctionType(RHS), FunctionType(JAC), *types, nb.int64))


def mebdf(
    problem: Benchmark,
    rtol: float,
    settings: dict[str, float] | None = None,
    at_least: float = LONG_ENOUGH,
    differenced: bool = False,
) -> dict[str, Any]:
    """Integrate; return digits, counts and the time of the integration alone [s].

    Reaching a function that is an argument takes numba some 100 µs, once a call. It is not the method's, so
    short integrations are repeated within the call until it does not count: for ``at_least`` so long [s].
    ``differenced`` treats the Jacobian as one that costs evaluations.
    """
    loop = _compiled()
    state = new_state(0.0, problem.y0, problem.t_end, rtol, problem.atol * rtol, differenced=int(differenced))
    for name, value in (settings or {}).items():
        state.numbers["settings"][name] = value
    start = (state.numbers.copy(), state.rows.copy())
    repeats, seconds = 1, 0.0
    while True:
        begin = time.thread_time()
        failed = loop(problem.rhs, problem.jac, state, start, repeats)
        seconds = time.thread_time() - begin
        if seconds > at_least:
            break
        repeats = max(2 * repeats, min(100 * repeats, int(1.2 * repeats * at_least / seconds)))
    seconds /= repeats
    more = {"rhs": "n_f", "jac": "n_j", "lu": "n_lu", "solves": "n_solves"}
    fields = {"steps": "steps", **more, "rejected": "rejected"}
    counts = {name: state.number(field) for name, field in fields.items()}
    return {
        "failed": failed, "digits": problem.digits(state.rows[HISTORY]), **counts, "seconds": seconds,
        "y": state.rows[HISTORY].copy(),
    }  # fmt: skip
