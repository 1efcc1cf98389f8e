"""Errors of the copies of a pattern around their axis, and the copy furthest from the mean."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.figure_family import Family
from tribodyn.figures.style import BLUE, INK, SMALL, VERMILION, legend_below, note, sheet
from tribodyn.mechanism.results.copies import copies_of
from tribodyn.mechanism.sections.copies import COPIES, around


def draw(dataset: xr.Dataset) -> Figure:
    """Draw at the angle of each copy a bar from its least to its largest error, and its mean."""
    found, figure = around(dataset), sheet(dataset, COPIES.title, 4.6)
    if not found:
        note(figure.subplots(), "nothing to draw")
        return figure
    every = figure.subplots(1, len(found), squeeze=False, subplot_kw={"projection": "polar"})[0]
    for axes, one in zip(every, found, strict=True):
        n = one.angles.size
        far = np.arange(n) == one.worst
        for chosen, colour, label in (
            (~far, BLUE, "range over time"),
            (far, VERMILION, "furthest from the mean"),
        ):
            bars = (values[chosen] for values in (one.angles, one.low, one.high))
            axes.vlines(*bars, color=colour, lw=3.0, label=label)
        axes.plot(one.angles, one.mean, "o", color=INK, ms=3.0, label="mean over time")
        axes.set_rlim(one.middle, float(one.high.max()) + 0.05 * one.span)
        axes.set_theta_zero_location("N")
        axes.set_theta_direction(-1)
        shown = np.unique(np.linspace(0, n - 1, min(n, 12)).astype(int))
        axes.set_xticks(one.angles[shown], [f"{one.name}[{k + 1}]" for k in shown], size=SMALL)
        axes.tick_params(axis="y", labelsize=SMALL)
        axes.set_xlabel(f"error [{one.unit}]", size=SMALL)
    legend_below(figure, every[0], 3)
    return figure


FAMILY: Final = Family(
    name=COPIES.still,
    title=COPIES.title,
    caption=COPIES.caption,
    needs=COPIES.needs,
    draw=draw,
    shows=lambda dataset: bool(copies_of(dataset)),
)
