"""Depth and pressure over the cycles of a wear campaign."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.base import Family
from tribodyn.figures.style import BLUE, DASHED, GREY, INK, SOLID, caption, finish, legend, lines, note, sheet
from tribodyn.views.series import series
from tribodyn.views.wear import PANELS, WEAR_HISTORY, fitting_unit, no_feedback

TITLE: Final = WEAR_HISTORY.title
_LOOKS: Final = ((INK, DASHED), (BLUE, SOLID))
FAR_APART: Final = 10.0
"""Ratio of the largest to the least from which an axis counts in powers of ten."""


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the greatest depth, and below it what is known of the cycles that were simulated."""
    below = [
        (label, size, there)
        for label, size, names in PANELS
        if (there := {name: words for name, words in names.items() if name in dataset})
    ]
    figure = sheet(dataset, TITLE, 2.6 + 1.7 * len(below))
    panels = figure.subplots(1 + len(below), 1, sharex=True, squeeze=False)[:, 0]
    cycles = series(dataset, "wear_cycles")
    if cycles.size:
        _depth(panels[0], dataset, cycles)
        for axes, (_, size, names) in zip(panels[1:], below, strict=True):
            _of_motion(axes, dataset, cycles, size, names)
    else:
        for axes in panels:
            note(axes, "nothing computed")
    finish(panels[0], "", panels[0].get_ylabel())
    for axes, (label, _, _) in zip(panels[1:], below, strict=True):
        finish(axes, "drive cycles" if axes is panels[-1] else "", label)
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


def _of_motion(
    axes: Axes, dataset: xr.Dataset, cycles: FloatArray, size: float, names: Mapping[str, str]
) -> None:
    """Draw numbers of the simulated cycles; far apart, in powers of ten."""
    drawn = [
        (series(dataset, name, 1.0 / size), words, *look)
        for (name, words), look in zip(names.items(), _LOOKS, strict=False)
    ]
    lines(axes, cycles, drawn)
    every = np.array([values for values, *_ in drawn])
    largest, least = float(np.nanmax(every)), float(np.nanmin(every))
    if least > 0.0 and largest > FAR_APART * least:
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.3 * largest or 1.0)
    legend(axes, 2)


def _marker(cycles: FloatArray) -> str:
    """Mark the stops as long as they can be told apart."""
    return "o" if cycles.size <= 40 else ""


FAMILY: Final = Family(
    name="wear_history",
    title=TITLE,
    caption=WEAR_HISTORY.caption,
    needs=WEAR_HISTORY.needs,
    draw=draw,
)
