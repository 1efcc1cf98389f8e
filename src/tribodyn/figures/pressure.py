"""Contact pressure on the unrolled bushing at the snapshots."""

from string import ascii_lowercase
from typing import Final, TypeAlias

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.figure_family import Family
from tribodyn.figures.style import GREY, SMALL, TEXT, caption, note, sheet
from tribodyn.views.bushing import (
    WALL,
    best_cut,
    height_marks,
    rolled,
    shortened,
    unloaded_middle,
    wall_angles,
    z_label,
)
from tribodyn.views.events import series, signed

# White where there is nothing, then steadily darker: a grey print keeps the order.
COLOURS: Final[Colormap] = LinearSegmentedColormap.from_list(
    "tribodyn_load", ["#ffffff", "#fde0a6", "#f7a25c", "#d9513c", "#8f1d4f", "#2a0a3c"]
)


def draw_map(
    axes: Axes,
    dataset: xr.Dataset,
    theta: FloatArray,
    field: FloatArray,
    cut: float,
    largest: float,
    empty: float,
) -> QuadMesh:
    """Draw a field on the unrolled bushing.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        A result with ``z`` [m].
    theta
        Angles of the nodes as the axis counts them [rad], shape (n_theta,).
    field
        Values in the unit of the colour bar, shape (n_theta, n_z).
    cut
        Where the bushing is cut open [deg].
    largest
        Value of the darkest colour.
    empty
        From :func:`unloaded_middle` [mm].
    """
    z = dataset["z"].values * 1e3
    angle, values = rolled(theta, field, cut)
    if empty:
        _shorten_middle(axes, empty, float(z[-1]))
    mesh = axes.pcolormesh(
        angle, z, values.T, shading="gouraud", cmap=COLOURS, vmin=0.0, vmax=largest, rasterized=True
    )
    _angles(axes, float(angle[0]))
    _heights(axes, z, empty)
    return mesh


def _shorten_middle(axes: Axes, empty: float, half: float) -> None:
    """Give the middle ``|z| < empty`` an eighth of the height, and the two edge bands the rest."""
    bend = (half - empty) / 7.0
    shrink = bend / empty

    def forward(z: FloatArray) -> FloatArray:
        return shortened(z, empty, half)

    def backward(y: FloatArray) -> FloatArray:
        return np.where(np.abs(y) < bend, y / shrink, np.sign(y) * (empty + np.abs(y) - bend))

    axes.set_yscale("function", functions=(forward, backward))
    axes.axhspan(
        -empty, empty, facecolor="#f4f4f4", edgecolor="#cfcfcf", hatch="////", linewidth=0.0, zorder=2
    )


def _angles(axes: Axes, start: float) -> None:
    """Give the map its angular axis, labelled with bushing angles from 0° to 360°."""
    first = 45.0 * np.ceil(start / 45.0 - 1e-9)
    ticks = first + 45.0 * np.arange(9)
    axes.set_xlim(start, start + 360.0)
    axes.set_xticks(ticks[::2], [f"{tick % 360:.0f}" for tick in ticks[::2]])
    axes.set_xticks(ticks[1::2], minor=True)
    axes.tick_params(labelsize=SMALL, color=GREY, length=3)
    axes.tick_params(which="minor", color=GREY, length=2)


def _heights(axes: Axes, z: FloatArray, empty: float) -> None:
    """Give the map its axial axis, with room beyond the bushing's edges so that what lies on them is seen."""
    half = float(z[-1])
    room = 0.2 * (half - empty)
    ticks = height_marks(half, empty)
    axes.set_ylim(-half - room, half + room)
    axes.set_yticks(ticks, [f"{tick:.3g}".replace("-", "−") for tick in ticks])
    axes.set_yticks([], minor=True)
    for edge in (-half, half):
        axes.axhline(edge, color=GREY, linewidth=0.8)
    axes.spines[:].set_visible(False)


def threshold_line(
    axes: Axes, dataset: xr.Dataset, theta: FloatArray, field: FloatArray, cut: float, level: float
) -> None:
    """Draw the line on which the field equals ``level``."""
    angle, values = rolled(theta, field, cut)
    if values.min() < level < values.max():
        heights = dataset["z"].values * 1e3
        axes.contour(angle, heights, values.T, levels=[level], colors=[GREY], linewidths=0.8)


TITLE: Final = "Contact pressure on the unrolled bushing"
Panels: TypeAlias = NDArray[np.object_]
CONTACT_ZONE: Final = 0.05
"""The contact zone is where the pressure exceeds this share of its peak; the share is ours."""


def draw(
    dataset: xr.Dataset, title: str = TITLE, theta: FloatArray | None = None, label: str = WALL
) -> Figure:
    """Draw the pressure [MPa] of each snapshot: forward motion at the left, reverse at the right.

    Parameters
    ----------
    dataset
        A result with snapshots of the pressure.
    title
        Title of the sheet.
    theta, label
        Angles of the nodes [rad], shape (n_theta,), and what the axis calls them; by default those of the
        bushing's wall.
    """
    theta = wall_angles(dataset) if theta is None else theta
    figure = sheet(dataset, title, 6.2)
    places = _places(dataset)
    rows = max(3, 1 + max((row for row, _ in places), default=0))
    panels = figure.subplots(rows, 2, sharex=True, sharey=True, squeeze=False)
    pressure = np.nan_to_num(dataset["pressure"].values) * 1e-6
    largest = float(pressure.max(initial=0.0)) or 1.0
    cut = best_cut(theta, pressure.max(axis=(0, 2), initial=0.0))
    empty = unloaded_middle(dataset, pressure.max(axis=0, initial=0.0))
    for index, place in enumerate(places):
        mesh = draw_map(panels[place], dataset, theta, pressure[index], cut, largest, empty)
        _describe(panels[place], dataset, theta, index)
        level = CONTACT_ZONE * pressure[index].max()
        threshold_line(panels[place], dataset, theta, pressure[index], cut, level)
    _blank(panels, set(places))
    _label(panels, z_label(empty), label)
    if places:
        bar = figure.colorbar(mesh, ax=panels, shrink=0.6, aspect=30, pad=0.02)
        bar.set_label("contact pressure [MPa]", size=TEXT)
        bar.ax.tick_params(labelsize=SMALL)
        bar.outline.set_visible(False)
    return figure


def _places(dataset: xr.Dataset) -> list[tuple[int, int]]:
    """Return row and column of each snapshot.

    Forward snapshots run down the left column, reverse ones up the right column, so that a row holds
    one vane position in both directions.
    """
    forward = series(dataset, "snapshot_direction") > 0.0
    rows = max(3, int(forward.sum()), int((~forward).sum()))
    down, up = iter(range(rows)), iter(range(rows - 1, -1, -1))
    return [(next(down), 0) if ahead else (next(up), 1) for ahead in forward]


def _describe(axes: Axes, dataset: xr.Dataset, theta: FloatArray, index: int) -> None:
    """Write above a map which vane position it is and where its peak lies."""
    field = np.nan_to_num(dataset["pressure"].values[index]) * 1e-6
    angle = float(np.rad2deg(dataset["snapshot_theta_v"].values[index]))
    at_theta, at_z = np.unravel_index(int(field.argmax()), field.shape)
    around = float(np.rad2deg(theta[at_theta])) % 360.0
    z = float(dataset["z"].values[at_z]) * 1e3
    caption(axes, f"({ascii_lowercase[index % 26]})  {angle:.1f}°")
    text = f"peak {field.max():.3g} MPa at {around:.0f}°, {signed(z)} mm"
    axes.text(1.0, 1.04, text, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)


def _blank(panels: Panels, used: set[tuple[int, int]]) -> None:
    """Say in the panels without a snapshot that it was not reached."""
    for place, axes in np.ndenumerate(panels):
        if place not in used:
            note(axes, "not reached in this run")
            axes.tick_params(labelsize=SMALL, color=GREY, length=3)
            axes.spines[:].set_color("#dddddd")


def _label(panels: Panels, z_text: str, label: str) -> None:
    """Write the axis labels at the outer panels, and the direction above the columns."""
    for axes in panels[:, 0]:
        axes.set_ylabel(z_text, size=TEXT)
    for axes in panels[-1]:
        axes.set_xlabel(label, size=TEXT)
    for axes, way in zip(
        panels[0], ("forward, vane angle growing", "reverse, vane angle falling"), strict=True
    ):
        axes.annotate(
            way,
            (0.5, 1.0),
            xycoords="axes fraction",
            xytext=(0, 20),
            textcoords="offset points",
            ha="center",
            size=TEXT,
            weight="bold",
        )


FAMILY: Final = Family(
    name="pressure",
    title=TITLE,
    caption=(
        "The bushing cut open and laid flat, one map for each vane position; grey lines enclose what lies "
        "above 5 % of the peak. Rows compare the two directions of motion at one vane angle."
    ),
    needs=("pressure", "theta", "z", "snapshot_theta_v", "snapshot_direction"),
    draw=draw,
)
