"""Vane-angle error over time and over the position of the vane."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.charts import Chart, ChartCurve, Panel, over
from tribodyn.views.events import direction, series
from tribodyn.views.section import Payload, Section

DEG: Final = 180.0 / np.pi


def error(dataset: xr.Dataset) -> FloatArray:
    """Return actual minus ideal vane angle [°], shape (n_t,)."""
    return series(dataset, "theta_v", DEG) - series(dataset, "theta_v_ideal", DEG)


def panels(dataset: xr.Dataset) -> list[Panel]:
    """Return the errors of angle [°] and speed [°/s]."""
    speed = series(dataset, "omega_v", DEG) - series(dataset, "omega_v_ideal", DEG)
    return [
        Panel("angle error [°]", [ChartCurve("angle error", error(dataset))]),
        Panel("speed error [°/s]", [ChartCurve("speed error", speed)], smooth=True),
    ]


def branches(dataset: xr.Dataset) -> list[ChartCurve]:
    """Return the angle error [°] over the ideal vane angle, the two directions apart."""
    off, sense = error(dataset), direction(dataset)
    return [
        ChartCurve("forward, angle growing", np.where(sense > 0.0, off, np.nan), "blue"),
        ChartCurve("reverse, angle falling", np.where(sense < 0.0, off, np.nan), "vermilion", "dash"),
    ]


def _loop(dataset: xr.Dataset) -> Payload | None:
    ideal = series(dataset, "theta_v_ideal", DEG)
    if ideal.size < 2:
        return None
    return over(ideal, "ideal vane angle [°]", [Panel("angle error [°]", branches(dataset))])


ERROR: Final = Chart(
    name="vane_error",
    title="Vane-angle error caused by the clearance",
    caption="Actual minus ideal: how far, and how unsteadily, clearance lets the vane stray from the drive.",
    needs=("theta_v", "theta_v_ideal", "omega_v", "omega_v_ideal"),
    panels=panels,
)
LOOP: Final = Section(
    name="backlash",
    title="Vane-angle error over the vane position",
    caption=(
        "The distance between the forward and the reverse branch is the backlash that a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    widget="lines",
    data=_loop,
)
