"""Vane-angle error over time and over the position of the vane."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.events import direction, series

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


def branches(dataset: xr.Dataset) -> list[Panel]:
    """Return the angle error [°], the two directions apart."""
    off, sense = error(dataset), direction(dataset)
    forward = ChartCurve("forward, angle growing", np.where(sense > 0.0, off, np.nan), "blue")
    back = ChartCurve("reverse, angle falling", np.where(sense < 0.0, off, np.nan), "vermilion", "dash")
    return [Panel("angle error [°]", [forward, back])]


ERROR: Final = Chart(
    name="vane_error",
    title="Vane-angle error caused by the clearance",
    caption="Actual minus ideal: how far, and how unsteadily, clearance lets the vane stray from the drive.",
    needs=("theta_v", "theta_v_ideal", "omega_v", "omega_v_ideal"),
    panels=panels,
)
LOOP: Final = Chart(
    name="backlash",
    title="Vane-angle error over the vane position",
    caption=(
        "The distance between the forward and the reverse branch is the backlash that a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    panels=branches,
    abscissa=lambda dataset: ("ideal vane angle [°]", series(dataset, "theta_v_ideal", DEG)),
)
