"""Wear map of the bushing."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.figures import FIGURES
from tribodyn.figures.unrolled import best_cut, unloaded_middle
from tribodyn.figures.wear import fitting_unit
from tribodyn.report.base import Payload, Section
from tribodyn.report.bushing import unrolled
from tribodyn.report.encode import packed, quantised


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
        "label": f"wear depth [{unit}]",
        "largest": float(peaks[0]),
        "usual": float(peaks[0]),
        "steps": packed(steps, "uint8"),
        "peaks": packed(peaks),
    }


SECTION: Final = Section(
    name="wear",
    title=FIGURES["wear_depth"].title,
    caption=FIGURES["wear_depth"].caption.split(" Above:")[0],
    needs=("wear_depth", "theta", "z"),
    widget="field",
    data=data,
    still="wear_depth",
)
