"""The mechanism without damping: the paper's first conclusion, in both formulations, with both frictions."""

import math
from collections.abc import Mapping
from itertools import product
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.papers.cheng_2022.runs import FORMULATIONS, PaperFigure, Runs

FRICTIONS: Final = ("moment", "traction")  #: Models of friction: the paper's, and the one of ``exact``.
TOLERANCES: Final = (1e-3, 1e-4, 1e-5, 1e-6)  #: Relative tolerances; the absolute ones shrink alike.
DRAWN: Final = TOLERANCES[:3]
#: A run that holds all that the paper shows, two cycles and a third.
THREE_CYCLES: Final = {"duration": f"{6.0 * math.pi} s", "impact_window": "50 ms", "impact_rows": 1000}
#: Absolute tolerances of the vane mechanism at the loosest relative one.
ATOL: Final = {
    "position": (2e-10, "m"),
    "tilt": (2e-8, "rad"),
    "velocity": (2e-6, "m/s"),
    "tilt_rate": (2e-4, "rad/s"),
}
_SHOWN: Final = 0.3  #: Time after the first reversal until which a run goes on [s].
_ROWS: Final = 20_000  #: Samples kept of that time: every step, unless a run takes more.
_CYCLE: Final = 2.0 * math.pi  #: Length of a drive cycle [s], which the figure shows.
_WHOLE: Final = {"duration": f"{_CYCLE} s", "impact_window": f"{0.5 * _CYCLE} s"}
_BINS: Final = np.linspace(0.0, _CYCLE, 400)  #: Times between which the largest force is drawn [s].
_LOOKS: Final = ((style.GREEN, style.SOLID), (style.BLUE, style.DASHED), (style.VERMILION, style.DOTTED))


def undamped(
    runs: Runs, formulation: str, friction: str, rtol: float, more: Mapping[str, object] | None = None
) -> xr.Dataset:
    """Return the mechanism with the law of Kogut and Etsion alone, to 0.3 s after the first reversal.

    ``formulation``, ``friction``: ``paper`` or ``exact``, ``moment`` or ``traction``; ``rtol``: relative
    tolerance; ``more``: other keys of the table ``run``; by default every run starts in equilibrium.
    """
    scale = rtol / TOLERANCES[0]
    settings = {
        "start": "equilibrium",
        "duration": f"{math.pi + _SHOWN} s",
        "impact_window": f"{_SHOWN} s",
        "impact_rows": _ROWS,
        **(more or {}),
    }
    changes: dict[str, object] = {
        "mechanism.formulation": formulation,
        "contact.law": "ke",
        "joint.friction": friction,
        "solver.rtol": rtol,
        **{f"solver.atol.{name}": f"{scale * value:.6g} {unit}" for name, (value, unit) in ATOL.items()},
        **{f"run.{name}": value for name, value in settings.items()},
    }
    return runs.run("vsv", changes)


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return the contact force [N] over a cycle of all runs, whatever the formulation."""
    combinations = list(product(FORMULATIONS, FRICTIONS, DRAWN))
    results = [undamped(runs, name, friction, rtol, _WHOLE) for name, friction, rtol in combinations]
    longest = max(one.sizes["time"] for one in results)
    shape = (len(FORMULATIONS), len(FRICTIONS), len(DRAWN), longest)
    time, force = np.full((2, len(results), longest), np.nan)
    for k, one in enumerate(results):
        time[k, : one.sizes["time"]] = one["time"].values
        force[k, : one.sizes["time"]] = np.hypot(one["F_cx"].values, one["F_cy"].values)
    axes = ("formulation", "friction", "rtol", "row")
    return xr.Dataset(
        {
            "time": (axes, time.reshape(shape), {"units": "s", "long_name": "time"}),
            "force": (axes, force.reshape(shape), {"units": "N", "long_name": "contact force"}),
            "ended": (
                axes[:3],
                np.array([bool(one.attrs["failure"]) for one in results]).reshape(shape[:3]),
                {"units": "1", "long_name": "whether the run ended where the contact law ends"},
            ),
        },
        coords={"formulation": list(FORMULATIONS), "friction": list(FRICTIONS), "rtol": list(DRAWN)},
        attrs={name: results[0].attrs[name] for name in ("title", "clearance", "contact_law")},
    )


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the size of the contact force over a cycle: a panel a combination, a curve a tolerance."""
    figure = style.sheet(dataset, "The dry mechanism without damping, over one cycle", 5.0)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for axes, (formulation, friction) in zip(panels.flat, product(FORMULATIONS, FRICTIONS), strict=True):
        _panel(axes, dataset.sel(formulation=formulation, friction=friction))
        style.caption(axes, f"formulation {formulation}, friction as a {friction}")
    for axes in panels[-1]:
        axes.set_xlabel("time [s]", size=style.SMALL)
    style.legend_below(figure, panels[0, 0], 3)
    return figure


def envelope(time: FloatArray, force: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the middle times of the bins :data:`_BINS` that hold samples, and the largest force in each."""
    bins = np.digitize(time, _BINS)
    held = [k for k in range(1, _BINS.size) if np.isfinite(force[bins == k]).any()]
    middle = 0.5 * (_BINS[:-1] + _BINS[1:])
    return middle[np.array(held) - 1], np.array([np.nanmax(force[bins == k]) for k in held])


def _panel(axes: Axes, runs: xr.Dataset) -> None:
    """Draw the runs of one combination; a cross marks where one left the range of the contact law."""
    for rtol, (colour, dash) in zip(runs["rtol"].values, _LOOKS, strict=True):
        one = runs.sel(rtol=rtol)
        time, force = envelope(one["time"].values, one["force"].values)
        axes.semilogy(
            time, force, color=colour, linestyle=dash, linewidth=0.8, label=f"relative tolerance {rtol:.0e}"
        )
        if bool(one["ended"]):
            axes.plot(time[-1], force[-1], "x", color=colour, markersize=6)
    axes.set_ylim(1.0, 2e6)
    style.finish(axes, y_label="largest force [N]")


UNDAMPED: Final = PaperFigure("undamped", "the mechanism without damping", data, draw)
