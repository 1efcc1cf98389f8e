"""Content of the journal's report: its chapters, and the overlays of a comparison."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.presets.journal.energy_balance import BALANCE
from tribodyn.views import overlay
from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.encode import packed
from tribodyn.views.energy_balance import balance_chart
from tribodyn.views.overlay import Overlay, scaled
from tribodyn.views.playback import playback_times
from tribodyn.views.section import OVER_TIME, Chapter, Payload, Section
from tribodyn.views.series import peak, series

_FORCES: Final = (("F_c", "contact force"), ("F_o", "film force"))


def _deviation(dataset: xr.Dataset) -> list[Panel]:
    """Return the deviation of the centre [µm], and where statics would have it."""
    return [
        Panel(
            f"along {axis.upper()} [µm]",
            [ChartCurve("centre", series(dataset, f"e_{axis}", 1e6), "blue")],
            level=_balance(dataset, f"e_{axis}_balance"),
        )
        for axis in "xy"
    ]


def _balance(dataset: xr.Dataset, name: str) -> float | None:
    value = float(dataset[name].values) * 1e6 if name in dataset else np.nan
    return value if np.isfinite(value) else None


def _forces(dataset: xr.Dataset) -> list[Panel]:
    """Return contact force and, with oil, film force [N], and the peak of the contact pressure [MPa]."""
    panels = [
        Panel(
            f"{what} [N]",
            [
                ChartCurve("along X", series(dataset, f"{symbol}x"), "blue"),
                ChartCurve("along Y", series(dataset, f"{symbol}y"), "vermilion", "dash"),
            ],
        )
        for symbol, what in _FORCES
        if f"{symbol}x" in dataset
    ]
    pressure = [ChartCurve("peak contact pressure", series(dataset, "p_max", 1e-6))]
    return [*panels, Panel("peak contact\npressure [MPa]", pressure)]


DEVIATION: Final = Chart(
    name="deviation",
    title="Deviation of the journal from the axis of the bushing",
    caption=(
        "How the centre moves under its load; the fine line is where statics would have it. Without damping "
        "and without oil the journal keeps bouncing."
    ),
    needs=("e_x", "e_y"),
    panels=_deviation,
)
FORCES: Final = Chart(
    name="forces",
    title="Forces on the journal",
    caption="What contact and, where there is oil, the film answer the load with, and the peak pressure.",
    needs=("F_cx", "F_cy", "p_max"),
    panels=_forces,
)
ENERGY: Final = balance_chart(
    BALANCE,
    name="energy",
    title="Energy balance",
    caption=(
        "What the load puts in is moving, stored in the contact, or has become heat of contact damping or of "
        "the film. The residual is what the integration lost or made up."
    ),
)


def _path(dataset: xr.Dataset) -> Payload | None:
    """Return path and positions at the frames [µm]."""
    times, time = playback_times(dataset), series(dataset, "time")
    if times.size < 2:
        return None
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    x, y = (series(dataset, name, 1e6) for name in ("e_x", "e_y"))
    return {
        "clearance": clearance,
        "reach": 1.25 * max(clearance, peak(x), peak(y), 1e-3),
        "joined": False,
        "looks": [{"colour": "blue", "dash": "solid", "symbol": "circle"}],
        "places": ["centre"],
        "paths": [{"x": packed(x), "y": packed(y)}],
        "at": [{"x": packed(np.interp(times, time, x)), "y": packed(np.interp(times, time, y))}],
    }


PATH: Final = Section(
    name="path",
    title="The journal in its clearance",
    caption=(
        "The circle is the clearance, the mark is the centre of the journal now, the line its path. Beyond "
        "the circle the mean planes of the surfaces overlap."
    ),
    needs=("e_x", "e_y"),
    widget="orbit",
    data=_path,
    still="path",
)

CHAPTERS: Final = (
    Chapter("playback", "The run", "Move the slider, or press play.", (PATH,), playback=True),
    Chapter("time", "Over time", OVER_TIME, (DEVIATION.section, FORCES.section, ENERGY.section)),
)
"""Chapters in reading order."""

OVERLAYS: Final = (
    *overlay.BUSHING,
    Overlay("film", "Film force", (scaled("F_ox", "along X [N]", 1.0), scaled("F_oy", "along Y [N]", 1.0))),
)
"""Overlays of a comparison of runs."""
