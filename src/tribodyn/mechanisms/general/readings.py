"""Numbers read off a result of a user-defined mechanism: what its key results and charts are made of."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column, entries


def sizes(dataset: xr.Dataset, name: str, part: int | slice = slice(None)) -> FloatArray:
    """Return the lengths of the vectors of a variable over time and parts, shape (n_t, n); (n_t,) of one."""
    return np.asarray(np.linalg.norm(column(dataset, name)[:, part], axis=-1))


def of_joint(dataset: xr.Dataset, joint: str) -> int:
    """Return the number of a joint, whose name may be that of a number; an unknown one raises."""
    names = [str(name).replace("-", "_") for name in entries(dataset, "joint")]
    return names.index(joint.replace("-", "_"))


def offset(dataset: xr.Dataset, joint: int | slice = slice(None)) -> FloatArray:
    """Return how far shafts are from the middle of their bores [m], shape (n_t, n_joints); (n_t,) of one."""
    across = np.linalg.norm(column(dataset, "displacement")[:, joint, :2], axis=-1)
    return np.asarray(np.where(np.isfinite(column(dataset, "clearance")[joint]), across, np.nan))


def least(values: FloatArray) -> float:
    """Return the smallest finite value, NaN when there is none."""
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else math.nan


def above_zero(value: float) -> float:
    """Return a number, or NaN where it is zero and thus not shown."""
    return value if value > 0.0 else math.nan


def of_surfaces(dataset: xr.Dataset, joint: int) -> NDArray[np.intp]:
    """Return the numbers of the surfaces of a joint, none where it is ideal."""
    name = str(entries(dataset, "joint")[joint])
    surfaces = entries(dataset, "surface").tolist() if "surface" in dataset.coords else []
    return np.flatnonzero([text.rpartition(":")[0] == name for text in surfaces])
