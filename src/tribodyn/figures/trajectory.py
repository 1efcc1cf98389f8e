"""Path of the trunnion inside the clearance circle."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.views.bushing_sections import centre
from tribodyn.views.events import direction, finite, peak, signed

TITLE: Final = "Trunnion trajectory in the clearance circle"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the paths of the top, middle and bottom centres of the trunnion [µm]."""
    figure = style.sheet(dataset, TITLE, 3.5)
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    half = 0.5 * float(dataset.attrs.get("joint_length", 0.0))
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    paths = [centre(dataset, z) for z in (half, 0.0, -half)]
    reach = max(clearance, *(peak(values) for path in paths for values in path), 1e-3)
    for axes, path, place, z in zip(
        panels, paths, ("top", "middle", "bottom"), (half, 0.0, -half), strict=True
    ):
        _circle(axes, clearance, reach)
        _path(axes, *path, direction(dataset))
        style.caption(axes, f"{place}, z = {signed(z * 1e3)} mm" if z else place)
        style.finish(axes, "X [µm]")
    panels[0].set_ylabel("Y [µm]")
    _legend(figure, panels[0])
    return figure


def _circle(axes: Axes, clearance: float, reach: float) -> None:
    """Draw the clearance circle, and name the wall by the bushing angles of the pressure maps."""
    axes.set_aspect("equal")
    axes.set(xlim=(-1.3 * reach, 1.3 * reach), ylim=(-1.3 * reach, 1.3 * reach))
    axes.plot(0.0, 0.0, "+", color=style.GREY, ms=7, mew=0.8)
    if not clearance:
        return
    axes.add_patch(Circle((0.0, 0.0), clearance, fill=False, edgecolor=style.GREY, linewidth=1.0))
    for theta in (0, 90, 180, 270):
        x, y = np.cos(np.deg2rad(theta)), np.sin(np.deg2rad(theta))
        radius = 1.15 * clearance
        axes.text(
            radius * x,
            radius * y,
            f"{theta}°",
            size=style.SMALL - 1.5,
            color=style.GREY,
            ha="center",
            va="center",
        )


def _path(axes: Axes, x: FloatArray, y: FloatArray, sense: FloatArray) -> None:
    """Draw one path, the two directions of motion apart, with its first point."""
    axes.plot(x, y, color=style.PALE, linewidth=0.6, zorder=1)
    forward, reverse = np.where(sense > 0.0, y, np.nan), np.where(sense < 0.0, y, np.nan)
    style.lines(
        axes,
        x,
        [(forward, "forward", style.BLUE, style.SOLID), (reverse, "reverse", style.VERMILION, style.DASHED)],
        width=1.1,
    )
    first = np.flatnonzero(np.isfinite(x + y))[:1]
    if finite(x).size:
        axes.plot(x[first], y[first], "o", ms=4, mfc="white", mec=style.INK, mew=1.1, label="start", zorder=5)


def _legend(figure: Figure, axes: Axes) -> None:
    """Put the one legend below the panels."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, fontsize=style.SMALL)


FAMILY: Final = Family(
    name="trajectory",
    title=TITLE,
    caption=(
        "Paths of three points of the trunnion axis. The circle is the clearance: beyond it the mean planes "
        "of the surfaces overlap. Angles at the wall are those of the pressure and wear maps."
    ),
    needs=("e_x", "e_y", "phi_x", "phi_y", "omega_v_ideal"),
    draw=draw,
)
