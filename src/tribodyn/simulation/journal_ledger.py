"""The energy ledger of the journal as columns of the result.

Kinetic energy of the motion in the clearance and energy stored in the contact against the work of loads and
drive and the heat of friction, contact damping and film.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.journal import Journal

_LEAST_SCALE: Final = 1.0e-3
"""Share of load times clearance below which no term counts as large."""


def ledger_columns(rows: Mapping[str, FloatArray], *, lubricated: bool) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    columns = {
        "energy_loads": rows["work_loads"],
        "energy_drive": rows["work_drive"],
        "energy_friction": -rows["work_friction"],
        "energy_damping": rows["heat_damping"],
        "energy_residual": residual(rows),
    }
    return columns | ({"energy_film": -rows["work_film"]} if lubricated else {})


def residual(rows: Mapping[str, FloatArray]) -> FloatArray:
    """Return energies gained, plus heats, minus works put in [J]: zero if nothing is missed."""
    gained = _since_start(rows["energy_kinetic"]) + _since_start(rows["energy_contact"])
    heats = rows["heat_damping"] - rows["work_friction"] - rows["work_film"]
    return np.asarray(gained + heats - rows["work_loads"] - rows["work_drive"])


def residual_fraction(rows: Mapping[str, FloatArray], journal: Journal) -> float:
    """Return the largest residual as a fraction of the largest energy of the motion in the clearance [1].

    That is the largest of load work, kinetic energy, stored contact energy and damping heat. The work of
    the drive, which turns into heat at once, is no measure: it could hide any error.
    """
    terms = [rows[name] for name in ("work_loads", "energy_kinetic", "energy_contact", "heat_damping")]
    least = _LEAST_SCALE * journal.loads.force * journal.joint.geometry.clearance
    scale = max(least, *(_largest(term) for term in terms))
    return _largest(residual(rows)) / scale if scale > 0.0 else 0.0


def _since_start(values: FloatArray) -> FloatArray:
    return values - values[0] if values.size else values


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max(initial=0.0))
