"""Figures 10 and 11, the vane without clearance; and its error split by joint: the paper's factor seven."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.figures import style
from tribodyn.papers.cheng_2022.claims.all_joints import ONE, SEVEN, means
from tribodyn.papers.cheng_2022.claims.base import Trial
from tribodyn.papers.cheng_2022.runs import CLEARANCES, JOINTS, PaperFigure, Runs, first_cycle, keep
from tribodyn.views.playback import series

DEGREES: Final = float(np.rad2deg(1.0))


def crank_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return angle [rad] and speed [rad/s] of the crank over a cycle."""
    return keep(first_cycle(runs.vsv(formulation, 20e-6)), "theta_a", "omega_a")


def vane_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return angle [rad] and speed [rad/s] of the vane without clearance over a cycle."""
    return keep(first_cycle(runs.vsv(formulation, 20e-6)), "theta_v_ideal", "omega_v_ideal")


def _angle_and_speed(dataset: xr.Dataset, title: str, angle: str, speed: str, body: str) -> Figure:
    """Draw an angle [°] and a speed [°/s] over time with an axis each."""
    figure = style.sheet(dataset, title, 3.4)
    left = figure.subplots()
    right = left.twinx()
    time = series(dataset, "time")
    style.lines(left, time, [(series(dataset, angle, DEGREES), f"{body} angle", style.BLUE, style.SOLID)])
    style.lines(
        right, time, [(series(dataset, speed, DEGREES), f"{body} speed", style.VERMILION, style.DASHED)]
    )
    style.finish(left, "time [s]", f"{body} angle [°]")
    style.finish(right, y_label=f"{body} speed [°/s]")
    right.spines["right"].set_visible(True)
    right.grid(False)
    figure.legend(loc="outside lower center", ncols=2, frameon=False, fontsize=style.SMALL)
    return figure


def draw_crank(dataset: xr.Dataset) -> Figure:
    """Draw Figure 10."""
    return _angle_and_speed(dataset, "Fig. 10  Crank angle and speed", "theta_a", "omega_a", "crank")


def draw_vane(dataset: xr.Dataset) -> Figure:
    """Draw Figure 11."""
    return _angle_and_speed(
        dataset, "Fig. 11  Vane angle and speed", "theta_v_ideal", "omega_v_ideal", "vane"
    )


CRANK: Final = PaperFigure("fig10", "driving angle and speed of the crank", crank_data, draw_crank)
VANE: Final = PaperFigure("fig11", "rotation angle and speed of the vane", vane_data, draw_vane)


_ENDS: Final = (CLEARANCES[0], CLEARANCES[-1])
_WAYS: Final = ("forward", "back")
_TOGETHER: Final = "all together"
_ADDED: Final = "the six added up"
#: Error that section 5.3 gives for all joints [deg].
_PAPER: Final = {CLEARANCES[0]: 0.14, CLEARANCES[-1]: 0.301}
_LOOKS: Final = {"forward": (style.BLUE, -0.2, ""), "back": (style.ORANGE, 0.2, "///")}


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return the mean error of the vane angle in smooth motion [deg], by clearance, joint and direction.

    The mechanism is a drawing, ``vsv-joints``: it has no formulation.
    """
    trial, parts = Trial(runs, "exact"), (*((joint,) for joint in JOINTS), JOINTS)
    found = np.array([[means(trial, clearance, part)[1:] for part in parts] for clearance in _ENDS])
    about = {"units": "degree", "long_name": "mean size of the vane-angle error in smooth motion"}
    return xr.Dataset(
        {"error": (("clearance", "real", "way"), found, about)},
        coords={
            "clearance": ("clearance", list(_ENDS), {"units": "m", "long_name": "radial clearance"}),
            "real": [*JOINTS, _TOGETHER],
            "way": list(_WAYS),
        },
        attrs={"title": runs.joints(_ENDS[0]).attrs["title"]},
    )


def draw(dataset: xr.Dataset) -> Figure:
    """Draw a panel a clearance: a bar a joint that alone is real, their sum, and all of them real."""
    figure = style.sheet(dataset, "Error of the vane angle, joint by joint", 4.4)
    panels = figure.subplots(1, len(_ENDS), sharey=True)
    for axes, clearance in zip(panels, _ENDS, strict=True):
        _panel(axes, dataset["error"].sel(clearance=clearance), _PAPER[clearance])
        style.caption(axes, f"{clearance * 1e6:g} µm in each joint")
    panels[0].invert_yaxis()
    style.legend_below(figure, panels[0], 4)
    return figure


def _panel(axes: Axes, error: xr.DataArray, paper: float) -> None:
    names = [str(name) for name in error["real"].values]
    places = np.arange(len(names) + 1.0)
    for way, (colour, aside, hatch) in _LOOKS.items():
        each = error.sel(way=way).values
        values = np.array([*each[:-1], each[:-1].sum(), each[-1]])
        axes.barh(
            places + aside,
            values,
            0.38,
            color=colour,
            hatch=hatch,
            edgecolor="white",
            label=f"vane goes {way}",
        )
        for place, value in zip(places + aside, values, strict=True):
            axes.annotate(
                f"{value:.3f}",
                (value, place),
                xytext=(3.0, 0.0),
                textcoords="offset points",
                va="center",
                size=style.SMALL - 1.0,
                color=style.INK,
            )
    one = float(error.sel(real=ONE).mean())
    axes.axvline(SEVEN * one, color=style.INK, linewidth=0.9, linestyle=":", label="seven times the trunnion")
    axes.axvline(paper, color=style.GREY, linewidth=0.9, linestyle="--", label="the paper's figure for all")
    axes.axhline(len(names) - 1.5, color=style.GREY, linewidth=0.6)
    style.finish(axes, "mean error [°]")
    axes.set_yticks(places, [*names[:-1], _ADDED, names[-1]], size=style.SMALL)
    axes.grid(visible=False, axis="y")
    axes.locator_params(axis="x", nbins=5)
    axes.set_xlim(0.0, 1.18 * max(SEVEN * one, paper, *error.values.ravel()))


SPLIT: Final = PaperFigure("joints", "the vane-angle error joint by joint", data, draw)
