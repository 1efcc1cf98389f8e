"""Long runs without cycle jumping, as in ``benchmarks/long_run.py``."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.vsv_case import problem_of, vsv_case
from tribodyn import load_case, simulate
from tribodyn.integrate import integrate
from tribodyn.kernels.vsv.quantities import OBSERVED


@pytest.mark.long
def test_a_hundred_cycles_reach_their_end() -> None:
    # At the 167th reversal the step once fell below the spacing of times.
    sparse = {"run.cycles": 100, "run.output_interval": "100 ms", "run.impact_window": "0 s"}
    dataset = simulate(load_case("vsv").replace(sparse))
    assert not dataset.attrs["failure"]
    np.testing.assert_allclose(dataset.attrs["time_reached"], 200.0 * np.pi)


@pytest.mark.parametrize("cycles", [84, 9999])
def test_a_cycle_is_the_same_however_late_it_is(cycles: int) -> None:
    angles = []
    for begin in (0.0, 2.0 * np.pi * cycles):
        problem = problem_of(*vsv_case(1.0))
        segments = problem.data.actions.segments.copy()
        segments.begin += begin
        data = problem.data._replace(actions=problem.data.actions._replace(segments=segments))
        late = replace(problem, data=data, t_span=(begin, begin + 3.3), breakpoints=(begin + np.pi,))
        solution = integrate(late, output_times=[begin + 3.3])
        assert solution.complete, solution.failure
        angles.append(solution.rows[0, OBSERVED.index("theta_v")])
    # 0.16 s after the reversal, runs differ by what the tolerances allow, 1e-5° each.
    np.testing.assert_allclose(angles[1], angles[0], rtol=0.0, atol=np.radians(2e-5))
