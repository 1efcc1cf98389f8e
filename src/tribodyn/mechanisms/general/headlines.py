"""Headline numbers of a mechanism: of the whole, and of each joint by its name."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.base import ByJoint
from tribodyn.results.headline import Headline
from tribodyn.results.reading import column, peak, time_mean


def settled(dataset: xr.Dataset, values: FloatArray) -> FloatArray:
    """Return values over time; of two cycles and more without the first, in which the start dies away."""
    time, period = column(dataset, "time"), float(dataset.attrs.get("cycle_period", math.inf))
    return values[time >= period] if time.size and time[-1] >= (2.0 - 1e-9) * period else values


def sizes(dataset: xr.Dataset, name: str) -> FloatArray:
    """Return the lengths of the vectors of a variable over time and parts, shape (n_t, n)."""
    return np.asarray(np.linalg.norm(column(dataset, name), axis=-1))


def of_joint(dataset: xr.Dataset, joint: str) -> int:
    """Return the number of a joint, whose name may be that of a number; an unknown one raises."""
    names = [str(name).replace("-", "_") for name in dataset["joint"].values]
    return names.index(joint.replace("-", "_"))


def offset(dataset: xr.Dataset) -> FloatArray:
    """Return how far shafts are from the middle of their bores [m], shape (n_t, n_joints)."""
    across = np.linalg.norm(column(dataset, "displacement")[..., :2], axis=-1)
    return np.asarray(np.where(np.isfinite(column(dataset, "clearance")), across, np.nan))


def _power(dataset: xr.Dataset) -> float:
    time, work = column(dataset, "time"), column(dataset, "energy_in")
    return float((work[-1] - work[0]) / (time[-1] - time[0])) if time.size > 1 else np.nan


HEADLINES: Final[dict[str, Headline]] = {
    "joint_force_max_N": Headline(
        "Force in a joint, largest",
        "N",
        "Load",
        "Largest force that any joint carries.",
        lambda d: peak(settled(d, sizes(d, "reaction_force"))),
    ),
    "peak_pressure_MPa": Headline(
        "Peak pressure",
        "MPa",
        "Load",
        "Highest pressure in any joint; compare it with the hardness.",
        lambda d: _above_zero(peak(settled(d, column(d, "pressure_max")))) * 1e-6,
    ),
    "drive_moment_max_Nm": Headline(
        "Drive moment, largest",
        "N m",
        "Drive",
        "What a motor must give.",
        lambda d: _of_drives(d, "drive_moment"),
    ),
    "drive_force_max_N": Headline(
        "Drive force, largest",
        "N",
        "Drive",
        "What an actuator must give.",
        lambda d: _of_drives(d, "drive_force"),
    ),
    "power_mean_W": Headline(
        "Power put in, mean", "W", "Drive", "Work of drives and loads over the time of the run.", _power
    ),
    "offset_max_um": Headline(
        "Offset in a joint, largest",
        "µm",
        "Accuracy",
        "How far a shaft leaves the middle of its bore.",
        lambda d: peak(settled(d, offset(d))) * 1e6,
    ),
    "friction_heat_J": Headline(
        "Friction heat",
        "J",
        "Loss",
        "What friction in all joints turned into heat.",
        lambda d: float(column(d, "energy_friction")[-1]) if "surface" in d.dims else math.nan,
    ),
    "wear_depth_max_nm": Headline(
        "Wear depth, largest",
        "nm",
        "Wear",
        "What is worn off at the deepest point of any joint.",
        lambda d: peak(column(d, "wear_depth")) * 1e9,
    ),
    "energy_residual_percent": Headline(
        "Energy residual",
        "%",
        "Trust",
        "What the energy ledger misses, of its largest term.",
        lambda d: 100.0 * float(d.attrs["energy_residual"]),
    ),
}
KEY_NUMBERS: Final = (
    "joint_force_max_N",
    "offset_max_um",
    "peak_pressure_MPa",
    "drive_moment_max_Nm",
    "energy_residual_percent",
)


def _above_zero(value: float) -> float:
    """Return a number that is zero only where there is nothing to tell; NaN then."""
    return value if value > 0.0 else math.nan


def _of_drives(dataset: xr.Dataset, name: str) -> float:
    """Return the largest effort of drives; NaN where there is none."""
    return _above_zero(peak(settled(dataset, column(dataset, name))))


def _named(
    label: str, unit: str, group: str, meaning: str, compute: Callable[[xr.Dataset, int], float]
) -> ByJoint:
    def made(joint: str) -> Headline:
        return Headline(f"{label}, {joint}", unit, group, meaning, lambda d: compute(d, of_joint(d, joint)))

    return made


BY_JOINT: Final[dict[str, ByJoint]] = {
    "force_max_N": _named(
        "Force, largest",
        "N",
        "Joints",
        "Largest force in this joint.",
        lambda d, j: peak(settled(d, sizes(d, "reaction_force")[:, j])),
    ),
    "force_mean_N": _named(
        "Force, mean",
        "N",
        "Joints",
        "Mean force in this joint: what wears it.",
        lambda d, j: time_mean(d, sizes(d, "reaction_force")[:, j]),
    ),
    "offset_max_um": _named(
        "Offset, largest",
        "µm",
        "Joints",
        "How far the shaft leaves the middle of the bore.",
        lambda d, j: peak(settled(d, offset(d)[:, j])) * 1e6,
    ),
    "peak_pressure_MPa": _named(
        "Peak pressure",
        "MPa",
        "Joints",
        "Highest pressure in this joint.",
        lambda d, j: _above_zero(peak(settled(d, column(d, "pressure_max")[:, j]))) * 1e-6,
    ),
    "friction_heat_J": _named(
        "Friction heat",
        "J",
        "Joints",
        "What friction in this joint turned into heat.",
        lambda d, j: float(column(d, "joint_friction")[-1, j]) if of_surfaces(d, j).size else math.nan,
    ),
    "wear_depth_nm": _named(
        "Wear depth",
        "nm",
        "Joints",
        "What is worn off this joint at its deepest.",
        lambda d, j: peak(column(d, "wear_depth")[of_surfaces(d, j)]) * 1e9,
    ),
}
"""Numbers of each joint, by what stands before its name."""


def of_surfaces(dataset: xr.Dataset, joint: int) -> NDArray[np.intp]:
    """Return the numbers of the surfaces of a joint, none where it is ideal."""
    name = str(dataset["joint"].values[joint])
    surfaces = dataset["surface"].values.tolist() if "surface" in dataset.coords else []
    return np.flatnonzero([text.rpartition(":")[0] == name for text in surfaces])
