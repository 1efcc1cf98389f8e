"""Remaining error in smooth motion."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Finding
from tribodyn.papers.cheng_2022.runs import is_smooth, mean_rate

_GAP: Final = 0.1
"""Longer times between samples are impacts left out [s]."""


def weights(time: FloatArray) -> FloatArray:
    """Return the time that each sample stands for [s]; none passes between stretches of smooth motion."""
    step = np.diff(time)
    step[step > _GAP] = 0.0
    return np.asarray(0.5 * (np.append(step, 0.0) + np.insert(step, 0, 0.0)))


def trend(time: FloatArray, error: FloatArray, run: xr.Dataset) -> float:
    """Return the median size of the rate of an error, averaged over 0.2 s, in the smooth motion of a run."""
    _, rate = mean_rate(time, error, run)
    return float(np.median(np.abs(rate)))


def of_instants(time: FloatArray, error: FloatArray, run: xr.Dataset) -> Finding:
    """Return the sizes of the rate of an error at all instants of smooth motion, which have any value.

    The paper gives one number and no instant. The least size is the 1 % quantile, since the rate passes zero.
    """
    rate = np.abs(np.gradient(error, time))[is_smooth(run, time)]
    low, high = (float(value) for value in np.quantile(rate, (0.01, 1.0)))
    middle = trend(time, error, run)
    text = f"{low:.1g} to {high:.2g} °/s over the instants; median over 0.2 s {middle:.2g} °/s"
    return Finding(text, middle, (low, high))
