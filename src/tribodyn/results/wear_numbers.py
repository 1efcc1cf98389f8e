"""Key results of wear: of a campaign, or the linear estimate of one run."""

from __future__ import annotations

import math
from types import EllipsisType
from typing import TYPE_CHECKING, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.results.reading import column, cycles, peak
from tribodyn.results.summary import KeyResult

if TYPE_CHECKING:
    import xarray as xr

Part: TypeAlias = Literal["both", "bore", "shaft"]  #: Partners whose depth counts.
Surfaces: TypeAlias = NDArray[np.intp] | EllipsisType  #: Numbers of surfaces, or all.
_ROUNDING: Final = 1.0e-9


def wear_rate(dataset: xr.Dataset, surfaces: Surfaces = ..., part: Part = "both") -> float:
    """Return the growth of the largest depth in the last cycle [m]; NaN before one cycle is complete.

    ``dataset``: a result of a system that wears; ``surfaces``: numbers of those that count; ``part``: which
    partners count.
    """
    held, depth = _worn_depths(dataset, surfaces, part)
    rate = float(depth[-1] - depth[-2]) / float(held[-1] - held[-2])
    return rate if rate > 0.0 else math.nan


def wear_life(dataset: xr.Dataset, surfaces: Surfaces = ..., part: Part = "both") -> float:
    """Return after how many drive cycles the depth limit is reached, at the last rate.

    ``dataset``, ``surfaces``, ``part``: as for :func:`wear_rate`.
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


def _wear_rate(dataset: xr.Dataset) -> float:
    """Return the greatest wear depth [nm] a thousand cycles would make; NaN before one cycle is complete."""
    if "wear_rate" in dataset:
        return float(column(dataset, "wear_rate")[-1]) * 1e9 * 1000.0
    held = cycles(dataset)
    whole = held >= 1.0 - 1e-9
    return peak(column(dataset, "wear_depth")) * 1e9 * 1000.0 / held if whole else math.nan


#: By name, in reading order; the wear depth of the whole stands before them.
WEAR_NUMBERS: Final[dict[str, KeyResult]] = {
    "partner_wear_depth_max_nm": KeyResult(
        "Wear depth of the partner",
        "nm",
        "Wear",
        "Its part of the wear depth, at the deepest: what is worn off the shaft, where both wear.",
        lambda d: peak(column(d, "partner_wear_depth")) * 1e9,
    ),
    "wear_depth_rate_nm_per_1000_cycles": KeyResult(
        "Wear rate",
        "nm per 1000 cycles",
        "Wear",
        "Deepest wear if this motion repeats and the pressure stays as it is.",
        _wear_rate,
    ),
    "worn_volume_mm3": KeyResult(
        "Worn volume",
        "mm³",
        "Wear",
        "What was worn off the bushing, in the campaign or by the same estimate.",
        lambda d: float(d.attrs["worn_volume"]) * 1e9,
    ),
    "wear_cycles": KeyResult(
        "Cycles of wear",
        "",
        "Wear",
        "Drive cycles that the wear campaign covered.",
        lambda d: float(d.attrs["wear_cycles_reached"]),
        count=True,
    ),
    "wear_life_cycles": KeyResult(
        "Life",
        "cycles",
        "Wear",
        "Drive cycles until some point is worn to the depth limit, both partners together, or an error has "
        "grown to its own; without a campaign a linear estimate.",
        lambda d: float(d.attrs["wear_life_cycles"]),
    ),
    "bore_life_cycles": KeyResult(
        "Life of the bore",
        "cycles",
        "Wear",
        "Drive cycles until a bore alone is worn to the depth limit, where both partners wear.",
        lambda d: wear_life(d, part="bore"),
    ),
    "shaft_life_cycles": KeyResult(
        "Life of the shaft",
        "cycles",
        "Wear",
        "Drive cycles until a shaft alone is worn to the depth limit, where both partners wear.",
        lambda d: wear_life(d, part="shaft"),
    ),
    "wear_life_factor": KeyResult(
        "Life, longest over shortest",
        "",
        "Wear",
        "Lives at both ends of the interval of wear, over each other.",
        lambda d: float(d.attrs["wear_life_factor"]),
        digits=1,
    ),
}
