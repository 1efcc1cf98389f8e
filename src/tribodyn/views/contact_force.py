"""Contact force, its parts, and friction."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.views.chart import Chart
from tribodyn.views.curves import ChartCurve, Panel
from tribodyn.views.series import series


def panels(dataset: xr.Dataset) -> list[Panel]:
    """Return total, rigid and damping force and friction along X and Y [N]."""
    return [_panel(dataset, axis) for axis in "xy"]


def _panel(dataset: xr.Dataset, axis: str) -> Panel:
    curves = (
        ChartCurve("total contact force", series(dataset, f"F_c{axis}"), "pale", width=4.5),
        ChartCurve("rigid part", series(dataset, f"F_k{axis}"), "blue"),
        ChartCurve("damping part", series(dataset, f"F_d{axis}"), "vermilion", "dash"),
        ChartCurve("friction", series(dataset, f"F_f{axis}"), "green", "dot"),
    )
    return Panel(f"along {axis.upper()} [N]", curves, smooth=True, unit="N")


CONTACT_FORCE: Final = Chart(
    name="contact_force",
    title="Forces of the bushing on the trunnion",
    caption=(
        "The contact force (normal pressure) with its rigid and damping parts, and friction beside it. After "
        "each reversal the trunnion crosses the clearance and lands on the other side: zoom in there."
    ),
    needs=("F_cx", "F_cy", "F_kx", "F_ky", "F_dx", "F_dy", "F_fx", "F_fy"),
    panels=panels,
)
