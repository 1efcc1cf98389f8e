"""A chart over time as a figure, its reversals marked and kept from flattening what lies between."""

from collections.abc import Sequence
from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.figures.style import GREY, SMALL
from tribodyn.views.charts import Chart, ChartCurve, ChartMarks, Panel
from tribodyn.views.events import impact_time, reversal_times, series
from tribodyn.views.playback import time_unit
from tribodyn.views.section import angle_of

COLOURS: Final = {
    "ink": style.INK,
    "blue": style.BLUE,
    "vermilion": style.VERMILION,
    "green": style.GREEN,
    "orange": style.ORANGE,
    "purple": style.PURPLE,
    "grey": style.GREY,
    "pale": "#b4b4b4",
}
DASHES: Final[dict[str, style.LineStyle]] = {
    "solid": style.SOLID,
    "dash": style.DASHED,
    "dot": style.DOTTED,
    "dashdot": style.DASHDOT,
    "longdash": (0, (9, 2)),
}
_PANEL: Final = 1.55
"""Height of a panel [in]."""


def family(chart: Chart) -> Family:
    """Return the figure of a chart."""
    return Family(
        name=chart.name,
        title=chart.title,
        caption=chart.caption,
        needs=chart.needs,
        draw=partial(draw, chart),
        shows=lambda dataset: bool(chart.drawn(dataset)),
        over=partial(draw, chart),
    )


def draw(chart: Chart, dataset: xr.Dataset, over: str = "") -> Figure:
    """Draw the panels of a chart above each other over the simulated time, or over the angle of a joint."""
    panels = chart.drawn(dataset)
    figure = style.sheet(dataset, chart.title, 1.1 + _PANEL * max(len(panels), 2))
    if not panels:
        style.note(figure.subplots(), "nothing varies over time")
        return figure
    unit, scale = time_unit(dataset)
    time, turns = series(dataset, "time", scale), scale * reversal_times(dataset)
    label, place = angle_of(dataset, over) if over else (f"time [{unit}]", time)
    every = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(every, panels, strict=True):
        _draw_panel(axes, panel, place)
        cut_off(axes, *panel.ordinate(time / scale, turns / scale, impact_time(dataset)))
        if over:
            continue
        if panel.marks is not None:
            _draw_marks(axes, panel.marks, scale)
        mark_reversals(axes, turns, label=axes is every[-1] and not panel.smooth)
    every[-1].set_xlabel(label, size=style.TEXT)
    figure.align_ylabels()
    return figure


def _draw_panel(axes: Axes, panel: Panel, time: FloatArray) -> None:
    for curve in panel.curves:
        style.lines(axes, time, [_looks(curve)], width=0.75 * curve.width)
    if panel.level is not None:
        axes.axhline(panel.level, color=style.GREY, linewidth=0.8, dashes=(2, 2), zorder=1)
    if len(panel.curves) > 1:
        style.legend_beside(axes)
    style.finish(axes, y_label=panel.label)


def _draw_marks(axes: Axes, marks: ChartMarks, scale: float) -> None:
    middle = float(np.mean(axes.get_ylim()))
    axes.plot(scale * marks.times, marks.values, "o", ms=4.5, mfc="white", mec=style.BLUE, mew=1.2, zorder=4)
    for time, value, label in zip(scale * marks.times, marks.values, marks.labels, strict=False):
        offset = (0, 6) if value < middle else (0, -12)
        axes.annotate(
            label, (time, value), xytext=offset, textcoords="offset points", ha="center", size=style.SMALL
        )


def _looks(curve: ChartCurve) -> tuple[FloatArray, str, str, style.LineStyle]:
    return curve.values, curve.name, COLOURS[curve.colour], DASHES[curve.dash]


def mark_reversals(axes: Axes, times: FloatArray, label: bool = False) -> None:
    """Draw a fine line at each reversal, and name the first one above the axes if asked."""
    for time in times:
        axes.axvline(time, color=GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=1)
    if label and times.size:
        axes.annotate(
            "reversal",
            (times[0], 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            size=SMALL - 0.5,
            color=GREY,
        )


def cut_off(axes: Axes, limits: Sequence[float], note: str) -> None:
    """Give axes an ordinate that impacts or the first sample do not set, and say what lies outside."""
    if limits:
        axes.set_ylim(*limits)
        axes.text(1.0, 1.02, note, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)
