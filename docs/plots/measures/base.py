"""Runs and key results that several subjects share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.mechanisms.results import summarise
from tribodyn.papers.cheng_2022.runs import Runs

Numbers: TypeAlias = dict[str, Callable[[Runs], str]]
PEAK, ERROR = "contact_force_max_N", "vane_angle_error_outside_deg"
SOLVERS: Final = ("mebdf", "radau", "bdf", "cvode")


def keys(changes: dict[str, object]) -> dict[str, object]:
    """Return changes of keys; two underscores stand for a dot."""
    return {key.replace("__", "."): value for key, value in changes.items()}


def vsv(runs: Runs, **changes: object) -> xr.Dataset:
    """Return the built-in vane mechanism with some keys changed."""
    return runs.run("vsv", keys(changes))


def key_result(run: xr.Dataset, name: str) -> float:
    """Return a key result of a run."""
    return float(summarise(run)[name])


def result(runs: Runs, *, name: str, digits: str, **changes: object) -> str:
    """Return a key result of the built-in vane mechanism as text."""
    return format(key_result(vsv(runs, **changes), name), digits)


def force(run: xr.Dataset) -> FloatArray:
    """Return the size of the contact force [N]."""
    return np.asarray(np.hypot(run["F_cx"].values, run["F_cy"].values))


def first_reversal(run: xr.Dataset, name: str) -> float:
    """Return a peak of the impacts after the first reversal."""
    return float(run[f"{name}_impact"].values[1])


def spread(values: FloatArray) -> float:
    """Return the largest difference of values over their mean [%]."""
    return float(100.0 * np.ptp(values) / np.mean(values))


def span(values: FloatArray, digits: str) -> str:
    """Return the least and the largest value as text."""
    return f"{format(float(np.min(values)), digits)} to {format(float(np.max(values)), digits)}"
