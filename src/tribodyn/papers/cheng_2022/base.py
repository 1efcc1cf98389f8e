"""What a reproduced figure is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import xarray as xr
from matplotlib.figure import Figure

from tribodyn.papers.cheng_2022.runs import Runs


@dataclass(frozen=True)
class PaperFigure:
    """One figure of the paper, made from our own runs, or one that it should have.

    Attributes
    ----------
    name
        Name on the command line and of the files: ``fig12``, or what it shows where the paper has none.
    title
        What it shows.
    data
        Returns the data, given the runs and the formulation (``paper`` or ``exact``).
    draw
        Draws it from its data, with the panels of the original.
    """

    name: str
    title: str
    data: Callable[[Runs, str], xr.Dataset]
    draw: Callable[[xr.Dataset], Figure]
