"""Common parts of the reproduced figures: panels, enlarged stretches, colours of the clearances."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.views.events import series

#: Colour and dash pattern of each clearance.
STYLES: Final[tuple[tuple[str, style.LineStyle], ...]] = (
    (style.INK, style.SOLID),
    (style.BLUE, style.DASHED),
    (style.GREEN, style.DASHDOT),
    (style.ORANGE, style.DOTTED),
    (style.VERMILION, style.SOLID),
)

#: Label of an axis with θ of Eqs. 44 and 48: the direction in which the contact pushes the trunnion.
ANGLE: Final = "bushing angle θ of the paper [°]"


def by_clearance(dataset: xr.Dataset, name: str, scale: float = 1.0) -> style.Curves:
    """Return one curve a clearance of a variable (clearance, time), the widest first: it lies below."""
    labels = [f"{value * 1e6:g} µm" for value in dataset["clearance"].values]
    return [
        (series(dataset.isel(clearance=i), name, scale), label, *STYLES[i % len(STYLES)])
        for i, label in reversed(list(enumerate(labels)))
    ]


def enlarge(axes: Axes, beside: Axes, x: FloatArray, curves: style.Curves, span: tuple[float, float]) -> None:
    """Draw a stretch of the curves again in a panel of its own, and shade it in the whole.

    ``axes``: where the whole is drawn; ``beside``: where the stretch is drawn, with its own scale; ``x``:
    abscissa, shape (n,); ``curves``: as drawn in ``axes``; ``span``: first and last abscissa of the stretch.
    """
    inside = (x >= span[0]) & (x <= span[1])
    near: style.Curves = [(values[inside], label, colour, dash) for values, label, colour, dash in curves]
    style.lines(beside, x[inside], near, width=1.0)
    style.finish(beside)
    beside.set_facecolor("#fdf8ee")
    beside.locator_params(axis="x", nbins=4)
    axes.axvspan(*span, color="#f3e2c0", zorder=0)


def first_cycle(dataset: xr.Dataset) -> xr.Dataset:
    """Return the rows of the first cycle."""
    return dataset.sel(time=dataset["time"].values <= float(dataset.attrs["cycle_period"]) * (1.0 + 1e-9))


def keep(dataset: xr.Dataset, *names: str) -> xr.Dataset:
    """Return a dataset with these variables only, attributes kept."""
    return dataset[list(names)]


def limits(axes: Axes, curves: style.Curves, quiet: NDArray[np.bool_]) -> None:
    """Scale the y axis to the rows that are ``quiet``, with room; impacts may leave it."""
    values = np.concatenate([values[quiet] for values, *_ in curves])
    values = values[np.isfinite(values)]
    if values.size:
        size = max(float(np.ptp(values)), 1e-12)
        axes.set_ylim(float(values.min()) - 0.35 * size, float(values.max()) + 0.35 * size)
