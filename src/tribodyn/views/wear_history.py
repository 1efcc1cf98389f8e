"""Depth and pressure over the cycles of a wear campaign."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.curves import Curve, Panel
from tribodyn.views.depth import fitting_unit, no_feedback
from tribodyn.views.lines import over
from tribodyn.views.section import Payload, Section
from tribodyn.views.series import peak, series


def data(dataset: xr.Dataset) -> Payload | None:
    """Return depth, peak pressure and vane-angle error at the stops."""
    cycles = series(dataset, "wear_cycles")
    if cycles.size < 2:
        return None
    depth = series(dataset, "wear_depth_max")
    unit, size = fitting_unit(peak(depth))
    worn = [
        Curve("if the first rate went on", no_feedback(dataset) / size, "grey", "dash"),
        Curve("deepest point", depth / size, "blue"),
    ]
    pressure = [Curve("mean over the cycle", series(dataset, "wear_pressure_mean", 1e-6), "blue")]
    error = [Curve("rms over the cycle", np.rad2deg(series(dataset, "wear_angle_error_rms")), "ink")]
    return over(
        cycles,
        "drive cycles",
        [
            Panel(f"wear depth [{unit}]", worn),
            Panel("peak contact pressure [MPa]", pressure),
            Panel("vane-angle error [°]", error),
        ],
    )


SECTION: Final = Section(
    name="wear-history",
    title="Wear over the cycles",
    caption=(
        "The deepest point of the bushing and its peak pressure over the cycles of a wear campaign. As the "
        "loaded edge wears in, pressure spreads and wear slows down against the straight line."
    ),
    needs=("wear_cycles", "wear_depth_max", "wear_rate", "wear_pressure_mean", "wear_angle_error_rms"),
    widget="lines",
    data=data,
    still="wear_history",
)
