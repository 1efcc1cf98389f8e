"""Figures 8 and 9: the journal of section 4 under a steady load, dry and in oil, with both laws."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.figures import style
from tribodyn.papers.cheng_2022.runs import LAWS, PaperFigure, Runs, joined, keep
from tribodyn.views.playback import series

_LOOKS: Final[dict[tuple[str, str], tuple[str, style.LineStyle]]] = {
    ("rsdc", "x"): (style.BLUE, style.SOLID),
    ("rsdc", "y"): (style.GREEN, style.SOLID),
    ("ke", "x"): (style.VERMILION, style.DASHED),
    ("ke", "y"): (style.GREY, style.DASHED),
}


#: Quantities of the paper before their axes, and what a joint of a mechanism calls them.
_NAMES: Final = {"e_": "displacement", "F_c": "contact_force", "F_o": "film_force"}
_BEARING: Final = "bearing"


def run_of(runs: Runs, name: str, changes: Mapping[str, object]) -> xr.Dataset:
    """Return a run of a journal with names of the paper: motion and forces of its bearing, its energies."""
    run = runs.run(name, {f"joints.{_BEARING}.clearance.bulk": "none", **changes})
    one = run.sel(joint=_BEARING, drop=True)
    vectors = {before: of for before, of in _NAMES.items() if of in one}
    columns = {
        f"{before}{axis}": one[of].sel(axis=axis, drop=True)
        for before, of in vectors.items()
        for axis in "xy"
    }
    rates = {f"e_{axis}_dot": one["relative_velocity"].sel(axis=axis, drop=True) for axis in "xy"}
    energies = {str(key): run[key] for key in run.data_vars if str(key).startswith("energy_")}
    attributes = {**run.attrs, "clearance": float(one["clearance"])}
    return xr.Dataset({**columns, **rates, **energies, "gap_min": one["gap_min"]}, attrs=attributes)


def over_laws(runs: Runs, name: str) -> xr.Dataset:
    """Return the runs of a journal with both laws of section 4 along a dimension ``law``."""
    index = xr.Variable("law", np.array(LAWS), {"units": "1", "long_name": "contact law"})
    return joined([run_of(runs, name, {"contact.law": law}) for law in LAWS], index)


def dry_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return displacement [m] and contact force [N]; the formulations of the mechanism do not matter here."""
    return keep(over_laws(runs, "journal-dry"), "e_x", "e_y", "F_cx", "F_cy")


def oil_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return displacement [m], force of the film and contact force [N]."""
    return keep(over_laws(runs, "journal-oil"), "e_x", "e_y", "F_ox", "F_oy", "F_cx", "F_cy")


def _panel(axes: Axes, dataset: xr.Dataset, name: str, scale: float, heading: str, unit: str) -> None:
    """Draw both components of a quantity for both laws over time [ms]."""
    curves: style.Curves = [
        (series(dataset.sel(law=law), f"{name}{axis}", scale), f"{name}{axis}, {law.upper()}", *look)
        for (law, axis), look in _LOOKS.items()
    ]
    style.lines(axes, series(dataset, "time", 1e3), curves, width=1.0)
    style.caption(axes, heading)
    style.finish(axes, y_label=unit)
    axes.legend(frameon=False, fontsize=style.SMALL, ncols=1, loc="upper left", bbox_to_anchor=(1.0, 1.0))


def draw_dry(dataset: xr.Dataset) -> Figure:
    """Draw Figure 8."""
    figure = style.sheet(dataset, "Fig. 8  Journal bearing with dry friction", 5.0)
    deviation, force = figure.subplots(2, 1, sharex=True)
    _panel(deviation, dataset, "e_", 1e6, "(a) deviations of the journal", "deviation [µm]")
    _panel(force, dataset, "F_c", 1.0, "(b) contact forces", "force [N]")
    force.set_xlabel("time [ms]")
    return figure


def draw_oil(dataset: xr.Dataset) -> Figure:
    """Draw Figure 9."""
    figure = style.sheet(dataset, "Fig. 9  Journal bearing with oil lubrication", 6.6)
    deviation, film, contact = figure.subplots(3, 1, sharex=True)
    _panel(deviation, dataset, "e_", 1e6, "(a) deviations of the journal", "deviation [µm]")
    _panel(film, dataset, "F_o", 1.0, "(b) oil film forces", "force [N]")
    _panel(contact, dataset, "F_c", 1.0, "(c) contact forces", "force [N]")
    contact.set_xlabel("time [ms]")
    return figure


DRY: Final = PaperFigure("fig8", "dry journal: deviations and contact forces", dry_data, draw_dry)
OIL: Final = PaperFigure("fig9", "oiled journal: deviations, film and contact forces", oil_data, draw_oil)
