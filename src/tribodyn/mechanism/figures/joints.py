"""Joints with clearance and copies of a pattern: paths of shafts, maps of surfaces, errors around an axis."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures import style
from tribodyn.figures.chart import Family
from tribodyn.figures.pressure import draw_map
from tribodyn.mechanism.results.copies import copies_of
from tribodyn.mechanism.sections import joints as maps
from tribodyn.mechanism.sections.copies import COPIES, around
from tribodyn.mechanism.sections.joints import (
    MOST,
    SurfaceMap,
    hodograph,
    laid_flat,
    loaded_joints,
    real_joints,
    surfaces,
)


def draw_maps(drawn: SurfaceMap, dataset: xr.Dataset) -> Figure:
    """Draw the largest values of a field on every surface that is not empty."""
    found = [part for part in surfaces(dataset, drawn.variable) if part[3].max(initial=0.0) > 0.0]
    which = ""
    if real_joints(dataset).which and len(found) > MOST:
        largest = sorted(range(len(found)), key=lambda k: -float(found[k][3].max()))[:MOST]
        found = [found[k] for k in sorted(largest)]
        which = f", {MOST} surfaces of {dataset.sizes[drawn.per]} with the largest values"
    names = [surface for surface, *_ in found]
    figure, panels = style.grid(dataset, f"{drawn.heading}{which}", names, 2.2)
    for axes, (surface, place, theta, fields) in zip(panels, found, strict=False):
        field = fields.max(axis=0)
        shown, size = drawn.unit(float(field.max()))
        mesh = draw_map(axes, laid_flat(place, theta, field[None]), field / size)
        style.caption(axes, surface)
        axes.set_xlabel("angle about the axis [°]", size=style.TEXT)
        axes.set_ylabel(_along(surface), size=style.TEXT)
        style.colour_bar(figure, mesh, axes, f"{drawn.label} [{shown}]")
    if not found:
        style.note(panels[0], f"no {drawn.label.removesuffix(' depth')}")
    return figure


def draw_hodographs(dataset: xr.Dataset) -> Figure:
    """Draw the end of the force vector of each joint in the plane in which it varies most."""
    chosen = loaded_joints(dataset)
    drawn = [one for joint in chosen.joints if (one := hodograph(dataset, joint)) is not None]
    names = [one.joint for one in drawn]
    figure, panels = style.grid(dataset, f"{HODOGRAPHS.title}{chosen.which}", names, 2.9)
    for axes, one in zip(panels, drawn, strict=False):
        axes.set_aspect("equal", adjustable="datalim")
        axes.axhline(0.0, color=style.GREY, linewidth=0.6)
        axes.axvline(0.0, color=style.GREY, linewidth=0.6)
        axes.plot(*one.values, color=style.BLUE, linewidth=0.9)
        style.caption(axes, one.joint)
        style.finish(axes, *one.labels)
    return figure


def _along(surface: str) -> str:
    """Return the label of the second coordinate of a surface: height, radius of a face, or arc of a ball."""
    name = surface.rpartition(":")[2]
    return f"{'radius' if name.endswith('face') else 'arc' if name == 'ball' else 'height'} [mm]"


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


def draw_copies(dataset: xr.Dataset) -> Figure:
    """Draw at the angle of each copy a bar from its least to its largest error, and its mean."""
    found, figure = around(dataset), style.sheet(dataset, COPIES.title, 4.6)
    if not found:
        style.note(figure.subplots(), "nothing to draw")
        return figure
    every = figure.subplots(1, len(found), squeeze=False, subplot_kw={"projection": "polar"})[0]
    for axes, one in zip(every, found, strict=True):
        n = one.angles.size
        far = np.arange(n) == one.worst
        for chosen, colour, label in (
            (~far, style.BLUE, "range over time"),
            (far, style.VERMILION, "furthest from the mean"),
        ):
            bars = (values[chosen] for values in (one.angles, one.low, one.high))
            axes.vlines(*bars, color=colour, lw=3.0, label=label)
        axes.plot(one.angles, one.mean, "o", color=style.INK, ms=3.0, label="mean over time")
        axes.set_rlim(one.middle, float(one.high.max()) + 0.05 * one.span)
        axes.set_theta_zero_location("N")
        axes.set_theta_direction(-1)
        shown = np.unique(np.linspace(0, n - 1, min(n, 12)).astype(int))
        axes.set_xticks(one.angles[shown], [f"{one.name}[{k + 1}]" for k in shown], size=style.SMALL)
        axes.tick_params(axis="x", pad=12.0)
        axes.tick_params(axis="y", labelsize=style.SMALL)
        axes.set_rlabel_position(180.0 / n)  # between the first two
        axes.set_xlabel(f"error [{one.unit}]", size=style.SMALL)
    style.legend_below(figure, every[0], 3)
    return figure


COPIES_FIGURE: Final = Family(
    name=COPIES.still,
    title=COPIES.title,
    caption=COPIES.caption,
    needs=COPIES.needs,
    draw=draw_copies,
    shows=lambda dataset: bool(copies_of(dataset)),
)
