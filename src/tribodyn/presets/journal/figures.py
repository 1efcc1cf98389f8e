"""Figures of the journal, in the order in which one reads them."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import chart, energy
from tribodyn.figures.base import Family
from tribodyn.figures.style import BLUE, GREY, INK, SMALL, SOLID, finish, lines, sheet
from tribodyn.presets.journal.energy_balance import BALANCE
from tribodyn.presets.journal.sections import DEVIATION, FORCES
from tribodyn.views.series import peak, series

TITLE: Final = "Journal: path in the clearance circle"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the path of the centre [µm]."""
    figure = sheet(dataset, TITLE, 5.0, width=5.2)
    axes = figure.subplots()
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    x, y = series(dataset, "e_x", 1e6), series(dataset, "e_y", 1e6)
    reach = 1.12 * max(clearance, peak(x), peak(y), 1e-3)
    axes.set_aspect("equal")
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    axes.plot(0.0, 0.0, "+", color=GREY, ms=7, mew=0.8)
    axes.add_patch(Circle((0.0, 0.0), clearance, fill=False, edgecolor=GREY, linewidth=1.0))
    lines(axes, x, [(y, "path", BLUE, SOLID)], width=0.9)
    _ends(axes, dataset, x, y)
    finish(axes, "e_x [µm]", "e_y [µm]")
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=SMALL)
    return figure


def _ends(axes: Axes, dataset: xr.Dataset, x: FloatArray, y: FloatArray) -> None:
    """Mark the start and the static equilibrium."""
    first = np.flatnonzero(np.isfinite(x + y))[:1]
    axes.plot(x[first], y[first], "o", ms=4, mfc="white", mec=INK, mew=1.1, label="start", zorder=5)
    balance = [float(dataset[f"{name}_balance"].values) * 1e6 for name in ("e_x", "e_y")]
    axes.plot(*balance, "x", color=INK, ms=6, mew=1.2, label="static equilibrium", zorder=6)


PATH: Final = Family(
    name="path",
    title=TITLE,
    caption="The circle is the clearance: beyond it the mean planes of the surfaces overlap.",
    needs=("e_x", "e_y", "e_x_balance", "e_y_balance"),
    draw=draw,
)

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        chart.family(DEVIATION),
        PATH,
        chart.family(FORCES),
        energy.family((BALANCE,)),
    )
}
