"""Wear map of the bushing."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.bushing import unrolled
from tribodyn.views.depth import fitting_unit
from tribodyn.views.encode import packed, quantised
from tribodyn.views.section import Payload, Section
from tribodyn.views.unrolled import best_cut, unloaded_middle


def data(dataset: xr.Dataset) -> Payload | None:
    """Return the depth on the unrolled bushing as one picture, in a unit that fits."""
    depth = np.nan_to_num(dataset["wear_depth"].values)
    largest = float(depth.max(initial=0.0))
    if not largest > 0.0:
        return None
    unit, size = fitting_unit(largest)
    depth = depth / size
    cut = best_cut(dataset["theta"].values, depth.max(axis=1))
    places = unrolled(dataset, cut, unloaded_middle(dataset, depth))
    steps, peaks = quantised(places.reordered(depth[None]))
    return {
        **places.axes(),
        "unit": unit,
        "stages": [],
        "label": f"wear depth [{unit}]",
        "largest": float(peaks[0]),
        "usual": float(peaks[0]),
        "steps": packed(steps, "uint8"),
        "peaks": packed(peaks),
    }


SECTION: Final = Section(
    name="wear",
    title="Wear depth of the bushing",
    caption=(
        "Depth worn off the bushing: after the cycles of the wear campaign, or else a linear estimate for "
        "this run, in which the worn shape does not change the pressure."
    ),
    needs=("wear_depth", "theta", "z"),
    widget="field",
    data=data,
    still="wear_depth",
)
