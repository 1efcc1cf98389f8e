"""Wear depth of the bushing."""

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
    DOTTED,
    INK,
    SMALL,
    SOLID,
    TEXT,
    VERMILION,
    caption,
    finish,
    legend,
    lines,
    sheet,
)
from tribodyn.figures.unrolled import draw_map
from tribodyn.views.series import signed
from tribodyn.views.unrolled import best_cut, rolled, unloaded_middle, z_label
from tribodyn.views.wear import fitting_unit

TITLE: Final = "Wear depth of the bushing"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the depth on the unrolled bushing, and along its two edges and its middle."""
    figure = sheet(dataset, TITLE, 4.6)
    plan, profile = figure.subplots(2, 1, sharex=True, height_ratios=(1.2, 1.0))
    depth = np.nan_to_num(dataset["wear_depth"].values)
    unit, size = fitting_unit(float(depth.max(initial=0.0)))
    depth = depth / size
    cut = best_cut(dataset["theta"].values, depth.max(axis=1, initial=0.0))
    empty = unloaded_middle(dataset, depth)
    mesh = draw_map(plan, dataset, depth, cut, float(depth.max(initial=0.0)) or 1.0, empty)
    _profiles(profile, dataset, depth, cut)
    _headline(plan, dataset, depth, unit)
    plan.set_ylabel(z_label(empty), size=TEXT)
    finish(profile, "bushing angle θ [°]", f"depth [{unit}]")
    bar = figure.colorbar(mesh, ax=[plan, profile], shrink=0.7, aspect=30, pad=0.02)
    bar.set_label(f"wear depth [{unit}]", size=TEXT)
    bar.ax.tick_params(labelsize=SMALL)
    bar.outline.set_visible(False)
    return figure


def _headline(axes: Axes, dataset: xr.Dataset, depth: FloatArray, unit: str) -> None:
    """Say how deep and after what."""
    time, period = dataset["time"].values, dataset.attrs.get("cycle_period")
    after = f" after {np.ptp(time) / period:.3g} cycles" if period and time.size else ""
    if "wear_cycles_reached" in dataset.attrs:
        after = f" after {dataset.attrs['wear_cycles_reached']} cycles"
    caption(axes, f"deepest {depth.max(initial=0.0):.3g} {unit}{after}")


def _profiles(axes: Axes, dataset: xr.Dataset, depth: FloatArray, cut: float) -> None:
    """Draw the depth around the bushing at both edges and in the middle."""
    z = dataset["z"].values
    middle = int(np.argmin(np.abs(z)))
    angle, around = rolled(dataset["theta"].values, depth, cut)
    curves = [
        (around[:, -1], f"top edge, z = {signed(z[-1] * 1e3)} mm", BLUE, SOLID),
        (around[:, middle], "middle", INK, DOTTED),
        (around[:, 0], f"bottom edge, z = {signed(z[0] * 1e3)} mm", VERMILION, DASHED),
    ]
    lines(axes, angle, curves)
    axes.set_ylim(bottom=0.0)
    legend(axes, 3)


FAMILY: Final = Family(
    name="wear_depth",
    title=TITLE,
    caption=(
        "Depth worn off the bushing: after the cycles of the wear campaign, or else a linear estimate for "
        "this run, in which the worn shape does not change the pressure. Above: the bushing laid flat. "
        "Below: around its edges and its middle."
    ),
    needs=("wear_depth", "theta", "z"),
    draw=draw,
)
