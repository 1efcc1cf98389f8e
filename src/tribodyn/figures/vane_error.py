"""Vane-angle error: what the clearance does to the position of the vane."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.base import Family
from tribodyn.figures.events import direction, mark_reversals, reversal_times
from tribodyn.figures.style import (
    BLUE,
    DASHED,
    GREY,
    INK,
    SOLID,
    VERMILION,
    caption,
    finish,
    legend,
    lines,
    peak,
    series,
    sheet,
)

TITLE: Final = "Vane-angle error caused by the clearance"
DEG: Final = 180.0 / np.pi


def draw(dataset: xr.Dataset) -> Figure:
    """Draw actual minus ideal vane angle [deg], over time and over the vane angle."""
    figure = sheet(dataset, TITLE, 3.6)
    over_time, over_angle = figure.subplots(1, 2, sharey=True, width_ratios=(1.7, 1.0))
    ideal = series(dataset, "theta_v_ideal", DEG)
    error = series(dataset, "theta_v", DEG) - ideal
    lines(over_time, series(dataset, "time"), [(error, "error", INK, SOLID)])
    mark_reversals(over_time, reversal_times(dataset), label=True)
    _loop(over_angle, ideal, error, direction(dataset))
    for axes in (over_time, over_angle):
        axes.axhline(0.0, color=GREY, linewidth=0.8, zorder=1)
    caption(over_time, f"largest {peak(error):.3g}°", side="right")
    finish(over_time, "time [s]", "actual − ideal vane angle [°]")
    finish(over_angle, "ideal vane angle [°]")
    return figure


def _loop(axes: Axes, ideal: FloatArray, error: FloatArray, sense: FloatArray) -> None:
    """Draw the error over the vane angle, the two directions apart: the gap between them is the backlash."""
    forward, reverse = np.where(sense > 0.0, error, np.nan), np.where(sense < 0.0, error, np.nan)
    lines(axes, ideal, [(forward, "forward", BLUE, SOLID), (reverse, "reverse", VERMILION, DASHED)])
    legend(axes, 2)


FAMILY: Final = Family(
    name="vane_error",
    title=TITLE,
    caption=(
        "Actual minus ideal vane angle. Left: over time. Right: over the vane position, where the distance "
        "between the forward and the reverse branch is the backlash a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    draw=draw,
)
