"""What a wear campaign writes down at every stop, and how many worn profiles it keeps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record

History = dict[str, FloatArray]
"""Columns over the stops of a campaign, by their names in the result, each of shape (n_jumps,)."""

COLUMNS: Final = (
    "wear_cycles",
    "wear_jump_cycles",
    "wear_depth_max",
    "worn_volume",
    "wear_rate",
    "wear_load_change",
    "wear_pressure_max",
    "wear_pressure_mean",
    "wear_force_mean",
    "wear_angle_error_max",
    "wear_angle_error_rms",
    "wear_energy_lost",
)
"""Names of the columns; the variable table says what they mean."""

MOST_STAGES: Final = 32
"""Worn profiles that are kept of a campaign, however long it is."""


def empty_history() -> History:
    """Return a history of no stops."""
    return {name: np.empty(0) for name in COLUMNS}


def appended(history: Mapping[str, FloatArray], entry: Mapping[str, float]) -> History:
    """Return the history with one more stop; ``entry`` holds a number for each of :data:`COLUMNS`."""
    return {name: np.append(history[name], entry[name]) for name in COLUMNS}


def of_motion(t: FloatArray, rows: Mapping[str, FloatArray], peaks: Record) -> dict[str, float]:
    """Return the entries that describe the motion of one cycle.

    Parameters
    ----------
    t
        Output times [s], shape (n_t,).
    rows
        Observed columns by name, each of shape (n_t,).
    peaks
        Of the joint over all accepted steps.
    """
    error = rows["theta_v"] - rows["theta_v_ideal"]
    return {
        "wear_pressure_max": float(peaks.pressure_peak),
        "wear_pressure_mean": _mean(t, rows["p_max"]),
        "wear_force_mean": _mean(t, np.hypot(rows["F_cx"], rows["F_cy"])),
        "wear_angle_error_max": float(np.abs(error).max()),
        "wear_angle_error_rms": _mean(t, error**2) ** 0.5,
    }


def _mean(t: FloatArray, values: FloatArray) -> float:
    """Return the mean over time; output times crowd around events."""
    return 0.5 * float(np.sum((values[1:] + values[:-1]) * np.diff(t))) / float(t[-1] - t[0])


def thinned(cycles: FloatArray, depth: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return worn profiles and their cycles, every second one left out when they are too many.

    The latest is always kept. Later ones are added at every jump, so that a long campaign keeps early
    profiles further apart than late ones, never more than :data:`MOST_STAGES`.

    Parameters
    ----------
    cycles
        Cycles at the profiles, shape (n,).
    depth
        Depth [m], shape (n, n_z + 2, n_theta).
    """
    if cycles.size <= MOST_STAGES:
        return cycles, depth
    kept = np.arange(cycles.size)[::-2][::-1]
    return cycles[kept], depth[kept]
