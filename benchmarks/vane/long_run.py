"""Four hundred drive cycles without cycle jumping: time, and whether memory grows with them.

    python -m benchmarks.vane.long_run
    python -m benchmarks.vane.long_run 10             # one run in this process: prints what it took

Each run is a process of its own, whose peak memory the system tells. Rows are kept every 0.1 s and no closer
after reversals; they are what may grow, and their size is told beside the peak.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

from benchmarks.child import measured
from tribodyn.mechanisms.catalogue import load_case

FEW, MANY = 10, 400
OUTPUT = {"run.output_interval": "100 ms", "run.impact_window": "0 s"}


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: one cycle."""
    found = {}
    for cycles in (1,) if quick else (FEW, MANY):
        done = measured(["-m", "benchmarks.vane.long_run", str(cycles)])
        row = json.loads(done["output"].splitlines()[-1])
        row["peak memory [MB]"] = done["peak memory [MB]"]
        found[str(cycles)] = row
        print(
            f"{cycles:4d} cycles {row['seconds']:7.2f} s, peak memory {row['peak memory [MB]']:6.1f} MB,"
            f" result {row['result [MB]']:5.1f} MB"
        )
    return found


def here(cycles: int) -> dict[str, float]:
    """Simulate in this process."""
    from tribodyn import simulate

    simulate(load_case("vsv").replace({**OUTPUT, "run.duration": "0.2 s"}))  # compile
    case = load_case("vsv").replace({**OUTPUT, "run.cycles": cycles})
    begin = time.thread_time()
    dataset = simulate(case)
    seconds = time.thread_time() - begin
    assert not dataset.attrs["failure"], dataset.attrs["failure"]
    return {
        "seconds": seconds,
        "result [MB]": dataset.nbytes / 2**20,
        "steps": float(json.loads(dataset.attrs["solver"])["steps"]),
    }


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(here(int(sys.argv[1]))))
    else:
        run()
