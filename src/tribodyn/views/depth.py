"""Wear depth, as figures and report show it."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.series import series

UNITS: Final = {"mm": 1e-3, "µm": 1e-6, "nm": 1e-9, "pm": 1e-12, "fm": 1e-15}
"""Units of depth [m], the coarsest first."""


def fitting_unit(largest: float) -> tuple[str, float]:
    """Return name and size [m] of the coarsest unit in which ``largest`` [m] is at least one."""
    return next(((name, size) for name, size in UNITS.items() if largest >= size), ("pm", UNITS["pm"]))


def no_feedback(dataset: xr.Dataset) -> FloatArray:
    """Return the depth if the first rate had gone on [m], shape (n_jumps,)."""
    return series(dataset, "wear_cycles") * series(dataset, "wear_rate")[:1]
