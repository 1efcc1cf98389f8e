"""Outputs of the copies of a pattern, compared with each other: spread, worst copy, hysteresis."""

import math
import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.tables import keys_in
from tribodyn.cases.units import AXES
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.parts import OFF_DRAWING
from tribodyn.results.reading import column, entries, settled
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import ERROR_UNITS

if TYPE_CHECKING:
    import xarray as xr

_COPY: Final = re.compile(r"(.+)\[\d+\]")
_OF_COPY: Final = re.compile(r"([^[]+)\[(\d+)\](\.[^:[]+)")  #: Path of a key of a copy.
_SAME: Final = 1e-9  #: Relative difference of values that are the same.


def copies_of(dataset: "xr.Dataset") -> dict[str, list[int]]:
    """Return the numbers of the outputs that are copies of one another, by the name that they share."""
    return _numbered(entries(dataset, "output").tolist())


def _numbered(names: Iterable[object]) -> dict[str, list[int]]:
    """Return the places of copies among names, by the name that they share."""
    found: dict[str, list[int]] = {}
    for number, name in enumerate(names):
        if match := _COPY.fullmatch(str(name)):
            found.setdefault(match[1], []).append(number)
    return {name: numbers for name, numbers in found.items() if len(numbers) > 1}


def _groups(dataset: "xr.Dataset", unit: str) -> Iterator[list[int]]:
    """Yield the outputs of a unit that are copies of one another."""
    units = entries(dataset, "output_unit").tolist()
    yield from (numbers for numbers in copies_of(dataset).values() if units[numbers[0]] == unit)


def apart(error: FloatArray) -> FloatArray:
    """Return the differences of errors (n_t, n) from their mean over copies."""
    return np.asarray(error - error.mean(axis=1, keepdims=True))


def over_time(values: FloatArray, time: FloatArray) -> FloatArray:
    """Return the means of values (n_t, ...) over time; rows are not evenly spaced."""
    if time.size < 2:
        return np.asarray(values.mean(axis=0))
    return np.asarray(np.trapezoid(values, time, axis=0) / (time[-1] - time[0]))


def worst(error: FloatArray, time: FloatArray) -> int:
    """Return the place of the copy whose errors (n_t, n) are furthest from the mean of all over time."""
    return int(np.argmax(over_time(apart(error) ** 2, time)))


def worst_copies(dataset: "xr.Dataset") -> list[str]:
    """Return the ends of the names of the parts of the copies that are furthest from the mean: ``[7]``."""
    error, time = column(dataset, "output_error"), column(dataset, "time")
    return [
        f"[{1 + worst(error[:, numbers], time)}]" for numbers in copies_of(dataset).values() if error.size
    ]


def why(case: MechanismCase, time: FloatArray, errors: FloatArray) -> Iterator[str]:
    """Yield by which values a copy is the furthest from the mean, a sentence for each repeated output.

    The errors of copies are fitted by a linear function of the values in which they differ.

    ``case``: what was simulated; ``time``, ``errors``: times of its rows [s], and the errors of its outputs,
    shape (n_t, n_outputs).
    """
    if not time.size:
        return
    period = case.period or math.inf
    chosen = time >= (period if time[-1] >= 2.0 * period * (1.0 - 1e-9) else 0.0)
    errors, time = errors[chosen], time[chosen]
    values = _differing(case)
    for name, numbers in _numbered(case.outputs).items():
        error = apart(errors[:, numbers])
        own = {key: of for key, of in values.items() if of.size == len(numbers)}
        if not own or len(numbers) < len(own) + 2 or not np.isfinite(error).all() or not error.any():
            continue
        off = np.array([(of - of.mean()) / of.std() for of in own.values()]).T
        factors, *_ = np.linalg.lstsq(off, error.T, rcond=None)
        k = worst(error, time)
        parts = np.sum(factors * off[k][:, None] * error[:, k], axis=1) / np.sum(error[:, k] ** 2)
        causes = (
            f"{part:.0%} of that by {key}, {place:+.2g} standard deviations off"
            for key, place, part in zip(own, off[k], parts, strict=True)
        )
        yield (
            f"{name}[{k + 1}] is the copy furthest from the mean: {'; '.join(causes)}; "
            f"{1.0 - parts.sum():.0%} follow no line."
        )


def _differing(case: MechanismCase) -> dict[str, FloatArray]:
    """Return the values in which copies differ, by the key that they repeat, each of shape (n,)."""
    found: dict[str, list[float]] = {}
    for path in keys_in(case) if case.pattern else ():
        if match := _OF_COPY.fullmatch(path):
            value = case.at(path)
            if isinstance(value, float):
                found.setdefault(match[1] + match[3], []).append(value)
            elif match[3].removeprefix(".") in OFF_DRAWING:
                bodies = {body.partition("[")[0] for body in case.joints[path.split(".")[1]].between}
                own = next(one for one in case.pattern.values() if bodies & set(one.bodies))
                way = own.as_first(int(match[2]), value)  # type: ignore[arg-type]
                for axis, part in zip(AXES, way, strict=True):
                    rounded = abs(part) <= _SAME * math.hypot(*way)
                    found.setdefault(f"{match[1]}{match[3]}.{axis}", []).append(0.0 if rounded else part)
    return {key: np.array(of) for key, of in found.items() if np.ptp(of) > _SAME * np.max(np.abs(of))}


def _hysteresis(dataset: "xr.Dataset", numbers: list[int], scale: float) -> float:
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


_NUMBERS: Final[dict[str, tuple[str, str, Callable[[FloatArray, FloatArray], float]]]] = {
    "spread_max": (
        "Spread of copies, peak",
        "Largest difference of two copies at any time.",
        lambda error, _: float(np.ptp(error, axis=1).max()),
    ),
    "sigma": (
        "Standard deviation of copies",
        "Over copies, and root mean square over time.",
        lambda error, time: float(np.sqrt(over_time(np.var(error, axis=1), time))),
    ),
}


def _number(unit: str, name: str, dataset: "xr.Dataset") -> float:
    """Return the largest number of all outputs of a unit that are repeated."""
    scale, reduce = ERROR_UNITS[unit][2], _NUMBERS[name][2]
    time = settled(dataset, column(dataset, "time"))
    found = [
        reduce(scale * settled(dataset, column(dataset, "output_error")[:, numbers]), time)
        for numbers in _groups(dataset, unit)
    ]
    return max(found, default=math.nan)


def _turned(unit: str, dataset: "xr.Dataset") -> float:
    found = [_hysteresis(dataset, numbers, ERROR_UNITS[unit][2]) for numbers in _groups(dataset, unit)]
    return max(found, default=math.nan)


def _which(dataset: "xr.Dataset") -> float:
    """Return the worst copy of the first output that is repeated; NaN where a copy has no error."""
    numbers = next(iter(copies_of(dataset).values()), [])
    error, time = column(dataset, "output_error")[:, numbers], column(dataset, "time")
    if not (error.size and np.isfinite(error).all()):
        return math.nan
    return 1.0 + worst(settled(dataset, error), settled(dataset, time))


def _beyond(dataset: "xr.Dataset") -> float:
    """Return the share of all copies that pass the limit of their error; NaN without limits."""
    limits, error = entries(dataset, "output_error_limit"), column(dataset, "output_error")
    numbers = [k for of in copies_of(dataset).values() for k in of if np.isfinite(limits[k])]
    largest = np.abs(settled(dataset, error[:, numbers])).max(axis=0, initial=0.0)
    known = bool(numbers) and bool(np.isfinite(largest).all())
    return 100.0 * float(np.mean(largest > limits[numbers])) if known else math.nan


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


#: Key results of outputs that a pattern repeats.
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
    "copies_beyond_percent": KeyResult(
        "Copies beyond their limit",
        "%",
        "Outputs",
        "Share of the copies whose error passes the limit of the output at any time.",
        _beyond,
    ),
}
