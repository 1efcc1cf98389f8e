"""Two cycles of the vane mechanism: speed against simulated time and against other integrators and programs.

python -m benchmarks.vane.vsv

The integrators of ``tribodyn.integrate`` and CVODE called natively use the same compiled functions and keep
the same books: energy balances, sliding loads, entry velocities, reactions, output rows. Those of SciPy and
scikit-sundae are stepped from Python. Each is run at falling tolerances, and the loosest that is accurate
enough counts. Accuracy is asked against a run at tolerances a hundred times tighter: outside 100 ms after a
reversal the vane angle within 1e-5° and the contact force within 0.5 %, between 50 and 100 ms the angle
within 5e-5°. Other ways to the same motion: ``peers.py``.

Times are of the thread, without the compilation.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.vane.peers import paired, peers, setting
from benchmarks.vane.vsv_case import NATIVE, RTOL, accurate, errors, one, reference
from tribodyn.papers.cheng_2022.reduced.checks import CLEARANCE, WHOLE, balance_columns

SOLVERS = (NATIVE, "cvode", "bdf", "radau", "lsoda")
#: Relative tolerances, and what the absolute ones are multiplied by.
LADDER = ((1e-3, 1.0), (1e-4, 1.0), (1e-4, 0.1), (1e-5, 0.1), (1e-5, 0.01))
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
PAIRS = 5


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print ratios and return everything; ``quick``: over a moment, for nothing but a trial."""
    cycles, pairs = (0.02, 1) if quick else (2.0, PAIRS)
    for solver in ("mebdf", *SOLVERS):  # compile
        one(solver, RTOL, cycles=0.01)
    exact = reference(cycles)
    print(
        f"{'':24s} {'tolerances':24s} {'steps':>6s} {'rhs':>6s} {'seconds':>8s} {'angle':>8s} {'force':>8s}"
    )
    runs, tolerances = _ladder(cycles, exact)
    found = {
        "runs": runs,
        "tolerances": _tolerances(cycles, exact, pairs),
        "speed": _speed(cycles, pairs),
        "peers": [],
    }
    for peer in peers(tolerances, cycles):
        peer.run(min(peer.cycles, 0.02))
        measured = paired(peer, pairs, RTOL)
        exact_of_peer = reference(peer.cycles, **dict(peer.changes))
        measured |= errors(measured.pop("last"), exact_of_peer)
        found["peers"].append({"name": peer.name, "setting": peer.setting, "cycles": peer.cycles, **measured})
        print(f"{peer.name:24s} {peer.setting:24s} {measured['ratio']:8.1f} x the time of MEBDF")
    return found


def _row(
    solver: str, rtol: float, tighter: float, done: dict[str, Any], exact: dict[str, Any]
) -> dict[str, Any]:
    """Return and print cost and errors of a run."""
    found = errors(done, exact)
    columns = balance_columns(done["columns"])
    balances = WHOLE.fraction(columns), CLEARANCE.fraction(columns)
    kept = {name: done[name] for name in ("steps", "rhs", "seconds")}
    shown = " ".join(f"{found[name]:8.1e}" for name in ("angle", "force", "angle 50-100 ms"))
    cost = f"{done['steps']:6d} {done['rhs']:6d} {done['seconds']:8.3f}"
    print(f"{solver:24s} {setting(rtol, tighter):24s} {cost} {shown}", flush=True)
    good = accurate(found)
    return {
        "solver": solver,
        "rtol": rtol,
        "atol": tighter,
        **kept,
        **found,
        "balances": balances,
        "accurate": good,
    }


def _ladder(
    cycles: float, exact: dict[str, Any]
) -> tuple[list[dict[str, Any]], dict[str, tuple[float, float]]]:
    """Return runs at falling tolerances, and the first tolerances at which each integrator is accurate."""
    runs = [_row("mebdf", RTOL, 1.0, one("mebdf", RTOL, cycles=cycles), exact)]
    first: dict[str, tuple[float, float]] = {}
    for solver in SOLVERS:
        for rtol, tighter in LADDER:
            runs.append(_row(solver, rtol, tighter, one(solver, rtol, tighter, cycles), exact))
            if runs[-1]["accurate"]:
                first[solver] = rtol, tighter
                break
    return runs, first


def _speed(cycles: float, pairs: int) -> dict[str, float]:
    """Return the simulated time over that of MEBDF, median and range."""
    runs = [one("mebdf", RTOL, cycles=cycles) for _ in range(pairs)]
    speed = np.array([done["duration"] / done["seconds"] for done in runs])
    print(f"MEBDF is {np.median(speed):.0f} times as fast as the mechanism moves")
    return {"median": float(np.median(speed)), "least": float(speed.min()), "most": float(speed.max())}


def _tolerances(cycles: float, exact: dict[str, Any], pairs: int) -> list[dict[str, Any]]:
    """Return the cost of MEBDF at tolerances from 1e-2 to 1e-6: the relative one alone, and all of them."""
    seconds: dict[tuple[str, float], list[float]] = {}
    rows: dict[tuple[str, float], dict[str, Any]] = {}
    for number in range(pairs):
        for what in ("rtol", "all"):
            for rtol in TOLERANCES:
                tighter = rtol / RTOL if what == "all" else 1.0
                done = one("mebdf", rtol, tighter, cycles)
                seconds.setdefault((what, rtol), []).append(done["seconds"])
                if number == 0:
                    rows[what, rtol] = {"changed": what, **_row("mebdf", rtol, tighter, done, exact)}
    return [row | {"seconds": float(np.median(seconds[key]))} for key, row in rows.items()]


if __name__ == "__main__":
    run()
