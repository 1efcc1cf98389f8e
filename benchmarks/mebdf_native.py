"""The MEBDF in compiled code on a benchmark problem, with nothing around it."""

from __future__ import annotations

import time
from functools import cache
from typing import Any

from benchmarks.problems import Benchmark
from mebdf.kernels.arrays import copy
from mebdf.kernels.core import resume
from mebdf.kernels.jit import kernel
from mebdf.kernels.phases import FAILED, NEED_F, NEED_JACOBIAN
from mebdf.kernels.state import HISTORY, JACOBIAN, F, Y, new_state

LONG_ENOUGH = 0.01
"""Least time of a measured call [s]."""


@cache
def _loop(rhs: Any, jac: Any) -> Any:
    """Return a compiled function that integrates a problem again and again from the same start."""

    @kernel
    def run(state):  # type: ignore[no-untyped-def]
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

    @kernel
    def repeated(state, start, repeats):  # type: ignore[no-untyped-def]
        failed = False
        for _ in range(repeats):
            copy(start[0], state.numbers)
            copy(start[1].reshape(-1), state.rows.reshape(-1))
            failed = run(state)
        return failed

    return repeated


def mebdf(
    problem: Benchmark,
    rtol: float,
    settings: dict[str, float] | None = None,
    at_least: float = LONG_ENOUGH,
    differenced: bool = False,
) -> dict[str, Any]:
    """Integrate; return digits, counts and the time of the integration alone [s].

    A call from Python takes some microseconds. Short integrations are repeated within the call until it does
    not count: for ``at_least`` so long [s].
    ``differenced`` treats the Jacobian as one that costs evaluations.
    """
    loop = _loop(problem.rhs, problem.jac)
    state = new_state(0.0, problem.y0, problem.t_end, rtol, problem.atol * rtol, differenced=int(differenced))
    for name, value in (settings or {}).items():
        state.numbers["settings"][name] = value
    start = (state.numbers.copy(), state.rows.copy())
    loop(state, start, 1)  # compiles
    repeats, seconds = 1, 0.0
    while True:
        begin = time.thread_time()
        failed = loop(state, start, repeats)
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
