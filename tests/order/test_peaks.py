"""Convergence of peaks and of whole mechanisms over the tolerance."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.unit.mechanism.drawings import bricard, run, spatial_slider_crank

import tribodyn as td
from tribodyn.integrate import integrate
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanisms.mechanism_protocol import FinishedRun
from tribodyn.papers.cheng_2022.reduced.descriptor import MECHANISM

#: Each peak, and what it is the peak of.
PEAKED = {
    "contact_force": lambda row: np.hypot(row["F_cx"], row["F_cy"]),
    "rigid_force": lambda row: np.hypot(row["F_kx"], row["F_ky"]),
    "damping_force": lambda row: np.hypot(row["F_cx"] - row["F_kx"], row["F_cy"] - row["F_ky"]),
    "drive_moment": lambda row: np.abs(row["M_d"]),
    "pressure": lambda row: row["p_max"],
}
AROUND, APART = 50e-6, 1e-6  #: How far around a peak rows are taken, and how far apart [s].


def rows_around(case, times):
    """Return rows of the run of a case, none but those around some times."""
    system = MECHANISM.system(case)
    problem = replace(system.problem(case.duration), following=None)
    grid = np.arange(-AROUND, AROUND, APART)
    wanted = np.unique(np.round(np.add.outer(times, grid), 9))
    rtol = case.solver.rtol
    solution = integrate(problem, solver="mebdf", rtol=rtol, output_times=wanted[wanted < case.duration])
    return system.gather(FinishedRun(problem, solution, vars(solution.statistics))).columns


@pytest.fixture(scope="module")
def runs():
    """Return case and result by clearance [um], up to the first reversal, at pi s, and its impacts."""
    changes = {"mechanism.formulation": "paper", "run.duration": "3.18 s"}
    cases = {
        clearance: td.load_case("vsv").replace({**changes, "joint.clearance": f"{clearance} um"})
        for clearance in (20, 25, 30, 35, 40)
    }
    return {clearance: (case, td.simulate(case)) for clearance, case in cases.items()}


@pytest.mark.parametrize("clearance", [20, 40])
def test_peaks_are_those_of_rows_a_microsecond_apart(runs, clearance):
    case, result = runs[clearance]
    row = rows_around(case, [float(result[f"{name}_impact_time"][-1]) for name in PEAKED])
    for name, read in PEAKED.items():
        # Measured: at most 0.1 %. The impacts last 25 us, over a dozen steps.
        assert float(result[f"{name}_impact"][-1]) == pytest.approx(read(row).max(), rel=0.01), name


@pytest.mark.parametrize("name", PEAKED)
def test_peaks_grow_with_the_clearance(runs, name):
    # The trunnion falls further and hits harder. Rows 0.2 ms apart had the rigid force fall to 41 N at 35 um.
    peaks = [float(result[f"{name}_impact"][-1]) for _, result in runs.values()]
    assert (np.diff(peaks) > 0.0).all()


RTOL = np.array([1e-4, 1e-5, 1e-6, 1e-7, 1e-8])


@pytest.mark.parametrize("make", [spatial_slider_crank, bricard], ids=["spatial", "Bricard"])
def test_error_is_in_proportion_to_the_tolerance(make: Callable[[], Model]) -> None:
    times = np.linspace(0.0, 2.0, 21)
    exact = run(make(), times, 1e-11)

    def error(rtol: float) -> float:
        result = run(make(), times, rtol)
        return float(
            np.sqrt(np.mean((result.body(2, "position", "x") - exact.body(2, "position", "x")) ** 2))
        )

    errors = np.array([error(rtol) for rtol in RTOL])
    slope = np.polyfit(np.log(RTOL), np.log(errors), 1)[0]
    # Measured: 1.00 and 1.14.
    assert 0.8 < slope < 1.3, errors
