"""Paths of points of shafts in their clearance circles, a panel each."""

from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.views.orbits import Orbit, OrbitPath, OrbitView


def family(view: OrbitView) -> Family:
    """Return the figure of orbits."""
    return Family(view.still, view.title, view.caption, view.needs, partial(draw, view))


def draw(view: OrbitView, dataset: xr.Dataset) -> Figure:
    """Draw the path of each point over the playback [µm]."""
    orbits, which = view.orbits(dataset)
    panels = [(orbit, track) for orbit in orbits for track in orbit.tracks]
    names = [orbit.name if len(orbit.tracks) == 1 else track.name for orbit, track in panels]
    figure, every = style.grid(dataset, f"{view.title}{which}", names, 2.9)
    for axes, name, panel in zip(every, names, panels, strict=False):
        _draw_track(axes, *panel)
        style.caption(axes, name)
    if not panels:
        style.note(every[0], "nothing computed")
    for axes in every:
        style.finish(axes, "X [µm]", "Y [µm]")
    return figure


def _draw_track(axes: Axes, orbit: Orbit, track: OrbitPath) -> None:
    """Draw the circle, named by the angles of maps of its wall, and one path with its first point."""
    reach = 1.1 * orbit.reach
    axes.set(aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
    axes.plot(0.0, 0.0, "+", color=style.GREY, ms=7, mew=0.8)
    look: dict[str, Any] = {"fill": False, "edgecolor": style.GREY, "linewidth": 1.0}
    wall = Polygon(orbit.corners, **look) if orbit.corners else Circle((0.0, 0.0), orbit.clearance, **look)
    axes.add_patch(wall)
    for theta in () if orbit.corners else (0, 90, 180, 270):
        x, y = (1.12 * orbit.clearance * way(np.deg2rad(theta)) for way in (np.cos, np.sin))
        axes.text(x, y, f"{theta}°", size=style.SMALL - 1.5, color=style.GREY, ha="center", va="center")
    axes.plot(*track.path.T, color=style.BLUE, linewidth=0.8)
    axes.plot(*track.path[:1].T, "o", ms=4, mfc="white", mec=style.INK, mew=1.1, zorder=5)
