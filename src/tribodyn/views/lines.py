"""Curves over time, as the script ``lines`` reads them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.curves import ChartCurve, Panel
from tribodyn.views.encode import packed
from tribodyn.views.events import impact_time, impact_windows, reversal_times, smooth_limits
from tribodyn.views.playback import time_unit
from tribodyn.views.series import peak, series
from tribodyn.views.thinning import thinned


def over_time(dataset: xr.Dataset, panels: Sequence[Panel]) -> dict[str, Any] | None:
    """Return panels above each other over the simulated time; nothing where nothing was computed."""
    time = series(dataset, "time")
    if time.size < 2:
        return None
    turns = reversal_times(dataset)
    unit, scale = time_unit(dataset)
    return {
        "x_label": f"time [{unit}]",
        "time": True,
        "unit": unit,
        "scale": scale,
        "turns": [float(turn * scale) for turn in turns],
        "windows": [[float(end * scale) for end in window] for window in impact_windows(dataset)],
        "x": packed(time * scale, "float64"),
        "panels": [_panel(panel, time, turns, impact_time(dataset)) for panel in panels],
    }


def over(x: FloatArray, x_label: str, panels: Sequence[Panel]) -> dict[str, Any]:
    """Return panels over something other than time."""
    none = np.empty(0)
    return {
        "x_label": x_label,
        "time": False,
        "turns": [],
        "windows": [],
        "x": packed(x, "float64"),
        "panels": [_panel(panel, x, none, 0.0) for panel in panels],
    }


def _panel(panel: Panel, x: FloatArray, turns: FloatArray, settling: float) -> dict[str, Any]:
    """Return a panel as the script reads it."""
    limits, note = _limits(panel, x, turns, settling) if panel.smooth else ([], "")
    return {
        "label": panel.label,
        "limits": limits,
        "note": note,
        "curves": [_curve(curve, x) for curve in panel.curves],
    }


def _curve(curve: ChartCurve, common: FloatArray) -> dict[str, Any]:
    """Return a curve as the script reads it; its abscissa only where it is not the common one."""
    x = common if curve.x is None else curve.x
    x, y = thinned(x, curve.values) if np.all(np.diff(x) > 0.0) else (x, curve.values)
    return {
        "name": curve.name,
        "colour": curve.colour,
        "dash": curve.dash,
        "width": curve.width,
        "x": None if x is common else packed(x, "float64"),
        "y": packed(y),
    }


def _limits(panel: Panel, time: FloatArray, turns: FloatArray, settling: float) -> tuple[list[float], str]:
    """Return the ordinate of the smooth motion and a note on what lies beyond; nothing where all fits."""
    values = np.array([curve.values for curve in panel.curves])
    limits = smooth_limits(time, values, turns, settling)
    if limits is None:
        return [], ""
    return list(limits), f"cut off, impacts reach {peak(values):.3g} {panel.unit}".rstrip()
