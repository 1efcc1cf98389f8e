"""Joints with clearance: paths of the shafts, and maps of their surfaces."""

from collections.abc import Sequence
from functools import partial
from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.figure_family import Family
from tribodyn.figures.pressure import COLOURS
from tribodyn.figures.style import BLUE, GREY, INK, caption, colour_bar, finish, note, sheet
from tribodyn.mechanism.sections import joints as maps
from tribodyn.mechanism.sections.joints import (
    MOST,
    SurfaceMap,
    hodograph,
    loaded_joints,
    real_joints,
    surfaces,
)
from tribodyn.views.bushing import best_cut, rolled
from tribodyn.views.events import peak

_ACROSS: Final = 3
"""Panels beside each other; one less where their names are long."""
_LONG: Final = 16


def draw_orbits(dataset: xr.Dataset) -> Figure:
    """Draw the path of each shaft in its clearance circle [µm]."""
    chosen = real_joints(dataset)
    names = [str(dataset["joint"].values[joint]) for joint in chosen.joints]
    figure, panels = _grid(dataset, f"{ORBITS.title}{chosen.which}", names, 2.9)
    for axes, joint in zip(panels, chosen.joints, strict=False):
        x, y = (1e6 * dataset["displacement"].values[:, joint, i] for i in range(2))
        clearance = 1e6 * float(dataset["clearance"].values[joint])
        reach = 1.25 * max(clearance, peak(x), peak(y))
        axes.set_aspect("equal")
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
        axes.add_patch(Circle((0.0, 0.0), clearance, fill=False, edgecolor=GREY, linewidth=1.0))
        axes.plot(x, y, color=BLUE, linewidth=0.7)
        axes.plot(x[:1], y[:1], "o", ms=4, mfc="white", mec=INK, mew=1.1, zorder=5)
        caption(axes, str(dataset["joint"].values[joint]))
        finish(axes, "x [µm]", "y [µm]")
    return figure


def draw_maps(drawn: SurfaceMap, dataset: xr.Dataset) -> Figure:
    """Draw the largest values of a field on every surface that is not empty."""
    found = [part for part in surfaces(dataset, drawn.variable) if part[3].max(initial=0.0) > 0.0]
    which = ""
    if real_joints(dataset).which and len(found) > MOST:
        largest = sorted(range(len(found)), key=lambda k: -float(found[k][3].max()))[:MOST]
        found = [found[k] for k in sorted(largest)]
        which = f", {MOST} surfaces of {dataset.sizes[drawn.per]} with the largest values"
    names = [surface for surface, *_ in found]
    figure, panels = _grid(dataset, f"{drawn.heading}{which}", names, 2.2)
    for axes, (surface, place, theta, fields) in zip(panels, found, strict=False):
        field = fields.max(axis=0)
        shown, size = drawn.unit(float(field.max()))
        mesh = _draw_map(axes, place, theta, field / size)
        caption(axes, surface)
        finish(axes, "angle about the axis [°]", _along(surface))
        colour_bar(figure, mesh, axes, f"{drawn.label} [{shown}]")
    if not found:
        note(panels[0], f"no {drawn.label.removesuffix(' depth')}")
    return figure


def draw_hodographs(dataset: xr.Dataset) -> Figure:
    """Draw the end of the force vector of each joint in the plane in which it varies most."""
    chosen = loaded_joints(dataset)
    drawn = [one for joint in chosen.joints if (one := hodograph(dataset, joint)) is not None]
    names = [one.joint for one in drawn]
    figure, panels = _grid(dataset, f"{HODOGRAPHS.title}{chosen.which}", names, 2.9)
    for axes, one in zip(panels, drawn, strict=False):
        axes.set_aspect("equal", adjustable="datalim")
        axes.axhline(0.0, color=GREY, linewidth=0.6)
        axes.axvline(0.0, color=GREY, linewidth=0.6)
        axes.plot(*one.values, color=BLUE, linewidth=0.9)
        caption(axes, one.joint)
        finish(axes, *one.labels)
    return figure


def _along(surface: str) -> str:
    """Return the label of the second coordinate of a surface: height, radius of a face, or arc of a ball."""
    name = surface.rpartition(":")[2]
    return f"{'radius' if name in ('upper', 'lower') else 'arc' if name == 'ball' else 'height'} [mm]"


def _draw_map(axes: Axes, place: FloatArray, theta: FloatArray, field: FloatArray) -> QuadMesh:
    angle, values = rolled(theta, field, best_cut(theta, field.max(axis=1)))
    look: dict[str, Any] = {"shading": "gouraud", "cmap": COLOURS, "vmin": 0.0, "rasterized": True}
    mesh = axes.pcolormesh(angle, 1e3 * place, values.T, **look)
    ticks = 90.0 * np.ceil(angle[0] / 90.0 - 1e-9) + 90.0 * np.arange(5)
    axes.set_xticks(ticks, [f"{tick % 360:.0f}" for tick in ticks])
    axes.set_xlim(angle[0], angle[-1])
    return mesh


def _grid(
    dataset: xr.Dataset, title: str, names: Sequence[str], height: float
) -> tuple[Figure, Sequence[Axes]]:
    """Return a sheet of panels for names, those that nothing is drawn in taken away."""
    n, longest = len(names), max(map(len, names), default=0)
    columns = min(max(n, 1), _ACROSS - (longest > _LONG))
    rows = -(-max(n, 1) // columns)
    figure = sheet(dataset, title, 0.5 + height * rows)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in panels[max(n, 1) :]:
        axes.remove()
    return figure, list(panels)


ORBITS: Final = Family(
    name="orbits",
    title="Shafts in their bores",
    caption=(
        "Paths of the middles of the shafts across their axes. The circle is the clearance: beyond it the "
        "mean planes of the surfaces overlap."
    ),
    needs=("displacement", "clearance", "joint", "surface"),
    draw=draw_orbits,
)
HODOGRAPHS: Final = Family(
    name="hodographs",
    title="Direction of the forces in the joints",
    caption=(
        "Path of the end of the force vector on the shaft's body, in the two axes of the joint along which "
        "it changes most: how large the force is, and from where it presses."
    ),
    needs=("reaction_force", "joint"),
    draw=draw_hodographs,
    shows=lambda dataset: any(hodograph(dataset, joint) for joint in loaded_joints(dataset).joints),
)
MAPS: Final = tuple(
    Family(
        name=one.figure,
        title=one.heading,
        caption=one.caption,
        needs=(one.variable, one.per),
        draw=partial(draw_maps, one),
    )
    for one in maps.MAPS
)
