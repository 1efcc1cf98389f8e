"""Contact pressure on the unrolled bushing, frame by frame."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.bushing import unrolled
from tribodyn.views.section import Payload, Section
from tribodyn.views.unrolled import best_cut, shares, unloaded_middle


def data(dataset: xr.Dataset) -> Payload | None:
    """Return the frames in 255 steps of their own peaks [MPa], on the bushing laid flat."""
    fields = np.nan_to_num(dataset["pressure_cycle"].values) * 1e-6
    if fields.shape[0] < 2 or not fields.max(initial=0.0) > 0.0:
        return None
    envelope = fields.max(axis=0)
    cut = best_cut(dataset["theta"].values, shares(fields))
    places = unrolled(dataset, cut, unloaded_middle(dataset, envelope))
    return places.payload(fields, "contact pressure", "MPa", lambda peaks: 1.6 * float(np.median(peaks)))


SECTION: Final = Section(
    name="pressure",
    title="Contact pressure on the unrolled bushing",
    caption=(
        "The bushing cut open and laid flat. The angle names points of the bushing as the marks on the wall "
        "of the clearance circle do."
    ),
    needs=("pressure_cycle", "frame_time", "theta", "z"),
    widget="field",
    data=data,
    still="pressure",
)
