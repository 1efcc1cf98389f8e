"""Angles of joints over which charts are drawn, instead of over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant
from tribodyn.views.encode import stepped
from tribodyn.views.events import series

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.core.arrays import FloatArray

_MOST: Final = 6
"""Joints over whose angle a reader may have charts."""
_FINE: Final = 0.02
"""Rounding of such an angle on a page [deg]."""
_LEAST: Final = 1.0
"""Range of an angle over which a chart is of use [deg]."""


def angle_of(dataset: xr.Dataset, joint: str) -> tuple[str, FloatArray]:
    """Return the label of a joint's angle and its values within one turn [deg], NaN where a turn ends.

    Raises
    ------
    InputError
        There is no such joint.
    """
    names = [str(name) for name in dataset["joint"].values] if "joint_angle" in dataset else []
    if joint not in names:
        words = f"{as_given(joint)}; allowed: a joint, {', '.join(names) or 'none here'}{meant(joint, names)}"
        raise InputError(words, key="over")
    angle = np.degrees(dataset["joint_angle"].values[:, names.index(joint)])
    if np.ptp(angle) > 360.0:
        angle = angle % 360.0
        angle[1:][np.abs(np.diff(angle)) > 180.0] = np.nan
    return f"angle of {joint} [°]", angle


def coordinates(dataset: xr.Dataset, scale: float) -> list[dict[str, Any]]:
    """Return angles of joints over time, those of driven joints first, as the page reads them.

    Parameters
    ----------
    dataset
        A result.
    scale
        Of the times of the page.
    """
    if "joint_angle" not in dataset or "drive_moment" not in dataset:
        return []
    angle = np.degrees(dataset["joint_angle"].values)
    driven = np.nan_to_num(np.abs(dataset["drive_moment"].values)).max(axis=0) > 0.0
    order = np.lexsort((-np.ptp(angle, axis=0), ~driven))
    chosen = [k for k in order.tolist() if np.ptp(angle[:, k]) > _LEAST][:_MOST]
    time, names = series(dataset, "time", scale), dataset["joint"].values
    return [
        {"name": str(names[k]), "x": stepped(time, 0.0), "y": stepped(angle[:, k], _FINE)} for k in chosen
    ]
