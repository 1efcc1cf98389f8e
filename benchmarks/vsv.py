"""Two cycles of the vane mechanism: speed against simulated time and against other integrators.

python -m benchmarks.vsv

All integrators call the same compiled functions and keep the same books: energy ledgers, sliding loads, entry
velocities, reactions, output rows. Those of SciPy and scikit-sundae are stepped from Python. Each is run at
falling tolerances, and the fastest run that is accurate enough counts. Accuracy is asked against a run at
tolerances a hundred times tighter: outside 100 ms after a reversal the vane angle within 1e-5° and the
contact force within 0.5 %, between 50 and 100 ms the angle within 5e-5°.

Times are of the thread, without the compilation.
"""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribodyn.cases import load_case
from tribodyn.cases.vsv import Vsv
from tribodyn.integrate import integrate
from tribodyn.kernels.vsv.observe import OBSERVED
from tribodyn.mechanisms.vsv import vsv_problem
from tribodyn.simulation.ledger import ledger_columns, residual_fractions
from tribodyn.simulation.times import output_times
from tribodyn.simulation.vsv import mechanism

FloatArray = NDArray[np.float64]

SOLVERS = ("mebdf", "cvode", "bdf", "radau", "lsoda")
TOLERANCES = (1e-3, 1e-4, 1e-5)
PAIRS = 5
FAR, NEAR = 0.1, 0.05
"""Times after a reversal between which accuracy is asked for [s]."""


def one(
    solver: str, rtol: float, tighter: float = 1.0, cycles: float = 2.0, **changes: Any
) -> dict[str, Any]:
    """Run the default case; return observed columns, cost and time of the thread [s]."""
    case = load_case("vsv").replace({"run.cycles": cycles, **changes})
    assert isinstance(case, Vsv)
    vsv, atol = mechanism(case), case.solver.atol
    wanted = (atol.position, atol.tilt, atol.velocity, atol.tilt_rate)
    problem = vsv_problem(
        vsv,
        duration=case.duration,
        start=case.run.start,
        atol=(wanted[0] * tighter, wanted[1] * tighter, wanted[2] * tighter, wanted[3] * tighter),
    )
    times = output_times(case, vsv, case.duration)
    begin = time.thread_time()
    solution = integrate(problem, solver=solver, rtol=rtol, output_times=times)
    seconds = time.thread_time() - begin
    assert solution.complete, solution.failure
    columns = {name: solution.rows[:, k] for k, name in enumerate(OBSERVED)}
    cost = {"steps": solution.statistics.steps, "rhs": solution.statistics.rhs_evaluations}
    return {"t": solution.t, "columns": columns, "seconds": seconds, "duration": case.duration, **cost}


def errors(run: dict[str, Any], reference: dict[str, Any]) -> dict[str, float]:
    """Return the largest errors of vane angle [°] and contact force [1] in both ranges of time."""
    since = np.mod(run["t"] + 1e-9, math.pi)
    far, between = since > FAR, (since > NEAR) & (since <= FAR)
    mine, theirs = run["columns"], reference["columns"]
    angle = np.degrees(np.abs(mine["theta_v"] - theirs["theta_v"]))
    force, exact = np.hypot(mine["F_cx"], mine["F_cy"]), np.hypot(theirs["F_cx"], theirs["F_cy"])
    return {
        "angle": float(angle[far].max()),
        "force": float(np.abs(force / exact - 1.0)[far].max()),
        "angle 50-100 ms": float(angle[between].max()),
    }


def accurate(found: dict[str, float]) -> bool:
    """Tell whether a run is accurate enough."""
    return found["angle"] < 1e-5 and found["force"] < 5e-3 and found["angle 50-100 ms"] < 5e-5


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print ratios and return everything; ``quick``: over a moment, for nothing but a trial."""
    cycles = 0.05 if quick else 2.0
    one("mebdf", 1e-3, cycles=0.01)
    reference = one("mebdf", 1e-6, 1e-2, cycles)
    results: dict[str, Any] = {}
    fastest: dict[str, float] = {}
    print("solver   rtol    steps     rhs   seconds   angle [deg]    force  50-100 ms   ledgers")
    for solver in SOLVERS:
        for rtol in TOLERANCES:
            done = one(solver, rtol, cycles=cycles)
            found = errors(done, reference)
            ledgers = residual_fractions(ledger_columns(done["columns"]))
            kept = {name: done[name] for name in ("steps", "rhs", "seconds")}
            results[f"{solver} {rtol:g}"] = {**kept, **found, "ledgers": ledgers}
            print(
                f"{solver:6s} {rtol:7.0e} {done['steps']:7d} {done['rhs']:7d} {done['seconds']:9.3f}"
                f" {found['angle']:11.1e} {found['force']:10.1e} {found['angle 50-100 ms']:9.1e}"
                f"   {ledgers[0]:.0e} {ledgers[1]:.0e}"
            )
            if accurate(found) and solver not in fastest:
                fastest[solver] = rtol
                break
    results["ratios"] = ratios(fastest, cycles, pairs=1 if quick else PAIRS)
    return results


def ratios(fastest: dict[str, float], cycles: float, pairs: int) -> dict[str, float]:
    """Return the speed against simulated time and the ratios of times, medians of alternated pairs."""
    seconds: dict[str, list[float]] = {solver: [] for solver in fastest}
    duration = 0.0
    for _ in range(pairs):
        for solver, rtol in fastest.items():
            done = one(solver, rtol, cycles=cycles)
            duration = done["duration"]
            seconds[solver].append(done["seconds"])
    found = {"simulated / mebdf": float(np.median(duration / np.array(seconds["mebdf"])))}
    for solver in fastest:
        pairs = np.array(seconds[solver]) / np.array(seconds["mebdf"])
        found[f"{solver} / mebdf"] = float(np.median(pairs))
    for name, value in found.items():
        print(f"{name:20s} {value:7.1f}")
    return found


if __name__ == "__main__":
    run()
