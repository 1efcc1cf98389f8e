"""The trunnion in its bushing: three centres of its axis in the clearance circle."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.encode import packed
from tribodyn.views.playback import in_playback, playback_times
from tribodyn.views.section import Payload, Section
from tribodyn.views.series import peak, series, signed

LOOKS: Final = (
    {"colour": "blue", "dash": "solid", "symbol": "circle"},
    {"colour": "ink", "dash": "dot", "symbol": "diamond"},
    {"colour": "vermilion", "dash": "dash", "symbol": "square"},
)
"""Looks of top, middle and bottom."""


def centre(dataset: xr.Dataset, z: float) -> tuple[FloatArray, FloatArray]:
    """Return the displacement of the trunnion axis at height ``z`` [m], two arrays of shape (n_t,) [µm].

    It is (e_x - z tan phi_y, e_y - z tan phi_x).
    """
    x = series(dataset, "e_x") - z * np.tan(series(dataset, "phi_y"))
    y = series(dataset, "e_y") - z * np.tan(series(dataset, "phi_x"))
    return x * 1e6, y * 1e6


def data(dataset: xr.Dataset) -> Payload | None:
    """Return paths and positions at the frames [µm] of the top, middle and bottom centres."""
    times = playback_times(dataset)
    if times.size < 2:
        return None
    half = 0.5 * float(dataset.attrs.get("joint_length", 0.0))
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    time = dataset["time"].values
    inside = in_playback(dataset)
    centres = [centre(dataset, z) for z in (half, 0.0, -half)]
    reach = max(clearance, *(peak(values[inside]) for path in centres for values in path), 1e-3)
    return {
        "clearance": clearance,
        "reach": 1.25 * reach,
        # The bushing point named theta lies at -(cos theta, sin theta).
        "wall": -1,
        "joined": True,
        "looks": LOOKS,
        "places": [f"top, z = {signed(half * 1e3)} mm", "middle", f"bottom, z = {signed(-half * 1e3)} mm"],
        "paths": [{"x": packed(x[inside]), "y": packed(y[inside])} for x, y in centres],
        "at": [_at(times, time, path) for path in centres],
    }


def _at(times: FloatArray, time: FloatArray, path: tuple[FloatArray, FloatArray]) -> dict[str, object]:
    """Return where a centre is at the frames."""
    x, y = (np.interp(times, time, values) for values in path)
    return {"x": packed(x), "y": packed(y)}


SECTION: Final = Section(
    name="orbit",
    title="The trunnion in its bushing",
    caption=(
        "Seen along the axis: the circle is the clearance, the marks are the top, middle and bottom of the "
        "trunnion axis now, the lines their paths. Beyond the circle the mean planes of the surfaces "
        "overlap. Angles at the wall are those of the pressure map: 0° is the point of the bushing on the "
        "left, at −X, 90° that below, at −Y."
    ),
    needs=("e_x", "e_y", "phi_x", "phi_y"),
    widget="orbit",
    data=data,
    still="trajectory",
)
