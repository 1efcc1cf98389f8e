"""Wear depth of surfaces over drive cycles, and life to the depth limit."""

from __future__ import annotations

import math
from types import EllipsisType
from typing import Final, Literal, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column, cycles, peak

Part: TypeAlias = Literal["both", "bore", "shaft"]
"""Partners whose depth counts."""
Surfaces: TypeAlias = NDArray[np.intp] | EllipsisType
"""Numbers of surfaces, or all."""
_ROUNDING: Final = 1.0e-9


def wear_rate(dataset: xr.Dataset, surfaces: Surfaces = ..., part: Part = "both") -> float:
    """Return the growth of the largest depth in the last cycle [m]; NaN before one cycle is complete.

    Parameters
    ----------
    dataset
        A result of a system that wears.
    surfaces
        Numbers of those that count.
    part
        Which partners count.
    """
    held, depth = _worn_depths(dataset, surfaces, part)
    rate = float(depth[-1] - depth[-2]) / float(held[-1] - held[-2])
    return rate if rate > 0.0 else math.nan


def wear_life(dataset: xr.Dataset, surfaces: Surfaces = ..., part: Part = "both") -> float:
    """Return after how many drive cycles the depth limit is reached, at the last rate.

    Parameters
    ----------
    dataset, surfaces, part
        As for :func:`wear_rate`.
    """
    held, depth = _worn_depths(dataset, surfaces, part)
    left = float(dataset.attrs["wear_depth_limit"]) - float(depth[-1])
    return float(held[-1]) + left / wear_rate(dataset, surfaces, part)


def _worn_depths(dataset: xr.Dataset, surfaces: Surfaces, part: Part) -> tuple[FloatArray, FloatArray]:
    """Return drive cycles and the largest wear depths there [m], from the first cycle on."""
    share = _share(dataset, surfaces, part)
    if "stage_depth" in dataset:
        stages = np.nan_to_num(column(dataset, "stage_depth")[:, surfaces] * share)
        held = np.append(0.0, column(dataset, "stage_cycles"))
        return held, np.append(0.0, stages.reshape(len(stages), -1).max(axis=1))
    depth, whole = peak(column(dataset, "wear_depth")[surfaces] * share), cycles(dataset)
    return np.array([0.0, whole if whole >= 1.0 - _ROUNDING else math.nan]), np.array([0.0, depth])


def _share(dataset: xr.Dataset, surfaces: Surfaces, part: Part) -> FloatArray:
    """Return the part of the depth that is worn off these partners, over the surfaces."""
    if part == "both":
        return np.ones(1)
    whole, shaft = (column(dataset, name)[surfaces] for name in ("wear_depth", "partner_wear_depth"))
    worn = np.where(whole > 0.0, whole, np.nan)
    return np.asarray((shaft if part == "shaft" else whole - shaft) / worn)
