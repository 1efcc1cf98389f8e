"""Deviation of a journal from the axis of its bushing, and the forces that hold it, law beside law."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.base import Family
from tribodyn.figures.style import (
    BLUE,
    DASHED,
    GREY,
    INK,
    SMALL,
    SOLID,
    VERMILION,
    LineStyle,
    caption,
    finish,
    lines,
    sheet,
)

TITLE: Final = "Journal: deviation and forces"
LOOKS: Final[tuple[tuple[str, LineStyle], ...]] = ((BLUE, SOLID), (VERMILION, DASHED))
"""Colour and dash pattern of each law."""
_PANELS: Final = (
    ("deviation", "e_", 1e6, "µm"),
    ("contact force", "F_c", 1.0, "N"),
    ("film force", "F_o", 1.0, "N"),
)
_MILLISECONDS: Final = 1e3


def of_law(dataset: xr.Dataset, name: str, law: int, scale: float = 1.0) -> FloatArray:
    """Return a variable of one law times ``scale``, shape (n_t,); infinities become NaN."""
    values = np.asarray(dataset[name].isel(law=law).values, dtype=np.float64) * scale
    return np.where(np.isfinite(values), values, np.nan)


def laws(dataset: xr.Dataset) -> list[str]:
    """Return the names of the laws of a result, as figures print them."""
    return [str(law).upper() for law in dataset["law"].values]


def draw(dataset: xr.Dataset) -> Figure:
    """Draw deviation [µm], contact force and, with oil, film force [N] along X and Y over time."""
    panels = [panel for panel in _PANELS if f"{panel[1]}x" in dataset.variables]
    figure = sheet(dataset, TITLE, 1.0 + 1.95 * len(panels))
    grid = figure.subplots(len(panels), 2, sharex=True, squeeze=False)
    time = np.asarray(dataset["time"].values, dtype=np.float64) * _MILLISECONDS
    for row, (what, symbol, scale, unit) in zip(grid, panels, strict=True):
        for axes, direction in zip(row, "xy", strict=True):
            _panel(axes, dataset, time, f"{symbol}{direction}", scale)
            caption(axes, f"{what} along {direction.upper()}")
            finish(axes, "", f"{what} [{unit}]" if direction == "x" else "")
    for axes in grid[-1]:
        axes.set_xlabel("time [ms]")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(
        handles[::-1], labels[::-1], loc="outside lower center", ncols=3, frameon=False, fontsize=SMALL
    )
    return figure


def _panel(axes: Axes, dataset: xr.Dataset, time: FloatArray, name: str, scale: float) -> None:
    """Draw one variable of all laws, and where statics would have it."""
    static = _static(dataset, name)
    if np.isfinite(static):
        axes.axhline(static * scale, color=GREY, linewidth=0.8, dashes=(2, 2), label="static equilibrium")
    curves = [
        (of_law(dataset, name, k, scale), law, *LOOKS[k % len(LOOKS)]) for k, law in enumerate(laws(dataset))
    ]
    # A curve that swings stays readable below one that settles.
    lines(axes, time, curves[::-1], width=1.0)
    axes.tick_params(labelcolor=INK)


def _static(dataset: xr.Dataset, name: str) -> float:
    """Return the value at the static equilibrium of the first law, NaN where it is not known."""
    if name in ("e_x", "e_y"):
        return float(dataset[f"{name}_balance"].values[0])
    return float("nan")


FAMILY: Final = Family(
    name="journal",
    title=TITLE,
    caption=(
        "How the centre of the journal moves under its load, and what contact and oil film answer with. "
        "Without damping and without oil the journal keeps bouncing; grey is where statics would have it."
    ),
    needs=("law", "e_x", "e_y", "F_cx", "F_cy", "e_x_balance", "e_y_balance"),
    draw=draw,
)
