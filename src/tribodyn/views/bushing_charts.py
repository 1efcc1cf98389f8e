"""Charts over time of any shaft in a bushing: contact force with its parts, and tilt with peak pressure."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.series import series


def _forces(dataset: xr.Dataset) -> list[Panel]:
    """Return total, rigid and damping force and friction along X and Y [N]."""
    return [_force(dataset, axis) for axis in "xy"]


def _force(dataset: xr.Dataset, axis: str) -> Panel:
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
    panels=_forces,
)


def _tilts(dataset: xr.Dataset) -> list[Panel]:
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
    panels=_tilts,
)
