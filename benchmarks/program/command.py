"""What a user waits for at the command line: help, a first run, a second one.

python -m benchmarks.program.command
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.child import measured

TIMES = 5


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: help alone."""
    helps = [measured(["-m", "tribodyn", "--help"]) for _ in range(1 if quick else TIMES)]
    found: dict[str, Any] = {"help": {key: _median(helps, key) for key in helps[0] if key != "output"}}
    if not quick:
        found |= _runs()
    for name, row in found.items():
        print(
            f"{name:12s} {row['seconds']:7.2f} s, of the processor {row['processor seconds']:7.2f} s,"
            f" {row['peak memory [MB]']:5.0f} MB"
        )
    return found


def _median(runs: list[dict[str, Any]], key: str) -> float:
    return float(np.median([run[key] for run in runs]))


def _runs() -> dict[str, dict[str, Any]]:
    """Return a first run, in an empty home, and the second one."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        environment = {"HOME": folder}
        for name in ("first run", "second run"):
            target = str(Path(folder) / name.replace(" ", "-"))
            found[name] = measured(["-m", "tribodyn", "run", "vsv", "-o", target], environment)
            found[name].pop("output")
    return found


if __name__ == "__main__":
    run()
