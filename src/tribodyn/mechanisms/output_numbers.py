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
from tribodyn.results.outputs import ERROR_UNITS
from tribodyn.results.reading import column, entries, peak, settled, sustained
from tribodyn.results.summary import KeyResult

_AT_REST: Final = 1.0e-9
"""Change of an ideal value in one step, over its range, that counts as zero."""
Reduction = Callable[[xr.Dataset, FloatArray], float]


def _rms(dataset: xr.Dataset, error: FloatArray) -> float:
    """Return the root of the mean over time of the square."""
    time, square = settled(dataset, column(dataset, "time")), settled(dataset, error) ** 2
    return (
        math.sqrt(float(np.trapezoid(square, time)) / float(time[-1] - time[0]))
        if time.size > 1
        else math.nan
    )


Reading = Callable[[xr.Dataset, int], float]


def _direction(sign: float) -> Reading:
    """Return the mean error while the ideal value rises (1) or falls (−1)."""

    def read(dataset: xr.Dataset, output: int) -> float:
        time = settled(dataset, column(dataset, "time"))
        error, ideal = (
            settled(dataset, column(dataset, name)[:, output]) for name in ("output_error", "output_ideal")
        )
        moving = sign * np.diff(ideal) > _AT_REST * np.ptp(ideal)
        steps = np.diff(time)[moving]
        middle = 0.5 * (error[1:] + error[:-1])[moving]
        return float(np.sum(steps * middle) / np.sum(steps)) if steps.size else math.nan

    return read


DIRECTIONS: Final[dict[str, tuple[str, str, Reading]]] = {
    "forward": ("mean, forward", "Mean error, with its sign, while the ideal value rises.", _direction(1.0)),
    "backward": (
        "mean, backward",
        "Mean error, with its sign, while the ideal value falls; the difference of both is lost motion.",
        _direction(-1.0),
    ),
}
"""Parts of names of key results: errors in one direction of motion."""
MEASURES: Final[dict[str, tuple[str, str, Reduction]]] = {
    "lasting": (
        "sustained",
        "Largest difference from the motion with ideal joints for 99 % of the time; impacts excluded.",
        sustained,
    ),
    "max": ("peak", "Largest value at any time, impacts included.", lambda d, error: peak(settled(d, error))),
    "rms": ("rms", "Root mean square over time of the difference from the motion with ideal joints.", _rms),
}
"""Parts of names of key results: statistics of an error over time."""


def number_of(dataset: xr.Dataset, output: str) -> int:
    """Return the number of an output, whose name may be that of a key result; an unknown one raises."""
    return [plain(str(name)) for name in entries(dataset, "output")].index(plain(output))


def _made(measure: str, unit: str, output: str) -> KeyResult:
    """Return the key result of an output; NaN where its error has another unit or is not known."""
    label, meaning, read = READINGS[measure]
    _, shown, scale = ERROR_UNITS[unit]

    def compute(dataset: xr.Dataset) -> float:
        k = number_of(dataset, output)
        error = column(dataset, "output_error")[:, k]
        if str(entries(dataset, "output_unit")[k]) != unit or not np.isfinite(error).all():
            return math.nan
        return scale * read(dataset, k)

    return KeyResult(f"Error, {label}", shown, "Outputs", meaning, compute).of_part(output)


def _of_error(reduce: Reduction) -> Reading:
    """Return the reading that reduces the error of an output."""
    return lambda dataset, output: reduce(dataset, column(dataset, "output_error")[:, output])


READINGS: Final = {
    **{name: (label, meaning, _of_error(reduce)) for name, (label, meaning, reduce) in MEASURES.items()},
    **DIRECTIONS,
}
"""All of them."""


def _of_limit(output: str) -> KeyResult:
    """Return the largest error of an output as a share of its limit [%]; NaN without a limit."""

    def compute(dataset: xr.Dataset) -> float:
        k = number_of(dataset, output)
        return (
            100.0
            * peak(column(dataset, "output_error")[:, k])
            / float(column(dataset, "output_error_limit")[k])
        )

    meaning = "Largest error in the run over the limit of the output; at 100 % it is worn out."
    return KeyResult("Error, of its limit", "%", "Outputs", meaning, compute).of_part(output)


def _life(output: str) -> KeyResult:
    """Return the life of an output by its error; NaN without a limit."""
    meaning = "Drive cycles until the error reaches its limit at the wear rate of this run, estimated."

    def compute(dataset: xr.Dataset) -> float:
        return float(column(dataset, "output_life")[number_of(dataset, output)])

    return KeyResult("Life by error", "cycles", "Outputs", meaning, compute).of_part(output)


BY_OUTPUT: Final[dict[str, ByPart]] = {
    f"error_{measure}_{spelled}": partial(_made, measure, unit)
    for unit, (spelled, _, _) in ERROR_UNITS.items()
    for measure in READINGS
} | {
    "error_of_limit_percent": _of_limit,
    "error_life_cycles": _life,
}
"""Key results of each output, by what stands before its name."""


_PASSES: Final = {
    "error_at": ("at the instant", "Mean error, with its sign, where the key `at` of the output reads it."),
    "error_at_forward": ("at the instant, forward", "The same while the drive runs forward."),
    "error_at_backward": ("at the instant, backward", "The same while the drive runs backward."),
}
"""Labels and meanings of errors at instants, by variable."""


def _at(variable: str, unit: str, instant: str) -> KeyResult:
    """Return the key result of an instant; NaN where its error has another unit or is not known."""
    label, meaning = _PASSES[variable]
    _, shown, scale = ERROR_UNITS[unit]

    def compute(dataset: xr.Dataset) -> float:
        k = entries(dataset, "instant").tolist().index(instant)
        output = number_of(dataset, str(entries(dataset, "instant_output")[k]))
        of_unit = str(entries(dataset, "output_unit")[output]) == unit
        return scale * float(column(dataset, variable)[k]) if of_unit else math.nan

    return KeyResult(f"Error {label}", shown, "Outputs", meaning, compute).of_part(instant)


BY_INSTANT: Final[dict[str, ByPart]] = {
    f"{variable}_{spelled}": partial(_at, variable, unit)
    for unit, (spelled, _, _) in ERROR_UNITS.items()
    for variable in _PASSES
}
"""Key results of each instant, by what stands before its name."""
