"""Vane-angle error over time and over the position of the vane."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import FIGURES
from tribodyn.figures.events import direction
from tribodyn.figures.style import series
from tribodyn.figures.vane_error import DEG
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import Curve, Panel, over, over_time


def error(dataset: xr.Dataset) -> FloatArray:
    """Return actual minus ideal vane angle [°], shape (n_t,)."""
    return series(dataset, "theta_v", DEG) - series(dataset, "theta_v_ideal", DEG)


def data(dataset: xr.Dataset) -> Payload | None:
    """Return the errors of angle [°] and speed [°/s]."""
    speed = series(dataset, "omega_v", DEG) - series(dataset, "omega_v_ideal", DEG)
    panels = [
        Panel("angle error [°]", [Curve("angle error", error(dataset))]),
        Panel("speed error [°/s]", [Curve("speed error", speed)], smooth=True, unit="°/s"),
    ]
    return over_time(dataset, panels)


def loop(dataset: xr.Dataset) -> Payload | None:
    """Return the angle error [°] over the ideal vane angle [°], the two directions apart."""
    ideal, off, sense = series(dataset, "theta_v_ideal", DEG), error(dataset), direction(dataset)
    if ideal.size < 2:
        return None
    branches = (
        Curve("forward, angle growing", np.where(sense > 0.0, off, np.nan), "blue"),
        Curve("reverse, angle falling", np.where(sense < 0.0, off, np.nan), "vermilion", "dash"),
    )
    return over(ideal, "ideal vane angle [°]", [Panel("angle error [°]", branches)])


SECTION: Final = Section(
    name="vane-error",
    title=FIGURES["vane_error"].title,
    caption="Actual minus ideal: how far, and how unsteadily, clearance lets the vane stray from the drive.",
    needs=("theta_v", "theta_v_ideal", "omega_v", "omega_v_ideal"),
    widget="lines",
    data=data,
    still="vane_error",
)
LOOP: Final = Section(
    name="backlash",
    title="Vane-angle error over the vane position",
    caption=(
        "The distance between the forward and the reverse branch is the backlash that a controller would see."
    ),
    needs=("theta_v", "theta_v_ideal", "omega_v_ideal"),
    widget="lines",
    data=loop,
)
