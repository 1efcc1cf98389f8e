"""Where the time of a run goes: functions of the problem, parts of an evaluation, and what follows the run.

python -m benchmarks.shares

The functions are called from compiled loops, on states and memories that runs leave at their ends, spread
over the time of the whole one: at rest few nodes touch, and a call costs less. From Python a call first takes
its arguments apart, which costs more than an evaluation. ``advance`` is called off the constraints, as at the
end of a step: where they hold already it has nothing to correct and costs two thirds. A share is mean time of
a call times number of calls over the processor time of the integration; Newton's iterations solve once for
each evaluation at most. What Python does around the compiled loop, most of all with rows, is measured in the
run; half of it is the first use of their memory. What is left is the solver itself, and what a call costs
more in a run than when it is repeated on one state, with its data at hand and its branches foreseen. Start
and result are those of the whole simulation. Rings of vanes have a benchmark of their own, ``ring``.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Final
from unittest import mock

import numpy as np

import tribodyn as td
from benchmarks.engine_loops import PARTS, repeat
from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.problem import LinearSolver
from tribodyn.integrate import mebdf
from tribodyn.kernels.jit import kernel
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart
from tribodyn.mechanisms.results import summarise
from tribodyn.simulation.session import Session

CASES: Final = ("vsv", "vsv-free", "vsv-joints")
CYCLES: Final = 2.0
ENDS: Final = (0.07, 0.19, 0.31, 0.43, 0.57, 0.69, 0.81, 0.93)
"""Parts of the whole time after which the states are taken."""
CALLS: Final = 1000
PASSES: Final = 3
AWAY: Final = 1.0e-9
"""Part by which the state differs from one on the constraints at the end of a step."""
GAMMA: Final = 1.0e-4
"""Step times coefficient of the factorised matrix [s]; the time does not depend on it."""


@kernel
def _evaluated(
    function: Callable[..., None], t: float, y: FloatArray, data: Any, memory: Any, f: FloatArray, calls: int
) -> None:
    for _ in range(calls):
        function(t, y, data, memory, f)


@kernel
def _differentiated(
    function: Callable[..., None],
    t: float,
    y: FloatArray,
    data: Any,
    memory: Any,
    f: FloatArray,
    matrix: FloatArray,
    calls: int,
) -> None:
    for _ in range(calls):
        function(t, y, data, memory, f, matrix)


@kernel
def _advanced(
    function: Callable[..., None], t: float, y: FloatArray, data: Any, memory: Any, calls: int
) -> None:
    for _ in range(calls):
        function(t, t, y, data, memory)


@kernel
def _accepted(
    function: Callable[..., None], t: float, y: FloatArray, data: Any, memory: Any, calls: int
) -> None:
    for _ in range(calls):
        function(t, y, data, memory)


@kernel
def _factorised(
    function: Callable[..., int],
    gamma: float,
    data: Any,
    entries: FloatArray,
    factors: FloatArray,
    pivots: IntArray,
    calls: int,
) -> None:
    for _ in range(calls):
        function(gamma, data, entries, factors, pivots)


@kernel
def _solved(
    function: Callable[..., None], data: Any, factors: FloatArray, pivots: IntArray, x: FloatArray, calls: int
) -> None:
    for _ in range(calls):
        x[:] = 1.0
        function(data, factors, pivots, x)


def _microseconds(loop: Callable[[int], None], calls: int) -> float:
    """Return the least time of a call [µs].

    Python takes 10 ms to find out the types of the data of a mechanism; a loop without calls takes as long.
    """
    loop(1)
    least = {}
    for number in (0, calls) * PASSES:
        begin = time.thread_time()
        loop(number)
        took = time.thread_time() - begin
        least[number] = min(took, least.get(number, took))
    return 1e6 * (least[calls] - least[0]) / calls


def _numbers(run: FinishedRun) -> dict[str, float]:
    """Return how often a run calls the functions of its problem."""
    cost, n_rows = run.cost, float(run.solution.t.size)
    return {
        "rhs": cost["rhs_evaluations"],
        "jac": cost["jacobian_evaluations"],
        "advance": cost["steps"] + n_rows,
        "accept": cost["steps"],
        "observe": n_rows,
        "factorise": cost["lu_decompositions"],
        "solve": cost["rhs_evaluations"],
    }


def _means(times: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Return the mean of each entry."""
    return {name: sum(each[name] for each in times) / len(times) for name in times[0]}


def _functions(run: FinishedRun, calls: int) -> dict[str, float]:
    """Return the time of a call [µs] of the functions of a problem, at the end of a run."""
    problem = run.problem
    functions, data, memory = problem.functions, problem.data, problem.memory
    t, y, f = run.solution.t_end, run.solution.y_end.copy(), np.empty(problem.y0.size)
    away = y * (1.0 + AWAY * (-1.0) ** np.arange(y.size))
    n_entries = 0 if problem.algebra is None else problem.algebra.n_entries
    matrix = np.zeros(n_entries) if n_entries else np.zeros((y.size, y.size))
    row = np.empty(problem.n_observed)
    loops: dict[str, Callable[[int], None]] = {
        "rhs": lambda n: _evaluated(functions.rhs, t, y, data, memory, f, n),
        "jac": lambda n: _differentiated(functions.jac, t, y, data, memory, f, matrix, n),
        "advance": lambda n: _advanced(functions.advance, t, away, data, memory, n),
        "accept": lambda n: _accepted(functions.accept, t, y, data, memory, n),
        "observe": lambda n: _evaluated(functions.observe, t, y, data, memory, row, n),
    }
    times = {name: _microseconds(loop, calls) for name, loop in loops.items()}
    if problem.algebra is not None:
        times |= _own_algebra(problem.algebra, data, matrix, f, calls)
    return times


def _own_algebra(
    algebra: LinearSolver, data: Any, entries: FloatArray, x: FloatArray, calls: int
) -> dict[str, float]:
    """Return the time of a call [µs] of a problem's own linear algebra."""
    factors, pivots = np.zeros(algebra.n_factors), np.zeros(algebra.n_pivots, dtype=np.int64)
    prepare = partial(_factorised, algebra.factorise, GAMMA, data, entries, factors, pivots)
    solve = partial(_solved, algebra.solve, data, factors, pivots, x)
    return {"factorise": _microseconds(prepare, calls), "solve": _microseconds(solve, calls)}


def _parts(run: FinishedRun, calls: int) -> dict[str, float]:
    """Return the time of a call of parts of an evaluation [µs]."""
    problem, f = run.problem, np.empty(run.problem.y0.size)
    arguments = run.solution.t_end, run.solution.y_end.copy(), problem.data, problem.memory, f
    return {
        name: _microseconds(lambda n, part=part: repeat(part, n, *arguments), calls)  # type: ignore[misc]
        for part, name in enumerate(PARTS)
    }


def _integrated(session: Session, duration: float) -> tuple[FinishedRun, float, float]:
    """Return a run, the processor time of the integration, and that of the compiled loop alone [s]."""
    inside, compiled = [0.0], mebdf._compiled

    def timed(*arguments: Any) -> Callable[..., Any]:
        loop = compiled(*arguments)

        def call(*values: Any) -> Any:
            begin = time.thread_time()
            outcome = loop(*values)
            inside[0] += time.thread_time() - begin
            return outcome

        return call

    with mock.patch.object(mebdf, "_compiled", timed):
        begin = time.process_time()
        run = session.integrated(duration)
    return run, time.process_time() - begin, inside[0]


def measure(name: str, cycles: float, calls: int) -> dict[str, Any]:
    """Run a built-in case, print and return times and shares."""
    case: Any = td.load_case(name).replace({"run.cycles": cycles})
    mechanism = MECHANISMS[case.kind()]
    warm = Session(case.replace({"run.cycles": 0.01}), mechanism, mechanism.system(case))
    warm.integrated(0.01)
    begin = time.process_time()
    session = Session(case, mechanism, mechanism.system(case))
    problem_found = session.system.problem(case.duration)
    started = time.process_time() - begin
    run, whole, looped = _integrated(session, case.duration)
    after = time.process_time()
    dataset = session.dataset(run, ResultPart())
    summarise(dataset)
    result = time.process_time() - after
    ends = [session.integrated(part * case.duration) for part in ENDS]
    functions, numbers = _means([_functions(end, calls) for end in ends]), _numbers(run)
    shares = {key: 1e-6 * each * numbers[key] / whole for key, each in functions.items()}
    shares["Python around the loop, rows"] = 1.0 - looped / whole
    shares["solver and all else"] = 1.0 - sum(shares.values())
    print(f"{name}: {case.duration / whole:.1f} times as fast as it moves; start {started:.2f} s, ", end="")
    print(f"integration {whole:.3f} s, result {result:.2f} s, {problem_found.y0.size} states")
    for key, share in shares.items():
        called = f"{functions[key]:8.2f} us {numbers[key]:8.0f} calls" if key in functions else " " * 26
        print(f"  {key:32s} {called} {100.0 * share:5.1f} %")
    parts = _means([_parts(end, calls) for end in ends]) if case.kind() == "mechanism" else {}
    for key, each in parts.items():
        print(f"    {key:30s} {each:8.2f} us {100.0 * each / functions['rhs']:5.0f} % of an evaluation")
    return {
        "start": started,
        "integration": whole,
        "result": result,
        "functions": {key: {"microseconds": each, "calls": numbers[key]} for key, each in functions.items()},
        "shares": shares,
        "parts": parts,
    }


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: over a moment, for nothing but a trial."""
    cycles, calls = (0.01, 2) if quick else (CYCLES, CALLS)
    return {name: measure(name, cycles, calls) for name in (CASES[:2] if quick else CASES)}


if __name__ == "__main__":
    run()
