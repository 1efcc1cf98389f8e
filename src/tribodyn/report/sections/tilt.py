"""Tilt of the trunnion and the peak pressure that goes with it."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.figures import FIGURES
from tribodyn.figures.style import series
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import Curve, Panel, over_time


def data(dataset: xr.Dataset) -> Payload | None:
    """Return tilts [mrad], offsets [µm] and peak pressure [MPa]."""
    tilts = (
        Curve("X: φx, ex", series(dataset, "phi_x", 1e3), "blue"),
        Curve("Y: φy, ey", series(dataset, "phi_y", 1e3), "vermilion", "dash"),
    )
    offsets = (
        Curve("X: φx, ex", series(dataset, "e_x", 1e6), "blue"),
        Curve("Y: φy, ey", series(dataset, "e_y", 1e6), "vermilion", "dash"),
    )
    peaks = (Curve("peak pressure", series(dataset, "p_max", 1e-6)),)
    return over_time(
        dataset,
        [
            Panel("tilt [mrad]", tilts),
            Panel("offset [µm]", offsets),
            Panel("peak pressure [MPa]", peaks, smooth=True, unit="MPa"),
        ],
    )


SECTION: Final = Section(
    name="tilt",
    title="Tilt and offset of the trunnion, and peak pressure",
    caption=FIGURES["tilt"].caption,
    needs=("phi_x", "phi_y", "e_x", "e_y", "p_max"),
    widget="lines",
    data=data,
    still="tilt",
)
