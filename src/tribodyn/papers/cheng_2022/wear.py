"""Figure 19: wear depth after 100 to 400 cycles with five clearances."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.pressure import draw_map
from tribodyn.figures.style import SMALL, TEXT, Curves, caption, colour_bar, finish, lines, sheet
from tribodyn.papers.cheng_2022.layout import ANGLE, STYLES
from tribodyn.papers.cheng_2022.runs import PaperFigure, Runs, on_grid, over_clearances
from tribodyn.views.bushing import Unrolled, unrolled

CYCLES: Final = (100, 200, 300, 400)
DIVISOR: Final = 65.0  #: The bare number that the paper's depths come out with, see Eq. 47 in the errata.
_PICOMETRE: Final = 1e-12


def worn(
    runs: Runs, formulation: str, clearance: float, cycles: int, changes: Mapping[str, object] | None = None
) -> xr.Dataset:
    """Return a wear campaign in the paper's convention, with some keys of the case changed."""
    campaign = {"wear.cycles": cycles, "wear.paper_hardness_divisor": DIVISOR}
    return runs.vsv(formulation, clearance, {**campaign, **(changes or {})})


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return wear depth [m] by clearance, cycles, angle and height."""
    index = xr.Variable("cycles", np.array(CYCLES), {"long_name": "drive cycles", "units": "1"})
    rows = []
    for clearance in runs.clearances:
        depths = [worn(runs, formulation, clearance, cycles)[["wear_depth"]] for cycles in CYCLES]
        rows.append(xr.concat(depths, dim=index, combine_attrs="override"))
    finest = max(rows, key=lambda row: row.sizes["theta"])
    return over_clearances([on_grid(row, finest["theta"].values, finest["z"].values) for row in rows])


def draw(dataset: xr.Dataset) -> Figure:
    """Draw a row a clearance: the worn bushing laid flat, and its deeper edge as it wears."""
    figure = sheet(dataset, "Fig. 19  Wear depth of the bushing with different clearances", 9.6)
    panels = figure.subplots(dataset.sizes["clearance"], 2, sharex=True, width_ratios=(1.3, 1.0))
    depth = dataset["wear_depth"].values / _PICOMETRE
    laid = unrolled(dataset, depth[:, -1], theta=dataset["theta"].values)
    for i, (plan, profile) in enumerate(panels):
        mesh = draw_map(plan, laid, depth[i, -1], float(depth.max()))
        plan.set_ylabel(laid.label, size=TEXT)
        caption(plan, f"({'abcde'[i]}) clearance {dataset['clearance'].values[i] * 1e6:g} µm, 400 cycles")
        _profiles(profile, laid, depth[i])
        profile.set_ylim(0.0, 1.05 * float(depth.max()))
    for axes in panels[-1]:
        axes.set_xlabel(ANGLE, size=TEXT)
    colour_bar(figure, mesh, panels[:, 0], "wear depth [pm]", shrink=0.5, location="bottom")
    return figure


def _profiles(axes: Axes, laid: Unrolled, depth: FloatArray) -> None:
    """Draw the depth along the deeper edge after 100 to 400 cycles."""
    edge = -1 if depth[-1, :, -1].max() >= depth[-1, :, 0].max() else 0
    curves: Curves = []
    for k, cycles in enumerate(CYCLES):
        curves.append((laid.turned(depth[k])[:, edge], f"{cycles} cycles", *STYLES[k]))
    lines(axes, laid.angle, curves, width=1.0)
    axes.legend(frameon=False, fontsize=SMALL - 1)
    caption(axes, f"{'top' if edge else 'bottom'} edge")
    finish(axes, y_label="depth [pm]")


WEAR: Final = PaperFigure("fig19", "wear depth with different clearances", data, draw)
