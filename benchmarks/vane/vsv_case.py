"""The built-in vane mechanism as a problem that every integrator is given, and what counts as accurate."""

from __future__ import annotations

import math
import time
from types import SimpleNamespace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.problem import Problem, Solution
from tribodyn.integrate import integrate
from tribodyn.integrate.driver import IntegrationTask
from tribodyn.integrate.following import make_schedule
from tribodyn.kernels.vsv.data import Mechanism, VsvData
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.parameters import Vsv
from tribodyn.papers.cheng_2022.reduced.problem import vsv_problem
from tribodyn.papers.cheng_2022.reduced.system import vsv_of
from tribodyn.papers.cheng_2022.reduced.times import output_times

FloatArray = NDArray[np.float64]

#: CVODE without Python between its steps, beside the names of ``tribodyn.integrate.SOLVERS``.
NATIVE: Final = "cvode-native"
RTOL: Final = load_case("vsv").solver.rtol  #: Relative tolerance that users get.
FAR, NEAR = 0.1, 0.05  #: Times after a reversal between which accuracy is asked for [s].


def constants(data: VsvData) -> SimpleNamespace:
    """Return the constants as ordinary numbers: attributes of a record take as long as some arithmetic."""
    mechanism = dict(zip(Mechanism.names or (), data.mechanism.item(), strict=True))
    return SimpleNamespace(**mechanism, collar_radius=float(data.collar.radius), joint=data.joint)


def vsv_case(cycles: float, **changes: Any) -> tuple[VsvCase, Vsv]:
    """Return the default case over some cycles, with changed keys, and its mechanism."""
    case = load_case("vsv").replace({"run.cycles": cycles, **changes})
    assert isinstance(case, VsvCase)
    return case, vsv_of(case)


def problem_of(case: VsvCase, vsv: Vsv, tighter: float = 1.0) -> Problem:
    """Return the initial value problem, absolute tolerances multiplied by ``tighter``."""
    atol = case.solver.atol
    return vsv_problem(
        vsv,
        duration=case.duration,
        start=case.run.start,
        atol=(
            atol.position * tighter,
            atol.tilt * tighter,
            atol.velocity * tighter,
            atol.tilt_rate * tighter,
        ),
    )


def one(
    solver: str, rtol: float, tighter: float = 1.0, cycles: float = 2.0, **changes: Any
) -> dict[str, Any]:
    """Run the default case; return observed columns, cost and time of the thread [s]."""
    case, vsv = vsv_case(cycles, **changes)
    problem = problem_of(case, vsv, tighter)
    times = output_times(case, vsv, case.duration)
    begin = time.thread_time()
    solution = _integrated(problem, solver, rtol, times)
    seconds = time.thread_time() - begin
    assert solution.complete, solution.failure
    columns = {name: solution.rows[:, k] for k, name in enumerate(OBSERVED)}
    cost = {"steps": solution.statistics.steps, "rhs": solution.statistics.rhs_evaluations}
    return {"t": solution.t, "columns": columns, "seconds": seconds, "duration": case.duration, **cost}


def _integrated(problem: Problem, solver: str, rtol: float, times: FloatArray) -> Solution:
    if solver != NATIVE:
        return integrate(problem, solver=solver, rtol=rtol, output_times=times)
    from benchmarks.vane.cvode_vsv import NATIVE_CVODE

    schedule = make_schedule(problem.t_span, problem.breakpoints, times, ())
    return NATIVE_CVODE(IntegrationTask(problem, schedule, rtol))


def reference(cycles: float, **changes: Any) -> dict[str, Any]:
    """Return a run at a thousandth of the default relative tolerance and a hundredth of the absolute ones."""
    return one("mebdf", 1e-3 * RTOL, 1e-2, cycles, **changes)


def errors(run: dict[str, Any], exact: dict[str, Any]) -> dict[str, float]:
    """Return the largest errors of vane angle [°] and, if known, contact force [1] in both ranges of time."""
    t, mine, theirs = run["t"], run["columns"], exact["columns"]
    far, between = ranges(t)

    def true(name: str) -> FloatArray:
        return np.interp(t, exact["t"], theirs[name])

    angle = np.degrees(np.abs(mine["theta_v"] - true("theta_v")))
    found = {"angle": float(angle[far].max()), "angle 50-100 ms": float(angle[between].max(initial=0.0))}
    if "F_cx" in mine:
        force, wanted = np.hypot(mine["F_cx"], mine["F_cy"]), np.hypot(true("F_cx"), true("F_cy"))
        found["force"] = float(np.abs(force / wanted - 1.0)[far].max())
    return found


def ranges(t: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Tell which times are far from the reversal before, and which between near and far; all far if none."""
    since = np.mod(t + 1e-9, math.pi)
    far = since > FAR
    return far if far.any() else np.full(t.size, True), (since > NEAR) & ~far


def accurate(found: dict[str, float]) -> bool:
    """Tell whether a run is accurate enough."""
    return found["angle"] < 1e-5 and found["force"] < 5e-3 and found["angle 50-100 ms"] < 5e-5
