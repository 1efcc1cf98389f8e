"""Types of a family of figures and of moving pictures."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import xarray as xr
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.views.gltf import Solid


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


class MovingFigure(Protocol):
    """A figure that changes with time."""

    figure: Figure

    def show(self, frame: int) -> None:
        """Draw the state at one of the times."""


@dataclass(frozen=True)
class Animation:
    """Motion of a mechanism, as a film and as solids in space.

    Attributes
    ----------
    film
        From a result and times [s], shape (n_t,).
    solids
        Likewise the bodies with their motion, and the axis of the drawing that points upwards.
    """

    film: Callable[[xr.Dataset, FloatArray], MovingFigure]
    solids: Callable[[xr.Dataset, FloatArray], tuple[list[Solid], str]]
