"""Contact force, its parts, and friction."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.figures import FIGURES
from tribodyn.figures.style import series
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import Curve, Panel, over_time


def data(dataset: xr.Dataset) -> Payload | None:
    """Return total, rigid and damping force along X and Y [N]."""
    return over_time(dataset, [_panel(dataset, axis) for axis in "xy"])


def _panel(dataset: xr.Dataset, axis: str) -> Panel:
    curves = (
        Curve("total contact force", series(dataset, f"F_c{axis}"), "pale", width=4.5),
        Curve("rigid part", series(dataset, f"F_k{axis}"), "blue"),
        Curve("damping part", series(dataset, f"F_d{axis}"), "vermilion", "dash"),
        Curve("friction", series(dataset, f"F_f{axis}"), "green", "dot"),
    )
    return Panel(f"along {axis.upper()} [N]", curves, smooth=True, unit="N")


SECTION: Final = Section(
    name="contact-force",
    title="Forces of the bushing on the trunnion",
    caption=(
        "The contact force (normal pressure) with its rigid and damping parts, and friction beside it. After "
        "each reversal the trunnion crosses the clearance and lands on the other side: zoom in there."
    ),
    needs=("F_cx", "F_cy", "F_kx", "F_ky", "F_dx", "F_dy", "F_fx", "F_fy"),
    widget="lines",
    data=data,
    still=FIGURES["contact_force"].name,
)
