"""Builds of a vane ring with rigid levers: against full draws, against rings as a whole, killed and resumed.

python -m benchmarks.mechanisms.builds                      4,000 vanes alone and 100 rings of 40; some hours
python -m benchmarks.mechanisms.builds 4000 30 FOLDER       so many vanes and rings; goes on in a folder
python -m benchmarks.mechanisms.builds rings 200 FOLDER     so many rings; errors of vanes from a table
python -m benchmarks.mechanisms.builds killed 1000          so many vanes on two workers, killed and resumed

One number scatters, the clearance of the trunnions. So errors are functions of it, which the vanes are a
table of: a build in full has 40 fresh clearances, and errors between those of the next two vanes of the
table. That is what builds are compared with that are drawn from polynomials of as many vanes. Rings as a
whole are made of the first of these vanes: what they have more is what independence leaves out.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.studies.builds import LEVELS, NUMBERS, BuildRuns, Copies, draw, numbers_of_builds
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.sweep import SILENT, Means

COUNT: Final = 40
SEED: Final = 0
FULL, DRAWS, AT_ONCE = 20_000, 1_000_000, 400
LEVEL: Final = LEVELS[-1]
RIGID: Final = TEMPLATES["vsv-ring"].text.replace('elastic = "beam"\n', "")
RINGS: Final = 200  #: Of whose vanes any number of rings has the first.
TABLE: Final = 400  #: Vanes of which errors of others are read.
KILLS: Final = 3
LONGEST: Final = 7200.0


def measure(
    copies: int, rings: int, directory: Path | None, count: int = COUNT, changes: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Return, and print, how builds that are drawn compare with full draws and with rings as a whole."""
    case = parse_case(RIGID, "ring").replace({"pattern.vanes.count": count, **(changes or {})})
    runs, means = BuildRuns(case, copies, rings, SEED, directory), Means(keep_results=False)
    errors = runs.alone(means, SILENT)
    found: dict[str, Any] = {"copies": copies, "rings": rings, "quantiles": _quantiles(runs, errors, count)}
    same = numbers_of_builds(errors[: rings * count].reshape(rings, count, -1))
    return found | _compared(runs.together(means, SILENT), same)


def coupled(
    rings: int,
    directory: Path | None,
    count: int = COUNT,
    changes: dict[str, Any] | None = None,
    table: int = TABLE,
) -> dict[str, Any]:
    """Return, and print, how rings as a whole compare with their vanes, whose errors a table of others gives.

    So 200 rings need no 8,000 vanes simulated alone. Every second vane of the table says what is missed.
    """
    case = parse_case(RIGID, "ring").replace({"pattern.vanes.count": count, **(changes or {})})
    means, inside = Means(keep_results=False), lambda name: directory and directory / name
    errors = BuildRuns(case, table, 0, SEED, inside("table")).alone(means, SILENT)
    plays, of_rings = (norm.ppf(SAMPLERS["lhs"](n, 1, SEED)[:, 0]) for n in (table, RINGS * count))
    order = np.argsort(plays)
    plays, errors = plays[order], errors[order]
    missed = np.std(errors[1:-1:2] - _read(plays[1:-1:2], plays[::2], errors[::2])) / np.std(errors)
    print(f"every second vane of {table} read from the others misses {missed:.2%} of their spread")
    together = BuildRuns(case, RINGS * count, rings, SEED, inside("rings")).together(means, SILENT)
    same = numbers_of_builds(_read(of_rings[: rings * count], plays, errors).reshape(rings, count, -1))
    return {"missed": float(missed)} | _compared(together, same)


def _read(at: NDArray[np.float64], plays: NDArray[np.float64], errors: NDArray[np.float64]) -> Any:
    """Return errors at inputs from a table of them, shape (n, n_instants)."""
    return np.stack([np.interp(at, plays, column) for column in errors.T], axis=1)


def _compared(together: NDArray[np.float64], same: NDArray[np.float64]) -> dict[str, Any]:
    """Return, and print, numbers of rings as a whole over those of the same vanes alone."""
    found, rings = {}, len(together)
    for k, name in enumerate(NUMBERS):
        ratio = together[:, k].mean() / same[:, k].mean()
        # Of the mean of the pairs' ratios, which is nearly that.
        error = np.std(together[:, k] / same[:, k], ddof=1) / np.sqrt(rings)
        found[name] = {"together / alone": float(ratio), "standard error": float(error)}
        told = f"{ratio - 1.0:+.2%} +- {error:.2%}"
        print(f"{name:12s} of {rings} rings as a whole {told} off the same vanes alone")
    return found


def _quantiles(runs: BuildRuns, errors: NDArray[np.float64], count: int) -> dict[str, Any]:
    """Return, and print, the last quantile of builds drawn, and the 95 % interval of that of full draws."""
    (inputs,), random = runs.inputs.T, np.random.default_rng([SEED, 1])
    order = np.argsort(inputs)
    drawn = draw(Copies(runs.laws, runs.inputs, errors), count, DRAWS, random)
    parts = []
    for _ in range(FULL // AT_ONCE):
        fresh = runs.laws[0](random, AT_ONCE * count)
        at = _read(fresh, inputs[order], errors[order])
        parts.append(numbers_of_builds(at.reshape(AT_ONCE, count, -1)))
    full = np.sort(np.concatenate(parts), axis=0)
    # Of order statistics.
    width = 1.96 * np.sqrt(LEVEL * (1.0 - LEVEL) * FULL)
    low, high = (full[round(LEVEL * FULL + side * width)] for side in (-1.0, 1.0))
    found = {}
    for k, name in enumerate(NUMBERS):
        value = float(np.quantile(drawn[:, k], LEVEL))
        found[name] = {"drawn": value, "low": float(low[k]), "high": float(high[k])}
        inside = "in" if low[k] <= value <= high[k] else "NOT in"
        print(f"{name:12s} {LEVEL:.1%} of builds drawn {value:.5g} {inside} {low[k]:.5g} to {high[k]:.5g}")
    return found


def killed(copies: int, folder: Path) -> dict[str, Any]:
    """Return what builds say that were left alone, and builds that were killed some times and resumed."""
    (folder / "ring.toml").write_text(RIGID, encoding="utf-8")
    lines, kills = folder / "killed" / "alone" / "points.jsonl", []
    for part in range(1, KILLS + 1):
        process = _started(copies, folder, "killed")
        began = time.monotonic()
        while process.poll() is None and _lines(lines) < part * copies // (KILLS + 1):
            assert time.monotonic() - began < LONGEST, "no progress"
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        kills.append(_lines(lines))
    resumed, _ = _started(copies, folder, "killed").communicate()
    undisturbed, _ = _started(copies, folder, "left").communicate()
    return {"killed at": kills, "resumed": json.loads(resumed), "undisturbed": json.loads(undisturbed)}


def _started(copies: int, folder: Path, name: str) -> subprocess.Popen[str]:
    """Start builds of a small ring over half a cycle on two workers, in a session of their own."""
    said = ["ring.toml", "--set", "pattern.vanes.count=6", "--set", "run.cycles=0.5", "--workers", "2"]
    said += ["--copies", str(copies), "--draws", "2000", "--no-figures", "--quiet", "--json", "-o", name]
    command = [sys.executable, "-m", "tribodyn", "builds", *said]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True, start_new_session=True)


def _lines(file: Path) -> int:
    return file.read_bytes().count(b"\n") if file.exists() else 0


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: few vanes and rings over a moment."""
    if quick:
        changes = {"run.cycles": 0.05}
        return measure(12, 3, None, 4, changes) | {"read": coupled(2, None, 2, changes, 8)}
    return measure(4000, 100, None)


def main(said: list[str]) -> None:
    """Measure what was asked for."""
    if said[:1] == ["killed"]:
        with tempfile.TemporaryDirectory() as folder:
            found = killed(int(said[1]), Path(folder))
        same = found["resumed"] == found["undisturbed"]
        told = f"{'equal' if same else 'NOT equal'} to those left alone"
        print(f"killed at {found['killed at']} of {said[1]} vanes and resumed: {told}")
    elif said[:1] == ["rings"]:
        coupled(int(said[1]), Path(said[2]))
    elif said:
        measure(int(said[0]), int(said[1]), Path(said[2]))
    else:
        run()


if __name__ == "__main__":
    main(sys.argv[1:])
