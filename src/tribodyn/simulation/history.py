"""Numbers of a wear campaign at every stop, and the number of worn profiles that it keeps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.results.variables import CAMPAIGN

History = dict[str, FloatArray]
"""Columns over the stops of a campaign, by their names in the result, each of shape (n_jumps,)."""

MOST_STAGES: Final = 32
"""Worn profiles that are kept of a campaign, however long it is."""


def columns(of_cycle: Iterable[str]) -> tuple[str, ...]:
    """Return the names of all columns, those that a mechanism writes down about each cycle among them."""
    return (*CAMPAIGN, *of_cycle)


def empty_history(of_cycle: Iterable[str]) -> History:
    """Return a history of no stops."""
    return {name: np.empty(0) for name in columns(of_cycle)}


def appended(history: Mapping[str, FloatArray], entry: Mapping[str, float]) -> History:
    """Return the history with one more stop; ``entry`` holds a number for each column."""
    return {name: np.append(values, entry[name]) for name, values in history.items()}


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
