"""How the worn shape of the bushing grew over a wear campaign."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.bushing import unrolled
from tribodyn.views.depth import fitting_unit
from tribodyn.views.encode import packed, quantised
from tribodyn.views.numbers import in_words
from tribodyn.views.section import Payload, Section
from tribodyn.views.unrolled import best_cut, unloaded_middle


def data(dataset: xr.Dataset) -> Payload | None:
    """Return the worn profiles that were kept, each with its cycles, on the unrolled bushing."""
    depth = np.nan_to_num(dataset["stage_depth"].values)
    largest = float(depth.max(initial=0.0))
    if depth.shape[0] < 2 or not largest > 0.0:
        return None
    unit, size = fitting_unit(largest)
    envelope = depth.max(axis=0) / size
    cut = best_cut(dataset["theta"].values, envelope.max(axis=1))
    places = unrolled(dataset, cut, unloaded_middle(dataset, envelope))
    steps, peaks = quantised(places.reordered(depth / size))
    return {
        **places.axes(),
        "unit": unit,
        "stages": [f"after {in_words(int(cycles))} cycles" for cycles in dataset["stage_cycles"].values],
        "label": f"wear depth [{unit}]",
        "largest": float(peaks.max()),
        "usual": float(peaks.max()),
        "steps": packed(steps, "uint8"),
        "peaks": packed(peaks),
    }


SECTION: Final = Section(
    name="wear-stages",
    title="The worn shape, stage by stage",
    caption="Depth worn off the bushing after growing numbers of cycles, all in one scale of colours.",
    needs=("stage_depth", "stage_cycles", "theta", "z"),
    widget="field",
    data=data,
)
