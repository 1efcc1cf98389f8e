"""What a family of figures is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import xarray as xr
from matplotlib.figure import Figure


@dataclass(frozen=True)
class Family:
    """One figure that can be drawn from any result holding what it needs.

    Attributes
    ----------
    name
        File name without ``.png``.
    title
        What it shows.
    caption
        How to read it, in a sentence or two.
    needs
        Names of the variables without which it is not drawn.
    draw
        Draws it. A result may be short, empty or hold NaN: what is there is drawn and the rest is said.
    """

    name: str
    title: str
    caption: str
    needs: tuple[str, ...]
    draw: Callable[[xr.Dataset], Figure]

    def drawable(self, dataset: xr.Dataset) -> bool:
        """Whether the result holds the variables this figure needs."""
        return all(name in dataset.variables for name in self.needs)
