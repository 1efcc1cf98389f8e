"""Outputs of the copies of a pattern, compared with each other: spread, worst copy, hysteresis."""

import math
import re
from collections.abc import Callable, Iterator
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column, entries, settled
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import ERROR_UNITS

_COPY: Final = re.compile(r"(.+)\[\d+\]")


def copies_of(dataset: xr.Dataset) -> dict[str, list[int]]:
    """Return the numbers of the outputs that are copies of one another, by the name that they share."""
    found: dict[str, list[int]] = {}
    for number, name in enumerate(entries(dataset, "output").tolist()):
        if match := _COPY.fullmatch(str(name)):
            found.setdefault(match[1], []).append(number)
    return {name: numbers for name, numbers in found.items() if len(numbers) > 1}


def _groups(dataset: xr.Dataset, unit: str) -> Iterator[list[int]]:
    """Yield the outputs of a unit that are copies of one another."""
    units = entries(dataset, "output_unit").tolist()
    yield from (numbers for numbers in copies_of(dataset).values() if units[numbers[0]] == unit)


def apart(error: FloatArray) -> FloatArray:
    """Return the differences of errors (n_t, n) from their mean over copies."""
    return np.asarray(error - error.mean(axis=1, keepdims=True))


def _worst(error: FloatArray) -> float:
    """Return the number, from 1, of the copy that is furthest from the mean."""
    return float(1 + np.argmax(np.mean(apart(error) ** 2, axis=0)))


def _hysteresis(dataset: xr.Dataset, numbers: list[int], scale: float) -> float:
    """Return the largest difference of errors between both directions at an ideal value; NaN without."""
    widest = math.nan
    for k in numbers:
        ideal, error = (
            settled(dataset, column(dataset, name)[:, k]) for name in ("output_ideal", "output_error")
        )
        rising = np.gradient(ideal) > 0.0
        if not (np.any(rising) and np.any(~rising)):
            continue
        ways = [np.argsort(ideal[way], kind="stable") for way in (rising, ~rising)]
        places = [ideal[way][order] for way, order in zip((rising, ~rising), ways, strict=True)]
        low, high = max(place[0] for place in places), min(place[-1] for place in places)
        at = np.linspace(low, high, 200)[20:-20]
        up, down = (
            np.interp(at, place, error[way][order])
            for place, way, order in zip(places, (rising, ~rising), ways, strict=True)
        )
        widest = float(np.nanmax([widest, scale * np.max(np.abs(up - down))]))
    return widest


_NUMBERS: Final[dict[str, tuple[str, str, Callable[[FloatArray], float]]]] = {
    "spread_max": (
        "Spread of copies, peak",
        "Largest difference of two copies at any time.",
        lambda e: float(np.ptp(e, axis=1).max()),
    ),
    "sigma": (
        "Standard deviation of copies",
        "Over copies, and root mean square over time.",
        lambda e: float(np.sqrt(np.mean(np.var(e, axis=1)))),
    ),
}


def _number(unit: str, name: str, dataset: xr.Dataset) -> float:
    """Return the largest number of all outputs of a unit that are repeated."""
    scale, reduce = ERROR_UNITS[unit][2], _NUMBERS[name][2]
    found = [
        reduce(scale * settled(dataset, column(dataset, "output_error")[:, numbers]))
        for numbers in _groups(dataset, unit)
    ]
    return max(found, default=math.nan)


def _turned(unit: str, dataset: xr.Dataset) -> float:
    found = [_hysteresis(dataset, numbers, ERROR_UNITS[unit][2]) for numbers in _groups(dataset, unit)]
    return max(found, default=math.nan)


def _which(dataset: xr.Dataset) -> float:
    """Return the worst copy of the first output that is repeated."""
    numbers = next(iter(copies_of(dataset).values()), None)
    return (
        math.nan if numbers is None else _worst(settled(dataset, column(dataset, "output_error")[:, numbers]))
    )


def _of_unit(unit: str) -> Iterator[tuple[str, KeyResult]]:
    """Yield the numbers of outputs of a unit."""
    spelled, shown, _ = ERROR_UNITS[unit]
    for name, (label, meaning, _) in _NUMBERS.items():
        yield (
            f"copies_{name}_{spelled}",
            KeyResult(label, shown, "Outputs", meaning, partial(_number, unit, name)),
        )
    meaning = "Largest difference of the errors of one copy between both directions of the motion."
    yield (
        f"copies_hysteresis_{spelled}",
        KeyResult("Hysteresis of copies", shown, "Outputs", meaning, partial(_turned, unit)),
    )


COPIES: Final[dict[str, KeyResult]] = {
    **dict(entry for unit in ERROR_UNITS for entry in _of_unit(unit)),
    "copies_worst": KeyResult(
        "Worst copy",
        "",
        "Outputs",
        "Number of the copy whose output is furthest from the mean of all, over the run.",
        _which,
        count=True,
    ),
}
"""Key results of outputs that a pattern repeats."""
