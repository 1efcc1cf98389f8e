"""What a run of a mechanism says about its own trustworthiness, by the names of its joints."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.checks import ENERGY_LIMIT, of_steps

GAP_LIMIT: Final = 1.0e-9
"""Residual of a constraint, in m or rad, below which nobody sees it."""
_TIGHTEN: Final = "Tighten solver.rtol tenfold."


def of_ledgers(energy: float, gaps: FloatArray) -> list[str]:
    """Return what is to be said of energy and constraints; empty texts where nothing is.

    Parameters
    ----------
    energy
        What the energy ledger misses, as a fraction of its largest term.
    gaps
        Largest residual of a constraint over time [m or rad], shape (n_t,).
    """
    if math.isnan(energy):
        return [
            "Energy could not be accounted for to the end. Doubt what follows the last finite "
            "energy_residual."
        ]
    gap = float(np.max(gaps, initial=0.0))
    return [
        f"Energy is missed: {100 * energy:.2g} % of the largest term. {_TIGHTEN}"
        if energy > ENERGY_LIMIT
        else "",
        f"Ideal joints came apart by up to {gap:.2g} m or rad. {_TIGHTEN}" if gap > GAP_LIMIT else "",
    ]


def of_start(asked: str, began: Mapping[str, str]) -> list[str]:
    """Return what is to be said of a start in equilibrium that was asked for and not found."""
    if began.get("start") != "centred" or asked == "centred":
        return []
    return [
        "No place was found in which the loads on all shafts balance within the range of the contact law, so "
        "they start in the middle of their sockets, and first impacts are those of the start. Is there a "
        "shaft that nothing holds along its axis, or a joint too small for its load?"
    ]


def said(*parts: Sequence[str], cost: Mapping[str, float]) -> list[str]:
    """Return all that is to be said, that of the integration last."""
    return [message for part in (*parts, of_steps(cost)) for message in part if message]
