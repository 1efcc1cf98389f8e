"""Energy balances: what each term amounts to, and what they miss."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.figure_family import Family
from tribodyn.views.energy_balance import EnergyBalance
from tribodyn.views.events import finite, peak, series
from tribodyn.views.playback import time_unit

TITLE: Final = "Energy balances"
LOOKS: Final = (
    (style.INK, style.SOLID),
    (style.BLUE, style.DASHED),
    (style.VERMILION, style.DASHDOT),
    (style.GREEN, style.DOTTED),
    (style.ORANGE, style.SOLID),
    (style.PURPLE, style.DASHED),
)


def family(balances: Sequence[EnergyBalance]) -> Family:
    """Return the figure of the balances of a mechanism."""
    return Family(
        name="energy",
        title=TITLE,
        caption=(
            "A way to check the integration: what was put in, stored and turned into heat, and what the sum "
            "misses, for everything that moves and for the motion in the clearance, where an error in the "
            "small contact heat cannot hide."
        ),
        needs=("time", *(balance.residual for balance in balances)),
        draw=partial(draw, balances),
    )


def draw(balances: Sequence[EnergyBalance], dataset: xr.Dataset) -> Figure:
    """Draw the histories of the large terms [J] and the sizes of all of them, for each balance."""
    figure = style.sheet(dataset, TITLE, 0.6 + 3.1 * len(balances))
    grid = figure.subplots(len(balances), 2, width_ratios=(1.35, 1.0), squeeze=False)
    time_name, time_scale = time_unit(dataset)
    for (history, sizes), balance in zip(grid, balances, strict=True):
        terms = {name: label for name, label in balance.terms.items() if name in dataset}
        unit, scale = _unit(dataset, terms)
        _history(history, dataset, balance, terms, (time_scale, scale))
        _sizes(sizes, dataset, terms | {balance.residual: "residual"})
        style.caption(history, balance.title)
        style.finish(history, f"time [{time_name}]", f"energy [{unit}]")
        style.caption(sizes, _verdict(dataset, balance), side="right")
    return figure


def _unit(dataset: xr.Dataset, terms: Mapping[str, str]) -> tuple[str, float]:
    """Return the unit in which the largest term of a balance reads well, and the factor to it."""
    largest = max(peak(series(dataset, name)) for name in terms)
    return next(
        ((u, f) for u, f in (("J", 1.0), ("mJ", 1e3), ("µJ", 1e6)) if largest * f >= 1.0), ("nJ", 1e9)
    )


def _history(
    axes: Axes,
    dataset: xr.Dataset,
    balance: EnergyBalance,
    terms: Mapping[str, str],
    scales: tuple[float, float],
) -> None:
    """Draw the terms that are seen beside the largest, at most six, and always the residual."""
    time, scale = series(dataset, "time", scales[0]), scales[1]
    others = sorted(terms, key=lambda name: -peak(series(dataset, name)))
    largest = peak(series(dataset, others[0]))
    for name, (colour, dash) in zip(others, LOOKS, strict=False):
        values = series(dataset, name, scale)
        if finite(values).size and peak(values) >= 0.01 * largest * scale:
            axes.plot(time, values, color=colour, linestyle=dash, linewidth=1.3, label=terms[name])
    residual = series(dataset, balance.residual, scale)
    axes.plot(time, residual, color=style.GREY, linewidth=2.6, alpha=0.55, label="residual")
    if finite(series(dataset, others[0])).size:
        axes.legend(
            fontsize=style.SMALL - 0.5, frameon=False, loc="best", handlelength=3.0, labelspacing=0.25
        )
    else:
        style.note(axes, "nothing computed")


def _sizes(axes: Axes, dataset: xr.Dataset, terms: Mapping[str, str]) -> None:
    """Draw the largest size of each term on a logarithmic axis, with its number."""
    sizes = np.array([peak(series(dataset, name)) for name in terms])
    colours = [style.VERMILION if name.endswith("residual") else style.PALE for name in terms]
    rows = np.arange(len(terms))
    floor = _floor(sizes)
    bars = axes.barh(rows, np.maximum(sizes, floor), color=colours, height=0.7)
    bars[-1].set_hatch("////")
    bars[-1].set_edgecolor("white")
    axes.set_xscale("log")
    axes.set_xlim(floor, max(sizes.max() * 30.0, floor * 1e3))
    axes.minorticks_off()
    for row, size in enumerate(sizes.tolist()):
        place = 1.25 * max(size, floor)
        axes.text(place, row, _joule(size), va="center", size=style.SMALL - 0.5, color=style.INK)
    style.finish(axes, "largest size [J]")
    axes.set_yticks(rows, list(terms.values()), size=style.SMALL)
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()


def _floor(sizes: FloatArray) -> float:
    """Return the beginning of the logarithmic axis [J]."""
    positive = sizes[sizes > 0.0]
    return float(10.0 ** np.floor(np.log10(positive.min()) - 0.3)) if positive.size else 1e-9


def _joule(size: float) -> str:
    """Return an energy with a fitting prefix."""
    for unit, scale in (("J", 1.0), ("mJ", 1e3), ("µJ", 1e6), ("nJ", 1e9)):
        if size * scale >= 1.0:
            return f"{size * scale:.3g} {unit}"
    return "0" if size == 0.0 else f"{size:.1e} J"


def _verdict(dataset: xr.Dataset, balance: EnergyBalance) -> str:
    """Return the residual in words."""
    value = dataset.attrs.get(balance.attribute)
    if not isinstance(value, float) or not np.isfinite(value):
        return "residual not known"
    return f"residual {100.0 * value:.2g} % of {balance.yardstick}"
