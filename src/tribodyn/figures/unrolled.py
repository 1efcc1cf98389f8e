"""Maps on the unrolled bushing: where to cut it open, and how to draw it."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.style import GREY, SMALL

CUTS: Final = (90.0, 270.0, 180.0, 0.0)
"""Angles at which the bushing may be cut open [deg], the preferred one first."""

# White where there is nothing, then steadily darker: a grey print keeps the order.
COLOURS: Final[Colormap] = LinearSegmentedColormap.from_list(
    "tribodyn_load", ["#ffffff", "#fde0a6", "#f7a25c", "#d9513c", "#8f1d4f", "#2a0a3c"]
)


def best_cut(theta: FloatArray, load: FloatArray) -> float:
    """Return the angle [deg] of :data:`CUTS` with the least load within 30° of it.

    Parameters
    ----------
    theta
        Angles [rad], shape (n_theta,).
    load
        What should not be cut, at each angle, shape (n_theta,).
    """
    size = np.nan_to_num(np.abs(load))
    near = [np.abs((np.rad2deg(theta) - cut + 180.0) % 360.0 - 180.0) <= 30.0 for cut in CUTS]
    loads = [float(size[window].max(initial=0.0)) for window in near]
    # What is below a hundredth of the peak may be cut: the preferred cut then wins.
    tidy = [0.0 if value <= 0.01 * size.max(initial=0.0) else value for value in loads]
    return CUTS[int(np.argmin(tidy))]


def rolled(theta: FloatArray, field: FloatArray, cut: float) -> tuple[FloatArray, FloatArray]:
    """Return angles [deg] growing from ``cut`` once around, and the field in that order.

    Parameters
    ----------
    theta
        Angles [rad], shape (n_theta,).
    field
        Values, shape (n_theta, ...).
    cut
        Where the bushing is cut open [deg].

    Returns
    -------
    tuple of arrays
        Shapes (n_theta + 1,) and (n_theta + 1, ...): the first point comes again at the end.
    """
    around = (np.rad2deg(theta) - cut) % 360.0
    order = np.argsort(around)
    angle = cut - 360.0 * (cut > 180.0) + around[order]
    return np.append(angle, angle[0] + 360.0), np.concatenate([field[order], field[order[:1]]])


def unloaded_middle(dataset: xr.Dataset, field: FloatArray) -> float:
    """Return the height [mm] below which nothing happens: a long empty middle is shown shortened.

    Parameters
    ----------
    dataset
        A result with ``z`` [m].
    field
        What is to be shown, shape (n_theta, n_z).

    Returns
    -------
    float
        Nothing above a hundredth of the peak lies at smaller distances from the middle; 0 where the empty
        part is less than half of the bushing.
    """
    distance = np.abs(dataset["z"].values) * 1e3
    loaded = distance[field.max(axis=0) > 0.01 * field.max(initial=0.0)]
    below = distance[distance < loaded.min()] if loaded.size else distance[:0]
    height = np.floor(2.0 * below.max()) / 2.0 if below.size else 0.0
    return float(height) if height >= 0.5 * distance.max() else 0.0


def z_label(empty: float) -> str:
    """Return the label of the axial axis."""
    return "z [mm]" if not empty else "z [mm]\n(middle shortened)"


def draw_map(
    axes: Axes, dataset: xr.Dataset, field: FloatArray, cut: float, largest: float, empty: float
) -> QuadMesh:
    """Draw a field on the unrolled bushing.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        A result with ``theta`` [rad] and ``z`` [m].
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
    angle, values = rolled(dataset["theta"].values, field, cut)
    if empty:
        _shorten_middle(axes, empty, float(z[-1]))
    mesh = axes.pcolormesh(
        angle, z, values.T, shading="gouraud", cmap=COLOURS, vmin=0.0, vmax=largest, rasterized=True
    )
    _angles(axes, float(angle[0]))
    _heights(axes, z, empty)
    return mesh


def shortened(z: FloatArray, empty: float, half: float) -> FloatArray:
    """Return where heights are drawn when the middle ``|z| < empty`` gets an eighth of the room.

    Parameters
    ----------
    z
        Heights, any shape.
    empty, half
        Where the middle ends and where the bushing ends, in the unit of ``z``; an ``empty`` of 0 leaves the
        heights as they are.
    """
    bend = (half - empty) / 7.0 if empty else 0.0
    near = z * (bend / empty) if empty else z
    return np.where(np.abs(z) < empty, near, np.sign(z) * (bend + np.abs(z) - empty))


def height_marks(half: float, empty: float) -> FloatArray:
    """Return round heights to label outside the middle, and both edges, increasing, in the unit given."""
    steps = np.asarray(MaxNLocator(nbins=3, steps=[1, 2, 5, 10]).tick_values(empty, half))
    marks = np.union1d(steps[(steps >= empty) & (steps < half)], [half])
    return np.asarray(np.union1d(-marks, marks) + 0.0)  # makes a minus zero a plain one


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


def threshold_line(axes: Axes, dataset: xr.Dataset, field: FloatArray, cut: float, level: float) -> None:
    """Draw the line on which the field equals ``level``."""
    angle, values = rolled(dataset["theta"].values, field, cut)
    if values.min() < level < values.max():
        heights = dataset["z"].values * 1e3
        axes.contour(angle, heights, values.T, levels=[level], colors=[GREY], linewidths=0.8)
