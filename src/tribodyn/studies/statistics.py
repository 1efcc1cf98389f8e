"""What samples say about the population they were drawn from."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.studies.plan import POINT

STATISTICS: Final[dict[str, Callable[[FloatArray], Any]]] = {
    "mean": np.mean,
    "deviation": lambda values: np.std(values, ddof=1) if values.size > 1 else np.nan,
    "p5": lambda values: np.percentile(values, 5.0),
    "median": np.median,
    "p95": lambda values: np.percentile(values, 95.0),
}
"""Functions of the finite values of a headline number, by name; ``p5`` is the fifth percentile."""

Statistics = dict[str, dict[str, float]]
"""Statistics by name of the headline number."""


def statistics(dataset: xr.Dataset) -> list[tuple[dict[str, Any], Statistics]]:
    """Return the statistics over the samples of a sweep, points that failed left out.

    Parameters
    ----------
    dataset
        From :func:`~tribodyn.studies.merge.merge`.

    Returns
    -------
    list of tuple
        For each combination of the parameters that form a grid: their values, and the statistics. Empty
        where nothing was sampled.
    """
    return [(values, _all(part)) for values, part in _combinations(dataset)] if POINT in dataset.dims else []


def _combinations(dataset: xr.Dataset) -> Iterator[tuple[dict[str, Any], xr.Dataset]]:
    names = [str(name) for name in dataset.dims if name != POINT]
    for values in itertools.product(*(dataset[name].values.tolist() for name in names)):
        chosen = dict(zip(names, values, strict=True))
        yield chosen, dataset.sel(chosen)


def _all(part: xr.Dataset) -> Statistics:
    numbers = {str(name): part[name].values for name in part.data_vars if part[name].dtype.kind == "f"}
    found = {name: values[np.isfinite(values)] for name, values in numbers.items()}
    return {
        name: {statistic: float(compute(values)) for statistic, compute in STATISTICS.items()}
        for name, values in found.items()
        if values.size
    }
