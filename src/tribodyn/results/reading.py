"""Numbers read off a result: what key results are made of."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, Final, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.results.dataset import CARRIED, json_attribute

if TYPE_CHECKING:
    import xarray as xr

SHORT: Final = 0.01  #: Share of the time that impacts may last; a sustained maximum leaves it out.
_ROUNDING: Final = 1e-9
_Value = TypeVar("_Value")

_Read: TypeAlias = "dict[object, tuple[xr.Dataset, Any]]"
#: Values read off results, by keys that hold as long as the results are held, too.
_read: Final[ContextVar[_Read | None]] = ContextVar("_read", default=None)


@contextmanager
def reading_once() -> Iterator[None]:
    """Within the block :func:`of_part` reads a variable once for all parts; results must stay as they are."""
    token = _read.set({})
    try:
        yield
    finally:
        _read.reset(token)


def once(dataset: xr.Dataset, what: object, read: Callable[[], _Value]) -> _Value:
    """Return a value read off a result, from an earlier time within :func:`reading_once`."""
    known = _read.get()
    if known is None:
        return read()
    key = id(dataset), what
    if key not in known:
        known[key] = dataset, read()
    return cast(_Value, known[key][1])


def entries(dataset: xr.Dataset, name: str) -> NDArray[Any]:
    """Return the values of a variable, numbers or names."""
    # As dataset[name] it would be put together with its coordinates first, which takes longer than all else.
    variable = dataset.variables[name]
    if variable.dims != (name,):
        return np.asarray(variable.values)
    # Of a dimension they are kept in its index, which returns them four times as fast.
    return once(dataset, name, lambda: np.asarray(variable.to_index()))


def number_in(dataset: xr.Dataset, name: str, entry: str, spelled: Callable[[str], str] = str) -> int:
    """Return the number of the first entry of a dimension that is spelled so; an unknown one raises."""
    names = once(dataset, (name, spelled), lambda: [spelled(str(one)) for one in entries(dataset, name)])
    return names.index(entry)


def column(dataset: xr.Dataset, name: str) -> FloatArray:
    """Return a variable as an array."""
    return np.asarray(entries(dataset, name), dtype=np.float64)


def of_part(
    dataset: xr.Dataset, name: str, part: int, measure: Callable[[FloatArray], FloatArray] = np.asarray
) -> FloatArray:
    """Return a variable of one of its parts over time, shape (n_t,).

    Numbers of one time lie side by side, those of one part far apart: reading one of 80 parts takes about as
    long as reading all.

    ``dataset``, ``name``, ``part``: a variable of shape (n_t, n_parts, ...) and the number of a part;
    ``measure``: function of such a variable, or of one part of it, that leaves no other dimensions.
    """
    if _read.get() is None:
        return measure(column(dataset, name)[:, part])

    def of_all() -> FloatArray:
        return np.ascontiguousarray(measure(column(dataset, name)).T)

    return np.asarray(once(dataset, (name, measure), of_all)[part])


def norm(dataset: xr.Dataset, *names: str) -> FloatArray:
    """Return the length of a vector given by its components, over time."""
    return np.sqrt(sum(column(dataset, name) ** 2 for name in names))


def peak(values: FloatArray) -> float:
    """Return the largest finite size, NaN when there is none."""
    finite = np.abs(values[np.isfinite(values)])
    return float(finite.max()) if finite.size else math.nan


def largest(dataset: xr.Dataset, name: str, values: FloatArray) -> float:
    """Return the peak of a quantity, also where it fell between rows.

    ``dataset``: a result; of some quantities it holds the peaks after each reversal; ``name``: name of the
    quantity in those; ``values``: the quantity over time.
    """
    kept = [column(dataset, part) for part in (f"{name}_impact", f"{name}_outside") if part in dataset]
    return peak(np.concatenate([values, *kept]))


def outside(dataset: xr.Dataset, name: str) -> float:
    """Return the peak of a quantity outside the impacts."""
    return peak(column(dataset, f"{name}_outside"))


def reversals_held(dataset: xr.Dataset) -> int:
    """Return the number of reversals that the run holds with the impacts that follow them.

    Where a run continues from another one, its start is a reversal; otherwise it is none.
    """
    turns = column(dataset, "reversal_time")
    held = turns + float(dataset.attrs["impact_time"]) <= float(dataset.attrs["time_reached"])
    for name in dataset.data_vars:
        if str(name).endswith("_impact"):
            held &= np.isfinite(column(dataset, str(name))).reshape(turns.size, -1).any(axis=1)
    if dataset.attrs["start"] != CARRIED:
        held &= turns > 0.0
    return int(np.count_nonzero(held))


def time_mean(dataset: xr.Dataset, values: FloatArray) -> float:
    """Return the mean over time (trapezoidal: output times need not be uniform), of the finite part."""
    good = np.isfinite(values)
    time, values = column(dataset, "time")[good], values[good]
    span = float(time[-1] - time[0]) if time.size else 0.0
    area = 0.5 * float(np.sum((values[1:] + values[:-1]) * np.diff(time)))
    return area / span if span > 0.0 else math.nan


def rms(dataset: xr.Dataset, values: FloatArray) -> float:
    """Return the root mean square over time."""
    return math.sqrt(time_mean(dataset, values**2))


def cycles(dataset: xr.Dataset) -> float:
    """Return the number of drive cycles that the run holds."""
    time = column(dataset, "time")
    return float(time[-1] - time[0]) / float(dataset.attrs["cycle_period"]) if time.size else math.nan


def statistic(name: str) -> Callable[[xr.Dataset], float]:
    """Return a reader of one entry of the solver statistics."""
    return lambda dataset: float(json_attribute(dataset, "solver", {})[name])


def period(dataset: xr.Dataset) -> float:
    """Return the time of one cycle [s]; without end where nothing says it."""
    return float(dataset.attrs.get("cycle_period", math.inf))


def in_settled(dataset: xr.Dataset) -> NDArray[np.bool_]:
    """Return the rows to evaluate: of several cycles none of the first, in which the start dies away."""
    time, cycle = column(dataset, "time"), period(dataset)
    whole = time.size > 0 and time[-1] >= (2.0 - _ROUNDING) * cycle
    return np.asarray(time >= cycle) if whole else np.full(time.shape, True)


def settled(dataset: xr.Dataset, values: FloatArray) -> FloatArray:
    """Return values over time, those of the rows that are looked at."""
    return values[in_settled(dataset)]


def sustained(dataset: xr.Dataset, values: FloatArray) -> float:
    """Return the sustained maximum: the size that is exceeded for a hundredth of the time.

    ``values``: quantities over its time, shape (n_t,) or (n_t, n): that of the largest is returned.
    """
    time = settled(dataset, column(dataset, "time"))
    found = np.abs(settled(dataset, values).reshape(time.size, -1))
    if time.size == 1:
        return float(np.max(found))
    steps = np.diff(time)
    weights = 0.5 * (np.append(steps, 0.0) + np.insert(steps, 0, 0.0))
    order = np.argsort(found, axis=0)
    share = np.cumsum(weights[order], axis=0) / weights.sum()
    rising = np.take_along_axis(found, order, axis=0)
    return max(float(np.interp(1.0 - SHORT, *pair)) for pair in zip(share.T, rising.T, strict=True))
