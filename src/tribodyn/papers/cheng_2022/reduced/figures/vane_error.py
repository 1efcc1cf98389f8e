"""Vane-angle error: what the clearance does to the position of the vane."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.chart import mark_reversals
from tribodyn.figures.figure_family import Family
from tribodyn.papers.cheng_2022.reduced.sections.vane_error import DEG, ERROR, error
from tribodyn.views.events import direction, peak, reversal_times, series


def draw(dataset: xr.Dataset) -> Figure:
    """Draw actual minus ideal vane angle [deg], over time and over the vane angle."""
    figure = style.sheet(dataset, ERROR.title, 3.6)
    over_time, over_angle = figure.subplots(1, 2, sharey=True, width_ratios=(1.7, 1.0))
    ideal = series(dataset, "theta_v_ideal", DEG)
    off = error(dataset)
    style.lines(over_time, series(dataset, "time"), [(off, "error", style.INK, style.SOLID)])
    mark_reversals(over_time, reversal_times(dataset), label=True)
    _loop(over_angle, ideal, off, direction(dataset))
    for axes in (over_time, over_angle):
        axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    style.caption(over_time, f"largest {peak(off):.3g}°", side="right")
    style.finish(over_time, "time [s]", "actual − ideal vane angle [°]")
    style.finish(over_angle, "ideal vane angle [°]")
    return figure


def _loop(axes: Axes, ideal: FloatArray, off: FloatArray, sense: FloatArray) -> None:
    """Draw the error over the vane angle, the two directions apart: the gap between them is the backlash."""
    forward, reverse = np.where(sense > 0.0, off, np.nan), np.where(sense < 0.0, off, np.nan)
    style.lines(
        axes,
        ideal,
        [(forward, "forward", style.BLUE, style.SOLID), (reverse, "reverse", style.VERMILION, style.DASHED)],
    )
    style.legend(axes, 2)


FAMILY: Final = Family(
    name=ERROR.name,
    title=ERROR.title,
    caption=(
        "Actual minus ideal vane angle. Left: over time. Right: over the vane position, where the distance "
        "between the forward and the reverse branch is the backlash a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    draw=draw,
)
