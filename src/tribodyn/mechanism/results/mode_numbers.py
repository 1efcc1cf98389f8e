"""Key results of the modes of a vibration analysis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.base import ByPart
from tribodyn.results.reading import column
from tribodyn.results.summary import KeyResult


def _of_mode(
    label: str, unit: str, meaning: str, variable: str, reduce: Callable[[FloatArray], float], digits: int = 6
) -> ByPart:
    def made(mode: str) -> KeyResult:
        def compute(dataset: xr.Dataset) -> float:
            number = [str(name) for name in dataset["mode"].values].index(mode)
            return reduce(column(dataset, variable)[:, number])

        return KeyResult(label, unit, "Modes", meaning, compute, digits=digits).of_part(mode)

    return made


def _over_positions(reduce: Callable[[FloatArray], float]) -> Callable[[FloatArray], float]:
    """Return the reduction of the values at several positions; of one there is nothing to compare."""
    return lambda values: reduce(values) if values.size > 1 else np.nan


BY_MODE: Final[dict[str, ByPart]] = {
    "frequency_Hz": _of_mode(
        "Frequency at the start",
        "Hz",
        "Natural frequency at the first position; zero of a motion that nothing holds.",
        "natural_frequency",
        lambda values: float(values[0]),
    ),
    "damping_ratio": _of_mode(
        "Damping ratio",
        "",
        "At the first position; one without oscillation, below zero where the position is unstable.",
        "damping_ratio",
        lambda values: float(values[0]),
        digits=3,
    ),
    "frequency_min_Hz": _of_mode(
        "Lowest frequency",
        "Hz",
        "Lowest of all positions along the drives.",
        "natural_frequency",
        _over_positions(lambda values: float(np.nanmin(values))),
    ),
    "frequency_max_Hz": _of_mode(
        "Highest frequency",
        "Hz",
        "Highest of all positions along the drives.",
        "natural_frequency",
        _over_positions(lambda values: float(np.nanmax(values))),
    ),
}
"""Numbers of each mode, by what stands before its number."""
