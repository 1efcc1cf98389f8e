"""How the runs of random machines end, and what energy they miss.

    python -m benchmarks random_machines

The machines are those of ``tests/faults/mechanisms/test_random_physics.py``, by their seeds. ``MECHANISM``
says nothing of what lies under its asperities; ``RIGID`` are the first of these with nothing that yields,
``ELASTIC`` with elastic bodies, ``LOSSY`` with bodies as lossy as asperities. All are compared with the rigid
ones one by one.
"""

from __future__ import annotations

import importlib.util
import sys
import time
from collections import Counter
from pathlib import Path
from types import ModuleType
from typing import Any, Final

import numpy as np

import tribodyn.accessor  # noqa: F401

SOURCE: Final = Path(__file__).parents[2] / "tests" / "faults" / "mechanisms" / "test_random_physics.py"
#: How many machines of each kind are drawn.
COUNTS: Final = {"MECHANISM": 500, "RIGID": 120, "ELASTIC": 120, "LOSSY": 120, "UNDAMPED": 25, "DRY": 100}
#: Key results that elastic bodies may change.
COMPARED: Final = (
    "contact_force_mean_N",
    "contact_force_sustained_N",
    "contact_force_max_N",
    "error_rms_deg_vane",
)
WITHIN: Final = 0.01
_RESIDUALS: Final = ("energy_residual", "clearance_energy_residual")


def drawing() -> ModuleType:
    """Return the module that draws the machines."""
    spec = importlib.util.spec_from_file_location("random_physics", SOURCE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # its dataclasses look themselves up
    spec.loader.exec_module(module)
    return module


def run(quick: bool = False) -> dict[str, Any]:
    """Print and return how many runs of each kind ended how; ``quick``: of three machines each."""
    machines, runs = drawing(), {}
    found: dict[str, Any] = {}
    for kind, count in COUNTS.items():
        runs[kind] = [one(machines, getattr(machines, kind), seed) for seed in range(3 if quick else count)]
        found[kind] = of_kind(runs[kind])
        print(kind, found[kind], flush=True)
    kinds = ("MECHANISM", "ELASTIC", "LOSSY")
    found["bulk"] = {kind: compared(runs["RIGID"], runs[kind]) for kind in kinds}
    print("bulk", found["bulk"], flush=True)
    return found


def one(machines: ModuleType, kind: Any, seed: int) -> dict[str, Any]:
    """Return the end of one run, its residuals and its time, and how often advice had to be followed."""
    case = kind.case(seed)
    began = time.thread_time()
    result = machines.run(case)
    taken, failure = time.thread_time() - began, str(result.attrs["failure"])
    missed = {name: float(result.attrs[name]) for name in _RESIDUALS if name in result.attrs}
    warned, times = not failure and machines.TIGHTEN in result.attrs["warnings"], 0
    while not failure and machines.TIGHTEN in result.attrs["warnings"] and times < 2:
        times += 1
        result = machines.run(case.replace(machines.advised(case, result.attrs["warnings"], times)))
        failure = str(result.attrs["failure"])
    sound = not failure and max(machines.residuals(result)) <= machines.ENERGY_LIMIT
    known = result.tribodyn.numbers["value"] if sound else {}
    numbers = {name: float(known[name]) for name in COMPARED if name in known}
    ended = {"failure": failure, "warned": warned, "times": times, "sound": sound, "taken": taken}
    return {**ended, **missed, "numbers": numbers}


def compared(rigid: list[dict[str, Any]], elastic: list[dict[str, Any]]) -> dict[str, Any]:
    """Return how elastic bodies change how the first machines end, and their key results over rigid ones."""
    pairs = list(zip(rigid, elastic, strict=False))
    both = [(a, b) for a, b in pairs if a["sound"] and b["sound"]]
    changes = {name: [b["numbers"][name] / a["numbers"][name] - 1.0 for a, b in both] for name in COMPARED}
    return {
        "machines": len(pairs),
        "stopped with rigid bodies": sum(bool(a["failure"]) for a, _ in pairs),
        "stopped with elastic bodies": sum(bool(b["failure"]) for _, b in pairs),
        "sound with both": len(both),
        **{
            name: {"within 1 %": sum(abs(x) <= WITHIN for x in values), **quantiles(values)}
            for name, values in changes.items()
        },
    }


def of_kind(runs: list[dict[str, Any]]) -> dict[str, Any]:
    """Return counts and quantiles over the machines of one kind."""
    through = [run for run in runs if not run["failure"] or run["times"]]
    return {
        "machines": len(runs),
        "sound": sum(run["sound"] and not run["warned"] for run in runs),
        "warned": sum(run["warned"] for run in runs),
        "closed at once": sum(run["warned"] and run["sound"] and run["times"] == 1 for run in runs),
        "closed at the second time": sum(
            run["warned"] and run["sound"] and run["times"] == 2 for run in runs
        ),
        "not closed": sum(run["warned"] and not run["sound"] for run in runs),
        "stopped": sum(bool(run["failure"]) and not run["warned"] for run in runs),
        "reasons": Counter(
            run["failure"].partition(": ")[2] for run in runs if run["failure"] and not run["warned"]
        ),
        "seconds": quantiles([run["taken"] for run in runs]),
        **{
            name: quantiles([run[name] for run in through])
            for name in _RESIDUALS
            if any(name in run for run in through)
        },
    }


def quantiles(values: list[float]) -> dict[str, float]:
    """Return median, 95 %, 99 % and the largest of some values."""
    names = {"median": 0.5, "95 %": 0.95, "99 %": 0.99, "largest": 1.0}
    return {name: float(np.quantile(values, share)) for name, share in names.items()}


if __name__ == "__main__":
    run()
