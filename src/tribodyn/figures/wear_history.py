"""Depth and pressure over the cycles of a wear campaign."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.base import Family
from tribodyn.figures.style import BLUE, DASHED, GREY, INK, SOLID, caption, finish, legend, lines, note, sheet
from tribodyn.views.depth import fitting_unit, no_feedback
from tribodyn.views.series import series

TITLE: Final = "Wear over the cycles"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the greatest depth, and the peak pressure of the cycles that were simulated."""
    figure = sheet(dataset, TITLE, 4.6)
    above, below = figure.subplots(2, 1, sharex=True)
    cycles = series(dataset, "wear_cycles")
    if cycles.size:
        _depth(above, dataset, cycles)
        _pressure(below, dataset, cycles)
    else:
        for axes in (above, below):
            note(axes, "nothing computed")
    finish(above, "", above.get_ylabel())
    finish(below, "drive cycles", "pressure [MPa]")
    return figure


def _depth(axes: Axes, dataset: xr.Dataset, cycles: FloatArray) -> None:
    """Draw the depth, and beside it the straight line that it would be without feedback."""
    depth = series(dataset, "wear_depth_max")
    unit, size = fitting_unit(float(np.nanmax(depth, initial=0.0)))
    axes.plot(cycles, no_feedback(dataset) / size, color=GREY, linestyle=DASHED, linewidth=1.2)
    axes.plot(
        cycles, depth / size, color=BLUE, linestyle=SOLID, linewidth=1.5, marker=_marker(cycles), ms=2.5
    )
    axes.set_ylim(0.0, 1.6 * float(np.nanmax(depth, initial=0.0)) / size or 1.0)
    axes.set_ylabel(f"depth [{unit}]")
    deepest = f"deepest {depth[-1] / size:.3g} {unit} after {cycles[-1]:.0f} cycles"
    caption(axes, f"{deepest}; dashed: if the first rate went on")


def _pressure(axes: Axes, dataset: xr.Dataset, cycles: FloatArray) -> None:
    """Draw the peak pressure as the cycle's mean and as its maximum."""
    curves = [
        (series(dataset, "wear_pressure_max", 1e-6), "largest, impacts included", INK, DASHED),
        (series(dataset, "wear_pressure_mean", 1e-6), "mean over the cycle", BLUE, SOLID),
    ]
    lines(axes, cycles, curves)
    axes.set_yscale("log")
    caption(axes, "Peak pressure in the bushing")
    legend(axes, 2)


def _marker(cycles: FloatArray) -> str:
    """Mark the stops as long as they can be told apart."""
    return "o" if cycles.size <= 40 else ""


FAMILY: Final = Family(
    name="wear_history",
    title=TITLE,
    caption=(
        "The deepest point of the bushing and its peak pressure over the cycles of a wear campaign. As the "
        "loaded edge wears in, pressure spreads and wear slows down against the straight line."
    ),
    needs=("wear_cycles", "wear_depth_max", "wear_rate", "wear_pressure_max", "wear_pressure_mean"),
    draw=draw,
)
