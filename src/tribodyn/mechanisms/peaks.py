"""What kernels have kept of peaks, as results hold it: of the whole run, and of each reversal."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Table, names
from tribodyn.kernels.peaks import Peaks
from tribodyn.results.peaks import PARTS


def of_run(peaks: Peaks, table: Table) -> dict[str, float]:
    """Return the largest value of each quantity and its time [s], by name; NaN where nothing was noted."""
    n = len(table)
    largest, when = peaks.largest.reshape(-1, n), peaks.when.reshape(-1, n)
    best = np.argmax(np.where(np.isnan(largest), -np.inf, largest), axis=0)
    found = {}
    for k, name in enumerate(names(table)):
        found[f"{name}_peak"] = float(largest[best[k], k])
        found[f"{name}_peak_time"] = float(when[best[k], k])
    return found


def of_reversals(peaks: Peaks, table: Table) -> dict[str, FloatArray]:
    """Return peaks and their times [s] over the start and the reversals that were reached, by name."""
    reached = int(peaks.course.stretch) + 1
    found = {}
    for k, name in enumerate(names(table)):
        for place, part in enumerate(PARTS):
            found[f"{name}_{part}"] = peaks.largest[:reached, place, k]
            found[f"{name}_{part}_time"] = peaks.when[:reached, place, k]
    return found
