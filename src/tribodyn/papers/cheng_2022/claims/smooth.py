"""What is left of an error in smooth motion."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.runs import is_smooth

_TREND: Final = 0.2
"""Time over which the speed error is averaged [s]: several periods of what rings after the reversals."""
_STEP: Final = 5e-3
"""Time between the instants at which the trend is taken [s]."""


def trend(time: FloatArray, error: FloatArray, run: xr.Dataset) -> float:
    """Return the median size of the rate of an error, averaged over 0.2 s, in the smooth motion of a run.

    The mean of a rate over a time is the difference of what it is the rate of.
    """
    half = 0.5 * _TREND
    middle = np.arange(half, float(time[-1]) - half, _STEP)
    inside = is_smooth(run, middle - half) & is_smooth(run, middle + half)
    middle = middle[inside & (middle % (0.5 * float(run.attrs["cycle_period"])) > half)]
    change = np.interp(middle + half, time, error) - np.interp(middle - half, time, error)
    return float(np.median(np.abs(change)) / _TREND)
