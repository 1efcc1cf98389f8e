"""Motion of drive and vane, and the moment it takes."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.figures import FIGURES
from tribodyn.figures.motion import DEG
from tribodyn.figures.style import series
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import Curve, Panel, over_time


def data(dataset: xr.Dataset) -> Payload | None:
    """Return angles [°], speeds [°/s] and drive moment [N m]."""
    angles = (
        Curve("vane", series(dataset, "theta_v", DEG), "blue"),
        Curve("crank", series(dataset, "theta_a", DEG), "vermilion", "dash"),
    )
    speeds = (
        Curve("vane", series(dataset, "omega_v", DEG), "blue"),
        Curve("crank", series(dataset, "omega_a", DEG), "vermilion", "dash"),
    )
    moment = (Curve("drive moment", series(dataset, "M_d")),)
    return over_time(
        dataset,
        [Panel("angle [°]", angles), Panel("speed [°/s]", speeds), Panel("drive moment [N m]", moment)],
    )


SECTION: Final = Section(
    name="motion",
    title=FIGURES["motion"].title,
    caption="Where the crank drives the vane, how fast, and the moment this takes at the crank.",
    needs=("theta_v", "theta_a", "omega_v", "omega_a", "M_d"),
    widget="lines",
    data=data,
    still="motion",
)
