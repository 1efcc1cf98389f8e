"""Tilt and offset of the trunnion, and the peak pressure that goes with them."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.views.chart import Chart
from tribodyn.views.curves import ChartCurve, Panel
from tribodyn.views.series import series


def panels(dataset: xr.Dataset) -> list[Panel]:
    """Return tilts [mrad], offsets [µm] and peak pressure [MPa]."""
    return [
        Panel("tilt [mrad]", _pair(dataset, "phi", 1e3)),
        Panel("offset [µm]", _pair(dataset, "e", 1e6)),
        Panel(
            "peak pressure [MPa]",
            [ChartCurve("peak pressure", series(dataset, "p_max", 1e-6))],
            smooth=True,
            unit="MPa",
        ),
    ]


def _pair(dataset: xr.Dataset, symbol: str, scale: float) -> list[ChartCurve]:
    return [
        ChartCurve("X: φx, ex", series(dataset, f"{symbol}_x", scale), "blue"),
        ChartCurve("Y: φy, ey", series(dataset, f"{symbol}_y", scale), "vermilion", "dash"),
    ]


TILT: Final = Chart(
    name="tilt",
    title="Tilt and offset of the trunnion, and peak pressure",
    caption=(
        "A tilted trunnion bears on the edges of the bushing. Where the two angles change, the loaded edge "
        "moves and the peak pressure follows."
    ),
    needs=("phi_x", "phi_y", "e_x", "e_y", "p_max"),
    panels=panels,
)
