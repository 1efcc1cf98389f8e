"""Peaks from the kernels as results hold them: of the whole run, and of each reversal."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Table, names
from tribodyn.kernels.peaks import Peaks
from tribodyn.results.variables import PARTS

#: Impacts, and the ringing that follows them, are over after this share of the time between two reversals of
#: the drive, half its cycle; the rest is smooth motion.
IMPACT_SHARE: Final = 0.1


def impact_time(period: float) -> float:
    """Return the length of impacts after a reversal [s] for a drive cycle of ``period`` [s]."""
    return IMPACT_SHARE * 0.5 * period


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


def of_rows(
    times: FloatArray, values: Mapping[str, FloatArray], begins: FloatArray, window: float
) -> dict[str, FloatArray]:
    """Return the same peaks and times [s] from rows that follow the steps, by name.

    ``times``: of the rows [s], shape (n_t,); ``values``: quantities by name, shape (n_t, n) each; their sizes
    are looked at; ``begins``: the start and the reversals that were reached [s], shape (n_reversals,);
    ``window``: how long impacts last after each [s]. Returns of shape (n_reversals, n) each, NaN where there
    is no finite value.
    """
    shape = (begins.size, next(iter(values.values())).shape[1])
    found = {f"{name}_{part}": np.full(shape, np.nan) for name in values for part in PARTS}
    found |= {f"{name}_time": np.full(shape, np.nan) for name in found}
    for k, (begin, end) in enumerate(zip(begins, np.append(begins[1:], np.inf), strict=True)):
        inside = (times >= begin) & (times <= end)
        impact = times <= begin + window
        for part, rows in zip(PARTS, (inside & impact, inside & ~impact), strict=True):
            for name, column in values.items():
                sizes = np.abs(column[rows])
                known = np.flatnonzero(np.isfinite(sizes).any(axis=0))
                if not known.size:
                    continue
                row = np.nanargmax(sizes[:, known], axis=0)
                found[f"{name}_{part}"][k, known] = sizes[row, known]
                found[f"{name}_{part}_time"][k, known] = times[rows][row]
    return found
