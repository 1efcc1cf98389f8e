"""Key results of wear: of a campaign, or the linear estimate of one run."""

from __future__ import annotations

import math
from typing import Final

import xarray as xr

from tribodyn.results.reading import column, cycles, peak
from tribodyn.results.summary import KeyResult
from tribodyn.results.wear_life import wear_life


def _wear_rate(dataset: xr.Dataset) -> float:
    """Return the greatest wear depth [nm] a thousand cycles would make; NaN before one cycle is complete."""
    if "wear_rate" in dataset:
        return float(column(dataset, "wear_rate")[-1]) * 1e9 * 1000.0
    held = cycles(dataset)
    whole = held >= 1.0 - 1e-9
    return peak(column(dataset, "wear_depth")) * 1e9 * 1000.0 / held if whole else math.nan


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
        "Lives at both ends of the range of wear rates, over each other: of the named material, or of the "
        "liners of one laboratory where nobody gave a rate or a material.",
        lambda d: float(d.attrs["wear_life_factor"]),
        digits=1,
    ),
}
"""By name, in reading order; the wear depth of the whole stands before them."""
