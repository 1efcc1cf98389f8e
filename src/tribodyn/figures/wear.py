"""Wear of the bushing: the worn depth, and its history over a campaign."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.figures.pressure import draw_map
from tribodyn.views.bushing import WALL, best_cut, rolled, unloaded_middle, wall_angles, z_label
from tribodyn.views.events import series, signed
from tribodyn.views.wear import PANELS, WEAR_HISTORY, fitting_unit, no_feedback

TITLE: Final = "Wear depth of the bushing"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the depth on the unrolled bushing, and along its two edges and its middle."""
    figure = style.sheet(dataset, TITLE, 4.6)
    plan, profile = figure.subplots(2, 1, sharex=True, height_ratios=(1.2, 1.0))
    depth = np.nan_to_num(dataset["wear_depth"].values)
    unit, size = fitting_unit(float(depth.max(initial=0.0)))
    depth = depth / size
    theta = wall_angles(dataset)
    cut = best_cut(theta, depth.max(axis=1, initial=0.0))
    empty = unloaded_middle(dataset, depth)
    mesh = draw_map(plan, dataset, theta, depth, cut, float(depth.max(initial=0.0)) or 1.0, empty)
    _profiles(profile, dataset, depth, cut)
    _key_result(plan, dataset, depth, unit)
    plan.set_ylabel(z_label(empty), size=style.TEXT)
    style.finish(profile, WALL, f"depth [{unit}]")
    bar = figure.colorbar(mesh, ax=[plan, profile], shrink=0.7, aspect=30, pad=0.02)
    bar.set_label(f"wear depth [{unit}]", size=style.TEXT)
    bar.ax.tick_params(labelsize=style.SMALL)
    bar.outline.set_visible(False)
    return figure


def _key_result(axes: Axes, dataset: xr.Dataset, depth: FloatArray, unit: str) -> None:
    """Write depth and number of cycles."""
    time, period = dataset["time"].values, dataset.attrs.get("cycle_period")
    after = f" after {np.ptp(time) / period:.3g} cycles" if period and time.size else ""
    if "wear_cycles_reached" in dataset.attrs:
        after = f" after {dataset.attrs['wear_cycles_reached']} cycles"
    style.caption(axes, f"deepest {depth.max(initial=0.0):.3g} {unit}{after}")


def _profiles(axes: Axes, dataset: xr.Dataset, depth: FloatArray, cut: float) -> None:
    """Draw the depth around the bushing at both edges and in the middle."""
    z = dataset["z"].values
    middle = int(np.argmin(np.abs(z)))
    angle, around = rolled(wall_angles(dataset), depth, cut)
    curves = [
        (around[:, -1], f"top edge, z = {signed(z[-1] * 1e3)} mm", style.BLUE, style.SOLID),
        (around[:, middle], "middle", style.INK, style.DOTTED),
        (around[:, 0], f"bottom edge, z = {signed(z[0] * 1e3)} mm", style.VERMILION, style.DASHED),
    ]
    style.lines(axes, angle, curves)
    axes.set_ylim(bottom=0.0)
    style.legend(axes, 3)


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


HISTORY_TITLE: Final = WEAR_HISTORY.title
_LOOKS: Final = ((style.INK, style.DASHED), (style.BLUE, style.SOLID))
FAR_APART: Final = 10.0
"""Ratio of the largest to the least from which an axis counts in powers of ten."""


def draw_history(dataset: xr.Dataset) -> Figure:
    """Draw the greatest depth, and below it what is known of the cycles that were simulated."""
    below = [
        (label, size, there)
        for label, size, names in PANELS
        if (there := {name: words for name, words in names.items() if name in dataset})
    ]
    figure = style.sheet(dataset, HISTORY_TITLE, 2.6 + 1.7 * len(below))
    panels = figure.subplots(1 + len(below), 1, sharex=True, squeeze=False)[:, 0]
    cycles = series(dataset, "wear_cycles")
    if cycles.size:
        _depth(panels[0], dataset, cycles)
        for axes, (_, size, names) in zip(panels[1:], below, strict=True):
            _of_motion(axes, dataset, cycles, size, names)
    else:
        for axes in panels:
            style.note(axes, "nothing computed")
    style.finish(panels[0], "", panels[0].get_ylabel())
    for axes, (label, _, _) in zip(panels[1:], below, strict=True):
        style.finish(axes, "drive cycles" if axes is panels[-1] else "", label)
    return figure


def _depth(axes: Axes, dataset: xr.Dataset, cycles: FloatArray) -> None:
    """Draw the depth, and beside it the straight line that it would be without feedback."""
    depth = series(dataset, "wear_depth_max")
    unit, size = fitting_unit(float(np.nanmax(depth, initial=0.0)))
    axes.plot(cycles, no_feedback(dataset) / size, color=style.GREY, linestyle=style.DASHED, linewidth=1.2)
    axes.plot(
        cycles,
        depth / size,
        color=style.BLUE,
        linestyle=style.SOLID,
        linewidth=1.5,
        marker=_marker(cycles),
        ms=2.5,
    )
    axes.set_ylim(0.0, 1.6 * float(np.nanmax(depth, initial=0.0)) / size or 1.0)
    axes.set_ylabel(f"depth [{unit}]")
    deepest = f"deepest {depth[-1] / size:.3g} {unit} after {cycles[-1]:.0f} cycles"
    style.caption(axes, f"{deepest}; dashed: if the first rate went on")


def _of_motion(
    axes: Axes, dataset: xr.Dataset, cycles: FloatArray, size: float, names: Mapping[str, str]
) -> None:
    """Draw numbers of the simulated cycles; far apart, in powers of ten."""
    drawn = [
        (series(dataset, name, 1.0 / size), words, *look)
        for (name, words), look in zip(names.items(), _LOOKS, strict=False)
    ]
    style.lines(axes, cycles, drawn)
    every = np.array([values for values, *_ in drawn])
    largest, least = float(np.nanmax(every)), float(np.nanmin(every))
    if least > 0.0 and largest > FAR_APART * least:
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.3 * largest or 1.0)
    style.legend(axes, 2)


def _marker(cycles: FloatArray) -> str:
    """Mark the stops as long as they can be distinguished."""
    return "o" if cycles.size <= 40 else ""


HISTORY: Final = Family(
    name="wear_history",
    title=HISTORY_TITLE,
    caption=WEAR_HISTORY.caption,
    needs=WEAR_HISTORY.needs,
    draw=draw_history,
)
