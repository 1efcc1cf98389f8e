"""How the cost of the vane mechanism grows with grid, clearance, number of cycles and tolerance.

python -m benchmarks.growth
"""

from __future__ import annotations

import resource
from typing import Any

from benchmarks.vsv_case import one

GRIDS = ((48, 8), (96, 16), (192, 32))
CLEARANCES = ("10 um", "20 um", "30 um", "40 um")
CYCLES = (1.0, 2.0, 4.0, 8.0)
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)


def run(quick: bool = False) -> dict[str, Any]:
    """Measure one run of each, print and return seconds of the thread; ``quick``: a hundredth of the time."""
    unit = 0.01 if quick else 1.0
    one("mebdf", 1e-3, cycles=0.01)
    found: dict[str, Any] = {"grid": {}, "clearance": {}, "cycles": {}, "rtol": {}}
    for theta, z in GRIDS:
        changes = {"solver.grid.theta": theta, "solver.grid.z": z}
        found["grid"][f"{theta} x {z}"] = _seconds(one("mebdf", 1e-4, cycles=unit, **changes))
    for clearance in CLEARANCES:
        done = one("mebdf", 1e-4, cycles=unit, **{"joint.clearance": clearance})
        found["clearance"][clearance] = _seconds(done)
    for cycles in CYCLES:
        found["cycles"][f"{cycles:g}"] = {
            **_seconds(one("mebdf", 1e-4, cycles=unit * cycles)),
            "peak memory [MB]": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        }
    for rtol in TOLERANCES:
        found["rtol"][f"{rtol:g}"] = _seconds(one("mebdf", rtol, rtol / 1e-4, cycles=unit))
    for name, rows in found.items():
        for key, row in rows.items():
            print(f"{name:10s} {key:9s}", "  ".join(f"{what} {value:.3g}" for what, value in row.items()))
    return found


def _seconds(done: dict[str, Any]) -> dict[str, float]:
    """Return the cost of a run."""
    return {"seconds": done["seconds"], "steps": float(done["steps"]), "rhs": float(done["rhs"])}


if __name__ == "__main__":
    run()
