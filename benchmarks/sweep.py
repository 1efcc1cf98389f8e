"""How much faster a sweep is on two workers than on one.

    python -m benchmarks.sweep                   # 16 points of two drive cycles each, some minutes

Prints the wall time of ``tribodyn.studies.sweep`` as a whole, from the call to the merged dataset, pools of
processes and files included. The two take turns, and the shortest time of each counts.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from typing import Any

from tribodyn.cases import load_case
from tribodyn.studies import sweep

POINTS = 16
TARGET = 1.8
ROUNDS = 3
DURATION = "12.566 s"


def timed(workers: int, duration: str, points: int = POINTS) -> float:
    """Return the wall time [s] of a sweep over clearances that nothing is known of yet."""
    case = load_case("vsv").replace({"run.duration": duration})
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        found = sweep(
            case,
            {"joint.clearance": f"20:{20 + 1.5 * (points - 1)}:1.5 um"},
            workers=workers,
            directory=folder,
        )
        elapsed = time.perf_counter() - began
    assert found.sizes["joint.clearance"] == points
    assert found.attrs["points_failed"] == 0
    return elapsed


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: three points over a moment, without starting workers."""
    if quick:
        return {"points": 3, "seconds": {"0": [timed(0, "0.1 s", 3)]}}
    return measure(DURATION, ROUNDS)


def measure(duration: str, rounds: int) -> dict[str, Any]:
    """Return the wall times [s] and the ratio of the shortest, one worker over two."""
    times: dict[int, list[float]] = {1: [], 2: []}
    for number in range(rounds):
        for workers in (1, 2) if number % 2 == 0 else (2, 1):
            times[workers].append(timed(workers, duration))
            print(f"{workers} workers: {times[workers][-1]:.2f} s", flush=True)
    ratio = min(times[1]) / min(times[2])
    print(f"{POINTS} points on 2 workers are {ratio:.2f} times as fast as on 1 (asked: {TARGET})")
    return {"points": POINTS, "seconds": {str(n): found for n, found in times.items()}, "ratio": ratio}


def main(arguments: list[str] | None = None) -> int:
    """Print the times and their ratio; 0 when two workers are fast enough."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--duration", default=DURATION, help="simulated time of each point")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="how often each is timed")
    options = parser.parse_args(arguments)
    ratio: float = measure(options.duration, options.rounds)["ratio"]
    return 0 if ratio >= TARGET else 1


if __name__ == "__main__":
    sys.exit(main())
