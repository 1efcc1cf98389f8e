"""Depth and pressure over the cycles of a wear campaign."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.views.curves import ChartCurve, Panel
from tribodyn.views.depth import fitting_unit, no_feedback
from tribodyn.views.lines import over
from tribodyn.views.section import Payload, Section
from tribodyn.views.series import peak, series

PANELS: Final[tuple[tuple[str, float, Mapping[str, str]], ...]] = (
    (
        "peak pressure [MPa]",
        1e6,
        {
            "wear_pressure_max": "largest in the cycle, impacts included",
            "wear_pressure_mean": "mean over the cycle",
        },
    ),
    (
        "vane-angle error [°]",
        np.pi / 180.0,
        {"wear_angle_error_max": "largest in the cycle", "wear_angle_error_rms": "rms over the cycle"},
    ),
)
"""What is drawn below the depth where a result has it: label, size of its unit, and curves by their names."""


def data(dataset: xr.Dataset) -> Payload | None:
    """Return depth, and what else is known of the stops."""
    cycles = series(dataset, "wear_cycles")
    if cycles.size < 2:
        return None
    depth = series(dataset, "wear_depth_max")
    unit, size = fitting_unit(peak(depth))
    worn = [
        ChartCurve("if the first rate went on", no_feedback(dataset) / size, "grey", "dash"),
        ChartCurve("deepest point", depth / size, "blue"),
    ]
    drawn = [Panel(f"wear depth [{unit}]", worn)]
    for label, size, names in PANELS:
        there = [name for name in names if name in dataset]
        curves = [ChartCurve(names[name], series(dataset, name) / size) for name in there]
        drawn += [Panel(label, curves)] if curves else []
    return over(cycles, "drive cycles", drawn)


SECTION: Final = Section(
    name="wear-history",
    title="Wear over the cycles",
    caption=(
        "The deepest point of the bushing, its peak pressure and the error of the motion over the cycles of "
        "a wear campaign. As the loaded edge wears in, pressure spreads and wear slows down against the "
        "straight line."
    ),
    needs=("wear_cycles", "wear_depth_max", "wear_rate"),
    widget="lines",
    data=data,
    still="wear_history",
)
