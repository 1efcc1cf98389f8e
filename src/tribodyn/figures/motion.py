"""Motion of drive and vane."""

from __future__ import annotations

from string import ascii_lowercase
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.figures.base import Family
from tribodyn.figures.events import mark_reversals, reversal_times
from tribodyn.figures.style import (
    BLUE,
    DASHED,
    INK,
    SMALL,
    SOLID,
    VERMILION,
    finish,
    legend,
    lines,
    series,
    sheet,
)

TITLE: Final = "Drive and vane motion"
DEG: Final = 180.0 / np.pi


def draw(dataset: xr.Dataset) -> Figure:
    """Draw crank and vane angles, their speeds and the drive moment over time."""
    figure = sheet(dataset, TITLE, 6.0)
    angle, speed, moment = figure.subplots(3, 1, sharex=True, height_ratios=(1.5, 1.1, 1.0))
    time, turns = series(dataset, "time"), reversal_times(dataset)
    _pair(angle, dataset, "theta_v", "theta_a", "angle")
    _pair(speed, dataset, "omega_v", "omega_a", "speed")
    lines(moment, time, [(series(dataset, "M_d"), "drive moment", INK, SOLID)])
    _mark_snapshots(angle, dataset)
    finish(angle, y_label="angle [°]")
    finish(speed, y_label="speed [°/s]")
    finish(moment, "time [s]", "drive moment\non the crank [N m]")
    for axes in (angle, speed, moment):
        mark_reversals(axes, turns, label=axes is moment)
    figure.align_ylabels()
    return figure


def _pair(axes: Axes, dataset: xr.Dataset, vane: str, crank: str, kind: str) -> None:
    """Draw the same quantity of vane and crank."""
    curves = [
        (series(dataset, vane, DEG), f"vane {kind}", BLUE, SOLID),
        (series(dataset, crank, DEG), f"crank {kind}", VERMILION, DASHED),
    ]
    lines(axes, series(dataset, "time"), curves, width=1.6)
    legend(axes, 2)


def _mark_snapshots(axes: Axes, dataset: xr.Dataset) -> None:
    """Mark where the pressure snapshots were taken, with the letters of that figure."""
    if "snapshot_time" not in dataset.variables:
        return
    times, angles = series(dataset, "snapshot_time"), series(dataset, "snapshot_theta_v", DEG)
    axes.plot(times, angles, "o", ms=4.5, mfc="white", mec=BLUE, mew=1.2, zorder=4)
    for letter, time, angle in zip(ascii_lowercase, times, angles, strict=False):
        offset = (0, 6) if angle < 90.0 else (0, -12)
        axes.annotate(
            letter, (time, angle), xytext=offset, textcoords="offset points", ha="center", size=SMALL
        )


FAMILY: Final = Family(
    name="motion",
    title=TITLE,
    caption=(
        "Where the crank drives the vane, how fast, and the moment this takes. "
        "Letters mark the positions of the pressure snapshots."
    ),
    needs=("theta_a", "theta_v", "omega_a", "omega_v", "omega_v_ideal", "M_d"),
    draw=draw,
)
