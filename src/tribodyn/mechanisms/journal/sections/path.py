"""Where the centre of the journal goes inside the clearance circle."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.encode import packed
from tribodyn.views.playback import playback_times
from tribodyn.views.section import Payload, Section
from tribodyn.views.series import peak, series


def data(dataset: xr.Dataset) -> Payload | None:
    """Return path and positions at the frames [µm]."""
    times, time = playback_times(dataset), series(dataset, "time")
    if times.size < 2:
        return None
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    x, y = (series(dataset, name, 1e6) for name in ("e_x", "e_y"))
    return {
        "clearance": clearance,
        "reach": 1.25 * max(clearance, peak(x), peak(y), 1e-3),
        "joined": False,
        "looks": [{"colour": "blue", "dash": "solid", "symbol": "circle"}],
        "places": ["centre"],
        "paths": [{"x": packed(x), "y": packed(y)}],
        "at": [{"x": packed(np.interp(times, time, x)), "y": packed(np.interp(times, time, y))}],
    }


SECTION: Final = Section(
    name="path",
    title="The journal in its clearance",
    caption=(
        "The circle is the clearance, the mark is the centre of the journal now, the line its path. Beyond "
        "the circle the mean planes of the surfaces overlap."
    ),
    needs=("e_x", "e_y"),
    widget="orbit",
    data=data,
    still="path",
)
