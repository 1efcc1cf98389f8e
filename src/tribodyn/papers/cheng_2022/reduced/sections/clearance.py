"""The clearance where it follows temperatures."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.series import series


def panels(dataset: xr.Dataset) -> list[Panel]:
    """Return the radial clearance [µm]."""
    return [
        Panel("clearance [µm]", [ChartCurve("radial clearance", series(dataset, "radial_clearance", 1e6))])
    ]


WARMING: Final = Chart(
    name="clearance",
    title="Clearance over time",
    caption="Radial clearance at the temperatures of trunnion, bushing and casing.",
    needs=("radial_clearance",),
    panels=panels,
)
