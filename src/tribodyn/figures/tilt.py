"""Tilt of the trunnion in the bushing, and the peak pressure that goes with it."""

from __future__ import annotations

from typing import Final

import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.base import Family
from tribodyn.figures.events import limit_to_smooth, mark_reversals, reversal_times
from tribodyn.figures.style import (
    BLUE,
    DASHED,
    GREY,
    INK,
    SOLID,
    VERMILION,
    finish,
    legend,
    lines,
    series,
    sheet,
)

TITLE: Final = "Tilt of the trunnion and peak pressure"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw both tilts [mrad] and the peak pressure [MPa] over time."""
    figure = sheet(dataset, TITLE, 4.4)
    tilt, pressure = figure.subplots(2, 1, sharex=True, height_ratios=(1.4, 1.0))
    time, turns = series(dataset, "time"), reversal_times(dataset)
    curves = [
        (series(dataset, "phi_x", 1e3), "φx, about X", BLUE, SOLID),
        (series(dataset, "phi_y", 1e3), "φy, about Y", VERMILION, DASHED),
    ]
    lines(tilt, time, curves, width=1.4)
    lines(pressure, time, [(series(dataset, "p_max", 1e-6), "peak pressure", INK, SOLID)], width=1.0)
    tilt.axhline(0.0, color=GREY, linewidth=0.8, zorder=1)
    legend(tilt, 2)
    finish(tilt, y_label="tilt [mrad]")
    finish(pressure, "time [s]", "peak pressure [MPa]")
    pressure.set_ylim(bottom=0.0)
    limit_to_smooth(pressure, time, series(dataset, "p_max", 1e-6), turns, "MPa")
    for axes in (tilt, pressure):
        mark_reversals(axes, turns, label=axes is pressure)
    figure.align_ylabels()
    return figure


FAMILY: Final = Family(
    name="tilt",
    title=TITLE,
    caption=(
        "A tilted trunnion bears on the edges of the bushing. Where the two angles change, the loaded edge "
        "moves and the peak pressure follows."
    ),
    needs=("phi_x", "phi_y", "p_max", "omega_v_ideal"),
    draw=draw,
)
