"""Distributions of numbers over very many builds, with their quantiles and builds simulated as a whole."""

from collections.abc import Sequence
from typing import Protocol

import xarray as xr
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style

_BINS = 80
_HEIGHT = 2.1


class Distributed(Protocol):
    """A number over builds, see :class:`tribodyn.studies.builds.BuildNumber`."""

    @property
    def label(self) -> str:
        """Words for it, with its unit."""

    @property
    def quantiles(self) -> FloatArray:
        """Quantiles, the median first."""

    @property
    def drawn(self) -> FloatArray:
        """Values of builds drawn."""

    @property
    def together(self) -> FloatArray:
        """Values of builds simulated as a whole."""


def draw(numbers: Sequence[Distributed], title: str) -> Figure:
    """Draw the histogram of each number, its quantiles as lines, and builds as a whole as marks."""
    figure = style.sheet(xr.Dataset(attrs={"title": title}), "Builds", 0.8 + _HEIGHT * len(numbers))
    for axes, one in zip(figure.subplots(len(numbers), 1, squeeze=False)[:, 0], numbers, strict=True):
        axes.hist(one.drawn, bins=_BINS, density=True, color=style.BLUE, alpha=0.5, label="builds drawn")
        for place, value in enumerate(one.quantiles):
            label = "median, 90, 99 and 99.7 %" if place == 0 else "_"
            axes.axvline(
                float(value), color=style.INK, lw=0.9, ls=style.DASHED if place else style.SOLID, label=label
            )
        if one.together.size:
            marks = dict(color=style.VERMILION, ms=5.0, clip_on=False)
            axes.plot(one.together, 0.0 * one.together, "|", label="builds as a whole", **marks)
        style.finish(axes, one.label, "density")
        style.legend(axes, 3)
    return figure
