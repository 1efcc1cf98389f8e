"""Figure 15: contact pressure at three vane angles in both directions."""

from __future__ import annotations

from typing import Final

import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.pressure import FAMILY
from tribodyn.papers.cheng_2022.base import PaperFigure
from tribodyn.papers.cheng_2022.layout import keep
from tribodyn.papers.cheng_2022.runs import Runs


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return the pressure [Pa] at the six positions."""
    return keep(runs.vsv(formulation, 20e-6), "pressure")


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the six maps on the unrolled bushing."""
    return FAMILY.draw(dataset)


PRESSURE: Final = PaperFigure(15, "contact pressure at six positions of the vane", data, draw)
