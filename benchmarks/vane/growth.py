"""How the cost of the vane mechanism grows with grid, clearance and number of cycles.

python -m benchmarks.vane.growth

Seconds of the thread, medians of rounds in which the sizes take turns.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from benchmarks.vane.vsv_case import RTOL, one

GRIDS = ((48, 8), (64, 16), (96, 16), (192, 16), (192, 32), (384, 32))
CLEARANCES = (10, 15, 20, 30, 40)
CYCLES = (1.0, 2.0, 4.0, 8.0)
ROUNDS = 5


def sizes(unit: float) -> Iterator[tuple[str, str, float, float, dict[str, Any]]]:
    """Give what grows, its name, its number, the cycles to run, and the changed keys."""
    for theta, z in GRIDS:
        keys = {"solver.grid.theta": theta, "solver.grid.z": z}
        yield "grid", f"{theta} × {z}", theta * z, unit, keys
    for clearance in CLEARANCES:
        yield "clearance", f"{clearance} µm", clearance, unit, {"joint.clearance": f"{clearance} um"}
    for cycles in CYCLES:
        yield "cycles", f"{cycles:g}", cycles, unit * cycles, {}


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: once, and a hundredth of the time."""
    unit, rounds = (0.01, 1) if quick else (1.0, ROUNDS)
    one("mebdf", RTOL, cycles=0.01)
    rows: dict[tuple[str, str], dict[str, Any]] = {}
    for _ in range(rounds):
        for what, name, size, cycles, keys in sizes(unit):
            done = one("mebdf", RTOL, cycles=cycles, **keys)
            row = rows.setdefault((what, name), {"name": name, "size": size, "all": []})
            row |= {"steps": done["steps"], "rhs": done["rhs"]}
            row["all"].append(done["seconds"])
    found: dict[str, Any] = {"grid": [], "clearance": [], "cycles": []}
    for (what, name), row in rows.items():
        row["seconds"] = float(np.median(row.pop("all")))
        found[what].append(row)
        print(f"{what:10s} {name:>9s} {row['seconds']:8.3f} s {row['steps']:7d} steps {row['rhs']:7d} calls")
    return found


if __name__ == "__main__":
    run()
