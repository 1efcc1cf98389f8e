"""Motion of drive and vane, the moment it takes, and the clearance at changing temperatures."""

import tomllib
from string import ascii_lowercase
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.cases.units import UnitProblem, to_si
from tribodyn.papers.cheng_2022.reduced.sections.vane_error import DEG
from tribodyn.views.charts import Chart, ChartCurve, ChartMarks, Panel
from tribodyn.views.events import series


def panels(dataset: xr.Dataset) -> list[Panel]:
    """Return angles [°], speeds [°/s] and drive moment [N m]."""
    return [
        Panel("angle [°]", [*_pair(dataset, "theta"), *_switch(dataset)], marks=_snapshots(dataset)),
        Panel("speed [°/s]", _pair(dataset, "omega")),
        Panel("drive moment\non the crank [N m]", [ChartCurve("drive moment", series(dataset, "M_d"))]),
    ]


def _pair(dataset: xr.Dataset, symbol: str) -> list[ChartCurve]:
    return [
        ChartCurve("vane", series(dataset, f"{symbol}_v", DEG), "blue"),
        ChartCurve("crank", series(dataset, f"{symbol}_a", DEG), "vermilion", "dash"),
    ]


def _switch(dataset: xr.Dataset) -> list[ChartCurve]:
    """Return the vane angle at which the air force changes its sign, where the motion passes it."""
    vane = series(dataset, "theta_v")
    try:
        loads = tomllib.loads(str(dataset.attrs["case"]))["loads"]
        angle = to_si(str(loads["switch_angle"]), "rad")
        acts = to_si(str(loads["air_force_x"]), "N") != 0.0
    except (KeyError, UnitProblem, tomllib.TOMLDecodeError):
        return []
    if not (acts and np.nanmin(vane) < angle < np.nanmax(vane)):
        return []
    return [ChartCurve("air force changes sign", np.full(vane.shape, angle * DEG), "grey", "dot", 1.0)]


def _snapshots(dataset: xr.Dataset) -> ChartMarks | None:
    """Return the times of the pressure snapshots, with the letters of that figure."""
    if "snapshot_time" not in dataset:
        return None
    times, angles = series(dataset, "snapshot_time"), series(dataset, "snapshot_theta_v", DEG)
    return ChartMarks(times, angles, tuple(ascii_lowercase[: times.size]))


MOTION: Final = Chart(
    name="motion",
    title="Drive and vane motion",
    caption=(
        "Where the crank drives the vane, how fast, and the moment this takes. "
        "Letters mark the positions of the pressure snapshots, the dotted line the vane angle at which the "
        "air force along X changes its sign."
    ),
    needs=("theta_a", "theta_v", "omega_a", "omega_v", "omega_v_ideal", "M_d"),
    panels=panels,
)


def _clearance(dataset: xr.Dataset) -> list[Panel]:
    """Return the radial clearance [µm]."""
    return [
        Panel("clearance [µm]", [ChartCurve("radial clearance", series(dataset, "radial_clearance", 1e6))])
    ]


WARMING: Final = Chart(
    name="clearance",
    title="Clearance over time",
    caption="Radial clearance at the temperatures of trunnion, bushing and casing.",
    needs=("radial_clearance",),
    panels=_clearance,
)
