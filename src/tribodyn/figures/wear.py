"""Worn depth of the bushing."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.figures.pressure import draw_map
from tribodyn.views.bushing import WALL, Unrolled, unrolled
from tribodyn.views.events import signed
from tribodyn.views.wear import WORN, fitting_unit

TITLE: Final = "Wear depth of the bushing"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the depth on the unrolled bushing, and along its two edges and its middle."""
    figure = style.sheet(dataset, TITLE, 4.6)
    plan, profile = figure.subplots(2, 1, sharex=True, height_ratios=(1.2, 1.0))
    depth = np.nan_to_num(dataset["wear_depth"].values)
    unit, size = fitting_unit(float(depth.max(initial=0.0)))
    depth = depth / size
    laid = unrolled(dataset, depth[None])
    mesh = draw_map(plan, laid, depth, float(depth.max(initial=0.0)) or 1.0)
    _profiles(profile, laid, depth)
    _key_result(plan, dataset, depth, unit)
    plan.set_ylabel(laid.label, size=style.TEXT)
    style.finish(profile, WALL, f"depth [{unit}]")
    style.colour_bar(figure, mesh, [plan, profile], f"wear depth [{unit}]", shrink=0.7)
    return figure


def _key_result(axes: Axes, dataset: xr.Dataset, depth: FloatArray, unit: str) -> None:
    """Write depth and number of cycles."""
    time, period = dataset["time"].values, dataset.attrs.get("cycle_period")
    after = f" after {np.ptp(time) / period:.3g} cycles" if period and time.size else ""
    if "wear_cycles_reached" in dataset.attrs:
        after = f" after {dataset.attrs['wear_cycles_reached']} cycles"
    style.caption(axes, f"deepest {depth.max(initial=0.0):.3g} {unit}{after}")


def _profiles(axes: Axes, laid: Unrolled, depth: FloatArray) -> None:
    """Draw the depth around the bushing at both edges and in the middle."""
    z, around = laid.z, laid.turned(depth)
    middle = int(np.argmin(np.abs(z)))
    curves = [
        (around[:, -1], f"top edge, z = {signed(z[-1])} mm", style.BLUE, style.SOLID),
        (around[:, middle], "middle", style.INK, style.DOTTED),
        (around[:, 0], f"bottom edge, z = {signed(z[0])} mm", style.VERMILION, style.DASHED),
    ]
    style.lines(axes, laid.angle, curves)
    axes.set_ylim(bottom=0.0)
    style.legend(axes, 3)


FAMILY: Final = Family(
    name="wear_depth",
    title=TITLE,
    caption=f"{WORN} Above: the bushing laid flat. Below: around its edges and its middle.",
    needs=("wear_depth", "theta", "z"),
    draw=draw,
)
