"""Figures 10 and 11: what the crank does and how the vane follows, without clearance."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.style import BLUE, DASHED, SMALL, SOLID, VERMILION, finish, lines, sheet
from tribodyn.papers.cheng_2022.layout import first_cycle, keep
from tribodyn.papers.cheng_2022.runs import PaperFigure, Runs
from tribodyn.views.series import series

DEGREES: Final = float(np.rad2deg(1.0))


def crank_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return angle [rad] and speed [rad/s] of the crank over a cycle."""
    return keep(first_cycle(runs.vsv(formulation, 20e-6)), "theta_a", "omega_a")


def vane_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return angle [rad] and speed [rad/s] of the vane without clearance over a cycle."""
    return keep(first_cycle(runs.vsv(formulation, 20e-6)), "theta_v_ideal", "omega_v_ideal")


def _angle_and_speed(dataset: xr.Dataset, title: str, angle: str, speed: str, body: str) -> Figure:
    """Draw an angle [°] and a speed [°/s] over time with an axis each."""
    figure = sheet(dataset, title, 3.4)
    left = figure.subplots()
    right = left.twinx()
    time = series(dataset, "time")
    lines(left, time, [(series(dataset, angle, DEGREES), f"{body} angle", BLUE, SOLID)])
    lines(right, time, [(series(dataset, speed, DEGREES), f"{body} speed", VERMILION, DASHED)])
    finish(left, "time [s]", f"{body} angle [°]")
    finish(right, y_label=f"{body} speed [°/s]")
    right.spines["right"].set_visible(True)
    right.grid(False)
    figure.legend(loc="outside lower center", ncols=2, frameon=False, fontsize=SMALL)
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
