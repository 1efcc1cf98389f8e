"""What the reproduced figures have in common: panels, insets, colours of the clearances."""

from __future__ import annotations

from typing import Final, TypeAlias

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.views.series import series

STYLES: Final[tuple[tuple[str, style.LineStyle], ...]] = (
    (style.INK, style.SOLID),
    (style.BLUE, style.DASHED),
    (style.GREEN, style.DASHDOT),
    (style.ORANGE, style.DOTTED),
    (style.VERMILION, style.SOLID),
)
"""Colour and dash pattern of each clearance."""

Box: TypeAlias = tuple[float, float, float, float]
"""Left, bottom, width, height as shares of axes."""


def by_clearance(dataset: xr.Dataset, name: str, scale: float = 1.0) -> style.Curves:
    """Return one curve a clearance of a variable (clearance, time), the widest first: it lies below."""
    labels = [f"{value * 1e6:g} µm" for value in dataset["clearance"].values]
    return [
        (series(dataset.isel(clearance=i), name, scale), label, *STYLES[i % len(STYLES)])
        for i, label in reversed(list(enumerate(labels)))
    ]


def enlarge(axes: Axes, x: FloatArray, curves: style.Curves, span: tuple[float, float], place: Box) -> Axes:
    """Draw a stretch of the curves again, enlarged, in a corner of the axes.

    Parameters
    ----------
    axes
        Where the whole is drawn.
    x
        Abscissa, shape (n,).
    curves
        As drawn in ``axes``.
    span
        First and last abscissa of the stretch.
    place
        Left, bottom, width, height of the inset as shares of the axes.
    """
    left, bottom, width, height = place
    # A sheet below the inset keeps the curves from running through its labels.
    box = ((left - 0.14, bottom - 0.1), width + 0.15, height + 0.12)
    axes.add_patch(Rectangle(*box, transform=axes.transAxes, facecolor="white", zorder=4))
    inset = axes.inset_axes((left, bottom, width, height), zorder=5)
    inside = (x >= span[0]) & (x <= span[1])
    near: style.Curves = [(values[inside], label, colour, dash) for values, label, colour, dash in curves]
    style.lines(inset, x[inside], near, width=1.0)
    inset.tick_params(labelsize=style.SMALL - 1.5, color=style.GREY, length=2)
    inset.spines[:].set_color(style.GREY)
    inset.set_facecolor("#fdf8ee")
    axes.axvspan(*span, color="#f3e2c0", zorder=0)
    return inset


def first_cycle(dataset: xr.Dataset) -> xr.Dataset:
    """Return the rows of the first cycle."""
    return dataset.sel(time=dataset["time"].values <= float(dataset.attrs["cycle_period"]) * (1.0 + 1e-9))


def keep(dataset: xr.Dataset, *names: str) -> xr.Dataset:
    """Return a dataset with these variables only, attributes kept."""
    return dataset[list(names)]


def limits(axes: Axes, curves: style.Curves, quiet: NDArray[np.bool_], above: float = 0.35) -> None:
    """Scale the y axis to the rows that are ``quiet``, with room; impacts may leave it.

    ``above`` is the room above as a share of the range.
    """
    values = np.concatenate([values[quiet] for values, *_ in curves])
    values = values[np.isfinite(values)]
    if values.size:
        size = max(float(np.ptp(values)), 1e-12)
        axes.set_ylim(float(values.min()) - 0.35 * size, float(values.max()) + above * size)
