"""Key results of the outputs of a mechanism: how far they are from the ideal motion."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.base import ByPart, plain
from tribodyn.mechanisms.general.readings import lasting
from tribodyn.results.outputs import ERROR_UNITS
from tribodyn.results.reading import column, peak, settled
from tribodyn.results.summary import Headline

Reduction = Callable[[xr.Dataset, FloatArray], float]


def _rms(dataset: xr.Dataset, error: FloatArray) -> float:
    """Return the root of the mean over time of the square."""
    time, square = settled(dataset, column(dataset, "time")), settled(dataset, error) ** 2
    return (
        math.sqrt(float(np.trapezoid(square, time)) / float(time[-1] - time[0]))
        if time.size > 1
        else math.nan
    )


MEASURES: Final[dict[str, tuple[str, str, Reduction]]] = {
    "lasting": (
        "sustained",
        "Largest difference from the motion with ideal joints for 99 % of the time; impacts excluded.",
        lasting,
    ),
    "max": ("peak", "Largest value at any time, impacts included.", lambda d, error: peak(settled(d, error))),
    "rms": ("rms", "Root mean square over time of the difference from the motion with ideal joints.", _rms),
}
"""By what stands in the name of the key result: how an error over time becomes one number."""


def number_of(dataset: xr.Dataset, output: str) -> int:
    """Return the number of an output, whose name may be that of a key result; an unknown one raises."""
    return [plain(str(name)) for name in dataset["output"].values].index(plain(output))


def _made(measure: str, unit: str, output: str) -> Headline:
    """Return the key result of an output; NaN where its error has another unit or is not known."""
    label, meaning, reduce = MEASURES[measure]
    _, shown, scale = ERROR_UNITS[unit]

    def compute(dataset: xr.Dataset) -> float:
        k = number_of(dataset, output)
        error = column(dataset, "output_error")[:, k]
        if str(dataset["output_unit"].values[k]) != unit or not np.isfinite(error).all():
            return math.nan
        return scale * reduce(dataset, error)

    return Headline(f"Error, {label}", shown, "Outputs", meaning, compute).of_part(output)


BY_OUTPUT: Final[dict[str, ByPart]] = {
    f"error_{measure}_{spelled}": partial(_made, measure, unit)
    for unit, (spelled, _, _) in ERROR_UNITS.items()
    for measure in MEASURES
}
"""Key results of each output, by what stands before its name."""
