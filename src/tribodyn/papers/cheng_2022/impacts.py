"""Numbers of the impacts after the reversals."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.trunnion import CENTRES, centre_velocity

HARDEST: Final = 0.05  #: Samples follow the steps for this long after a reversal [s]: ``run.impact_window``.
_PARTS: Final = {"c": "contact", "k": "rigid", "d": "damping"}


def windows(run: xr.Dataset, length: float = HARDEST) -> list[xr.Dataset]:
    """Return the samples in a time [s] after each reversal; the start is not one."""
    time = run["time"].values
    turns = run["reversal_time"].values[1:]
    return [run.sel(time=(time >= turn) & (time < turn + length)) for turn in turns]


def peaks(run: xr.Dataset, part: str) -> FloatArray:
    """Return the largest contact (``c``), rigid (``k``) or damping (``d``) force of each reversal [N].

    From the accepted steps; the start, at which the trunnion falls, is no reversal.
    """
    return np.asarray(run[f"{_PARTS[part]}_force_impact"].values[1:])


def damping_along_rigid(run: xr.Dataset) -> list[tuple[float, float]]:
    """Return the largest and the least damping force along the rigid force at each reversal [N]."""
    found = []
    for rows in windows(run):
        rigid = np.stack([rows[f"F_k{axis}"].values for axis in "xy"])
        damping = np.stack([rows[f"F_d{axis}"].values for axis in "xy"])
        length = np.hypot(*rigid)
        touching = length > 0.0
        along = (rigid * damping).sum(axis=0)[touching] / length[touching]
        found.append((float(along.max()), float(along.min())))
    return found


def collision_speed(run: xr.Dataset) -> float:
    """Return the largest speed of the three centres after the reversals [mm/s]."""
    return max(
        float(np.hypot(*centre_velocity(rows, height)).max())
        for rows in windows(run)
        for _, height, *_ in CENTRES
    )
