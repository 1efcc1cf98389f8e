"""Integrations by every solver: rows, cost, refusals, and pauses that change no bit."""

import json
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.integrate import SOLVERS, integrate, mebdf
from tribodyn.kernels.mebdf.drive import AFTER_EVALUATION
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import first_steps, simulate


def decay(t, y, data, memory, f):
    f[:] = -y


def decay_jac(t, y, data, memory, f, jacobian):
    jacobian[:] = -np.eye(y.size)


def observe(t, y, data, memory, row):
    row[:] = y


def nothing(*_):
    return None


PROBLEM = Problem(
    functions=CompiledFunctions(decay, decay_jac, nothing, nothing, nothing, observe, nothing),
    data=None,
    memory=None,
    y0=np.array([1.0, 2.0]),
    t_span=(0.0, 1.0),
    breakpoints=(0.5,),
    atol=np.full(2, 1e-9),
    state_names=("a", "b"),
    n_observed=2,
    field_shape=(),
)


@pytest.mark.parametrize("solver", SOLVERS)
def test_every_solver_reports_rows_and_cost(solver):
    y0 = PROBLEM.y0.copy()
    solution = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=np.linspace(0.0, 1.0, 5))
    exact = np.exp(-solution.t)[:, None] * y0
    np.testing.assert_allclose(solution.rows, exact, rtol=1e-4)  # accumulated over some 50 steps
    np.testing.assert_array_equal(PROBLEM.y0, y0)
    cost = solution.statistics
    assert cost.steps > 0
    assert cost.rhs_evaluations >= cost.steps
    assert cost.restarts == 1
    assert cost.wall_time > 0.0
    assert all(type(value) in (int, float) for value in vars(cost).values())


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_step_is_longer_than_asked(solver):
    ends = []
    functions = replace(PROBLEM.functions, accept=lambda t, *_: ends.append(t))
    problem = replace(PROBLEM, functions=functions, longest_step=0.01)
    integrate(problem, solver=solver, rtol=1e-2, output_times=[1.0])
    # Rounding of the times.
    assert np.diff([0.0, *ends]).max() <= 0.01 * (1.0 + 1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_rows_do_not_depend_on_each_other(solver):
    few = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=[1.0])
    many = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=np.linspace(0.0, 1.0, 101))
    np.testing.assert_array_equal(few.rows[-1], many.rows[-1])
    assert few.statistics.steps == many.statistics.steps


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"solver": "euler"}, r"solver\.name: unknown solver 'euler'; choose one of mebdf"),
        ({"rtol": 0.0}, r"solver\.rtol: rtol must lie between"),
        ({"rtol": float("nan")}, r"solver\.rtol: rtol must lie between"),
        ({"output_times": [2.0]}, "output times must lie between"),
    ],
)
def test_wrong_options_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        integrate(PROBLEM, **options)


def test_every_state_needs_a_tolerance():
    with pytest.raises(InputError, match="absolute tolerance"):
        integrate(replace(PROBLEM, atol=np.array([1e-6, 0.0])))


def test_importing_the_solvers_imports_neither_scipy_nor_numba():
    code = "import sys, tribodyn.integrate; sys.exit(bool({'scipy', 'numba', 'sksundae'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


SHORT = {
    "vsv": {"run.duration": "50 ms", "run.output_interval": "1 ms"},
    "journal-oil": {"run.duration": "0.5 ms"},
}
SLOW = {
    "joints.bearing.film.grid.theta": 360,
    "joints.bearing.film.grid.z": 64,
}  #: A film whose steps take many milliseconds.


def bits(result: xr.Dataset) -> dict[str, bytes]:
    return {str(name): result[name].values.tobytes() for name in result.variables}


@pytest.mark.parametrize("name", SHORT)
def test_pauses_after_every_evaluation_change_no_bit(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    case, looks, pauses = load_case(name).replace(SHORT[name]), [], []
    alone = simulate(case)

    @contextmanager
    def always(pause: NDArray[np.int64]) -> Iterator[None]:
        pauses[:] = [pause]
        yield

    def stop() -> bool:
        for pause in pauses:  # None before the integration begins
            pause[0] = AFTER_EVALUATION
        looks.append(None)
        return False

    monkeypatch.setattr(mebdf, "_ticking", always)
    assert bits(simulate(case, stop=stop)) == bits(alone)
    assert len(looks) > json.loads(alone.attrs["solver"])["rhs_evaluations"]


@pytest.mark.parametrize("solver", ["mebdf", "bdf"])
def test_a_stop_is_heard_soon_however_long_a_step_takes(solver: str) -> None:
    case = load_case("journal-oil").replace({**SLOW, "solver.name": solver})
    first_steps(case)
    looks: list[float] = []

    def stop() -> bool:
        # Processor time of this thread: on a busy machine others would be measured too.
        looks.append(time.thread_time())
        return looks[-1] - looks[0] > 1.0

    result = simulate(case, stop=stop)
    assert result.attrs["failure"] == "interrupted"
    # A step takes some tenths of a second; where other programs use the caches, a few times that.
    assert max(later - sooner for sooner, later in pairwise(looks)) < 2.0


def test_no_thread_is_left() -> None:
    before = threading.active_count()
    simulate(load_case("vsv").replace(SHORT["vsv"]))
    assert threading.active_count() == before
