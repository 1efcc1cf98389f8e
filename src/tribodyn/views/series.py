"""Variables of a result as arrays to draw, and what is read off them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column

if TYPE_CHECKING:
    import xarray as xr


def series(dataset: xr.Dataset, name: str, scale: float = 1.0) -> FloatArray:
    """Return a variable as an array times ``scale``, shape (n_t,); infinities become NaN."""
    values = column(dataset, name) * scale
    return np.where(np.isfinite(values), values, np.nan)


def finite(values: FloatArray) -> FloatArray:
    """Return the finite entries."""
    return values[np.isfinite(values)]


def peak(values: FloatArray) -> float:
    """Return the largest finite size, 0 when there is none."""
    good = finite(values)
    return float(np.abs(good).max()) if good.size else 0.0


def signed(value: float) -> str:
    """Return a number with its sign, a true minus as in the tick labels."""
    return f"{value:+.3g}".replace("-", "−")
