"""Maps on the unrolled bushing."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Colormap, LinearSegmentedColormap

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.style import GREY, SMALL
from tribodyn.views.unrolled import height_marks, rolled, shortened

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
