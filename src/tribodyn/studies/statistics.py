"""Statistics of samples for the population from which they were drawn."""

import itertools
import json
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.studies.plan import POINT, SENSITIVITY

#: Functions of the finite values of a key result, by name; ``p5`` is the fifth percentile.
STATISTICS: Final[dict[str, Callable[[FloatArray], Any]]] = {
    "mean": np.mean,
    "deviation": lambda values: np.std(values, ddof=1) if values.size > 1 else np.nan,
    "p5": lambda values: np.percentile(values, 5.0),
    "median": np.median,
    "p95": lambda values: np.percentile(values, 95.0),
}

Statistics = dict[str, dict[str, float]]  #: Statistics by name of the key result.


def statistics(dataset: xr.Dataset) -> list[tuple[dict[str, Any], Statistics]]:
    """Return the statistics over the samples of a sweep, points that failed left out.

    Parameters
    ----------
    dataset
        From :func:`~tribodyn.studies.archive.merge`.

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


@dataclass(frozen=True)
class Share:
    """Share of points that keep a limit."""

    #: How many keep it, and how many gave the number.
    within: int
    points: int
    #: Between which shares that of the whole population lies, with 95 % confidence; NaN where nothing was
    #: sampled.
    low: float
    high: float


def shares(dataset: xr.Dataset, limits: Mapping[str, float]) -> dict[str, Share]:
    """Return by name of a key result how many points of a sweep do not exceed its limit.

    Parameters
    ----------
    dataset
        A sweep. Points that failed do not count.
    limits
        Greatest value allowed of each number.

    Returns
    -------
    dict
        With the score interval of a share (Wilson, J. Am. Stat. Assoc. 22 (1927) 209).

    Raises
    ------
    KeyError
        The sweep has no such number.
    """
    return {
        name: share_of(dataset[name].values, limit, POINT in dataset.dims) for name, limit in limits.items()
    }


def share_of(values: FloatArray, limit: float, sampled: bool) -> Share:
    """Return the share of values that do not exceed a limit, with an interval where they are samples."""
    from scipy.stats import binomtest

    known = values[np.isfinite(values)]
    within = int((known <= limit).sum())
    if not sampled or not known.size:
        return Share(within, known.size, np.nan, np.nan)
    interval = binomtest(within, known.size).proportion_ci(method="wilson")
    return Share(within, known.size, float(interval.low), float(interval.high))


@dataclass(frozen=True)
class Sensitivity:
    """Share of a parameter in the variance of a number."""

    first: float  #: Alone: first-order index of Sobol'.
    total: float  #: With all its interactions: total index.
    #: Half widths of their 95 % confidence intervals, by bootstrap.
    first_error: float
    total_error: float


def sensitivities(dataset: xr.Dataset, resamples: int = 499) -> dict[str, dict[str, Sensitivity]]:
    """Return Sobol' indices by key result and dotted path of the parameter.

    Parameters
    ----------
    dataset
        A sweep by the method ``saltelli``; of another one there are none. A number that a point lacks, or
        that does not vary, has none either.
    resamples
        Of the bootstrap.

    Returns
    -------
    dict
        Estimators of Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, by SciPy.

    Raises
    ------
    KeyError
        The dataset has no attribute ``varied``: it is no sweep.
    """
    if dataset.attrs.get("sampling_method") != SENSITIVITY:
        return {}
    names = [str(name) for name in dataset.data_vars if dataset[name].dtype.kind == "f"]
    given = {name: np.asarray(dataset[name].values) for name in names}
    paths = json.loads(dataset.attrs["varied"])
    return {
        name: dict(zip(paths, _indices(values, len(paths), resamples), strict=True))
        for name, values in given.items()
        if np.isfinite(values).all() and np.ptp(values) > 0.0
    }


def _indices(values: FloatArray, n_parameters: int, resamples: int) -> list[Sensitivity]:
    from scipy.stats import sobol_indices

    blocks = values.reshape(n_parameters + 2, 1, -1)
    n = blocks.shape[-1]
    found = sobol_indices(
        func={"f_A": blocks[0], "f_B": blocks[1], "f_AB": blocks[2:]}, n=n, rng=np.random.default_rng(0)
    )
    with warnings.catch_warnings():
        # Of an index that is the same in all resamples, as that of a parameter without any effect.
        warnings.simplefilter("ignore")
        spread = found.bootstrap(confidence_level=0.95, n_resamples=resamples)
    errors = [_half_width(part) for part in (spread.first_order, spread.total_order)]
    columns = (found.first_order.ravel(), found.total_order.ravel(), *errors)
    return [Sensitivity(*map(float, row)) for row in zip(*columns, strict=True)]


def _half_width(index: Any) -> FloatArray:
    """Return half the confidence interval of each index; 0 where resamples do not differ."""
    ends = index.confidence_interval
    return np.where(index.standard_error == 0.0, 0.0, 0.5 * (ends.high - ends.low)).ravel()
