"""Where the centre of a journal goes inside the clearance circle, law beside law."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tribodyn.figures.base import Family
from tribodyn.figures.journal import LOOKS, laws, of_law
from tribodyn.figures.style import GREY, INK, SMALL, caption, finish, finite, lines, peak, sheet

TITLE: Final = "Journal: path in the clearance circle"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the path of the centre of each law [µm]."""
    figure = sheet(dataset, TITLE, 4.3)
    names = laws(dataset)
    grid = figure.subplots(1, max(len(names), 1), sharex=True, sharey=True, squeeze=False)[0]
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    paths = [(of_law(dataset, "e_x", k, 1e6), of_law(dataset, "e_y", k, 1e6)) for k in range(len(names))]
    reach = 1.12 * max(clearance, *(peak(values) for path in paths for values in path), 1e-3)
    for k, (axes, name, (x, y)) in enumerate(zip(grid, names, paths, strict=True)):
        _circle(axes, clearance, reach)
        colour, dash = LOOKS[k % len(LOOKS)]
        lines(axes, x, [(y, "path", colour, dash)], width=0.9)
        _ends(axes, dataset, k)
        caption(axes, name)
        finish(axes, "e_x [µm]", "" if k else "e_y [µm]")
    if names:
        handles, labels = grid[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, fontsize=SMALL)
    return figure


def _circle(axes: Axes, clearance: float, reach: float) -> None:
    axes.set_aspect("equal")
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    axes.plot(0.0, 0.0, "+", color=GREY, ms=7, mew=0.8)
    axes.add_patch(Circle((0.0, 0.0), clearance, fill=False, edgecolor=GREY, linewidth=1.0))


def _ends(axes: Axes, dataset: xr.Dataset, law: int) -> None:
    """Mark the start and the static equilibrium."""
    x, y = of_law(dataset, "e_x", law, 1e6), of_law(dataset, "e_y", law, 1e6)
    first = np.flatnonzero(np.isfinite(x + y))[:1]
    if finite(x).size:
        axes.plot(x[first], y[first], "o", ms=4, mfc="white", mec=INK, mew=1.1, label="start", zorder=5)
    balance = [float(dataset[f"{name}_balance"].values[law]) * 1e6 for name in ("e_x", "e_y")]
    axes.plot(*balance, "x", color=INK, ms=6, mew=1.2, label="static equilibrium", zorder=6)


FAMILY: Final = Family(
    name="journal_orbit",
    title=TITLE,
    caption="The circle is the clearance: beyond it the mean planes of the surfaces overlap.",
    needs=("law", "e_x", "e_y", "e_x_balance", "e_y_balance"),
    draw=draw,
)
