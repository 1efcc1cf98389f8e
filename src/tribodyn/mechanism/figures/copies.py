"""Errors of the copies of a pattern around their axis, and the copy furthest from the mean."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.figure_family import Family
from tribodyn.figures.style import BLUE, INK, SMALL, VERMILION, legend_below, note, sheet
from tribodyn.mechanism.results.copies import copies_of, worst
from tribodyn.results.reading import column, settled
from tribodyn.results.variables import ERROR_UNITS

TITLE: Final = "Copies around their axis"
_ROOM: Final = 0.6  #: Radius of the inner circle over the range of all errors.


def draw(dataset: xr.Dataset) -> Figure:
    """Draw at the angle of each copy a bar from its least to its largest error, and its mean."""
    groups = copies_of(dataset)
    figure = sheet(dataset, TITLE, 4.6)
    if not groups or not dataset.sizes["time"]:
        note(figure.subplots(), "nothing to draw")
        return figure
    every = figure.subplots(1, len(groups), squeeze=False, subplot_kw={"projection": "polar"})[0]
    for axes, (name, numbers) in zip(every, groups.items(), strict=True):
        unit = ERROR_UNITS[str(dataset["output_unit"].values[numbers[0]])]
        error = unit.scale * settled(dataset, column(dataset, "output_error")[:, numbers])
        low, high, mean = error.min(axis=0), error.max(axis=0), error.mean(axis=0)
        angles = 2.0 * np.pi * np.arange(len(numbers)) / len(numbers)
        far = np.arange(len(numbers)) == worst(error)
        for chosen, colour, label in (
            (~far, BLUE, "range over time"),
            (far, VERMILION, "furthest from the mean"),
        ):
            axes.vlines(angles[chosen], low[chosen], high[chosen], color=colour, lw=3.0, label=label)
        axes.plot(angles, mean, "o", color=INK, ms=3.0, label="mean over time")
        span = max(float(high.max() - low.min()), np.finfo(float).tiny)
        axes.set_rlim(float(low.min()) - _ROOM * span, float(high.max()) + 0.05 * span)
        axes.set_theta_zero_location("N")
        shown = np.unique(np.linspace(0, len(numbers) - 1, min(len(numbers), 12)).astype(int))
        axes.set_xticks(angles[shown], [f"{name}[{k + 1}]" for k in shown], size=SMALL)
        axes.tick_params(axis="y", labelsize=SMALL)
        axes.set_xlabel(f"error [{unit.shown}]", size=SMALL)
    legend_below(figure, every[0], 3)
    return figure


FAMILY: Final = Family(
    name="copies",
    title=TITLE,
    caption="Errors of the copies of a repeated output by their numbers, from least to largest over time.",
    needs=("output_error", "output_unit", "output"),
    draw=draw,
    shows=lambda dataset: bool(copies_of(dataset)),
)
