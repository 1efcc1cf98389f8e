"""What runs take, against what ``tribodyn check`` estimates: peak memory and processor time.

python -m benchmarks costs             all cases, each in a process of its own, and the table of the manual
python -m benchmarks.program.costs vsv 2       one case over two cycles, as JSON
python -m benchmarks.program.costs ring-20 1   a ring of 20 vanes over one cycle, as JSON
python -m benchmarks.program.costs chain-40 1  a chain of 40 closed four-bars over one cycle, as JSON

A run simulates and saves; compilation, figures and report are left out. Processor time begins when libraries
and compiled equations are loaded, and peak memory is that of the whole process.
"""

from __future__ import annotations

import json
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Final

from benchmarks.child import measured
from benchmarks.mechanisms import chain, ring

#: Names and numbers of cycles; ``ring-N`` and ``chain-N`` are those of the modules of these names.
RUNS: Final = (
    ("slider-crank", 1.0),
    ("four-bar", 1.0),
    ("vsv", 2.0),
    ("vsv-free", 2.0),
    ("vsv-joints", 1.0),
    ("ring-5", 1.0),
    ("ring-10", 1.0),
    ("ring-20", 1.0),
    ("ring-40", 1.0),
    ("ring-80", 1.0),
    ("chain-10", 1.0),
    ("chain-20", 1.0),
    ("chain-40", 1.0),
)
_MADE: Final = {"ring": ring.case, "chain": chain.case}


def case(name: str, cycles: float) -> Any:
    """Return a built-in case, a ring or a chain over some cycles."""
    import tribodyn as td

    kind, _, number = name.partition("-")
    if kind in _MADE:
        return _MADE[kind](int(number), cycles)
    return td.load_case(name).replace({"run.cycles": cycles})


def one(name: str, cycles: float) -> dict[str, Any]:
    """Return what a run takes, what it is estimated to take, and what it computes."""
    import tribodyn as td
    from tribodyn.mechanisms.catalogue import MECHANISMS
    from tribodyn.mechanisms.results import write_run
    from tribodyn.simulation import estimate, first_steps

    given = case(name, cycles)
    first_steps(given)
    begin = time.process_time()
    dataset = td.simulate(given)
    with tempfile.TemporaryDirectory() as folder:
        write_run(dataset, Path(folder))
    seconds = time.process_time() - begin
    expected, work = estimate(given), MECHANISMS[given.kind()].workload(given)
    return {
        "cycles": cycles,
        "simulated": float(dataset["time"].values[-1]),
        "states": work.states,
        "joints": work.joints,
        "nodes": work.nodes,
        "steps": json.loads(dataset.attrs["solver"])["steps"],
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
        "seconds": seconds,
        "expected memory": expected.memory,
        "expected seconds": expected.seconds,
    }


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: one case over a moment."""
    runs = (("four-bar", 0.01),) if quick else RUNS
    found = {}
    for name, cycles in runs:
        output = measured(["-m", "benchmarks.program.costs", name, str(cycles)])["output"]
        found[name] = row = json.loads(output.splitlines()[-1])
        shown = ", ".join(f"{key} {value:.4g}" for key, value in row.items())
        print(f"{name}: {shown}", flush=True)
    return {"runs": found}


if __name__ == "__main__":
    print(json.dumps(one(sys.argv[1], float(sys.argv[2]))))
