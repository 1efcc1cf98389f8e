"""Numbers read off a result of a user-defined mechanism: what its key results and charts are made of."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column, peak
from tribodyn.results.reading import cycles as cycles_held

_ROUNDING: Final = 1.0e-9


def sizes(dataset: xr.Dataset, name: str, part: int | slice = slice(None)) -> FloatArray:
    """Return the lengths of the vectors of a variable over time and parts, shape (n_t, n); (n_t,) of one."""
    return np.asarray(np.linalg.norm(column(dataset, name)[:, part], axis=-1))


def of_joint(dataset: xr.Dataset, joint: str) -> int:
    """Return the number of a joint, whose name may be that of a number; an unknown one raises."""
    names = [str(name).replace("-", "_") for name in dataset["joint"].values]
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
    name = str(dataset["joint"].values[joint])
    surfaces = dataset["surface"].values.tolist() if "surface" in dataset.coords else []
    return np.flatnonzero([text.rpartition(":")[0] == name for text in surfaces])


def _worn_depths(dataset: xr.Dataset, joint: int) -> tuple[FloatArray, FloatArray]:
    """Return drive cycles and the largest wear depths of a joint there [m], from the first cycle on."""
    surfaces = of_surfaces(dataset, joint)
    if "stage_depth" in dataset:
        stages = np.nan_to_num(column(dataset, "stage_depth")[:, surfaces])
        cycles = np.append(0.0, column(dataset, "stage_cycles"))
        return cycles, np.append(0.0, stages.reshape(len(stages), -1).max(axis=1))
    depth = peak(column(dataset, "wear_depth")[surfaces])
    held = cycles_held(dataset)
    return np.array([0.0, held if held >= 1.0 - _ROUNDING else math.nan]), np.array([0.0, depth])


def wear_rate(dataset: xr.Dataset, joint: int) -> float:
    """Return the wear depth of the last cycle of a joint [m]; NaN before one cycle is complete."""
    cycles, depth = _worn_depths(dataset, joint)
    return above_zero(float(depth[-1] - depth[-2]) / float(cycles[-1] - cycles[-2]))


def wear_life(dataset: xr.Dataset, joint: int, share: float = 1.0) -> float:
    """Return after how many cycles a joint, or what has a share of its depth, is worn to the limit."""
    cycles, depth = _worn_depths(dataset, joint)
    left = float(dataset.attrs["wear_depth_limit"]) - share * float(depth[-1])
    return float(cycles[-1]) + left / (share * wear_rate(dataset, joint))


def partner_share(dataset: xr.Dataset, joint: int) -> float:
    """Return the share of the wear of a joint that is worn off its shaft."""
    surfaces = of_surfaces(dataset, joint)
    worn, whole = (
        float(np.nansum(column(dataset, name)[surfaces])) for name in ("partner_wear_depth", "wear_depth")
    )
    return worn / whole
