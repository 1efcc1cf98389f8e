"""The two energy ledgers as columns of the result, section 10 of the model.

Whole mechanism: kinetic, gravity and stored contact energy against the work of the drive and of the
air loads and the heat of friction, collar and damping. Clearance motion alone: its inertia and stored
contact energy against the loads that drive it and its heats; the work of the air loads, thousands of
times larger, cannot hide an error there.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribodyn.core.arrays import FloatArray


def ledger_columns(rows: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    gravity = _since_start(rows["energy_gravity"])
    columns = {
        "energy_gravity": gravity,
        "energy_drive": rows["work_drive"],
        "energy_loads": rows["work_loads"],
        "energy_friction": -rows["work_friction"],
        "energy_collar_friction": -rows["work_collar_friction"],
        "energy_collar_tilt": -rows["work_collar_tilt"],
        "energy_damping": rows["heat_damping"],
        "energy_clearance_inertia": rows["work_clearance_inertia"],
        "energy_clearance_loads": rows["work_clearance_loads"],
        "energy_clearance_contact": _since_start(rows["energy_contact"]),
        "energy_clearance_friction": -rows["work_clearance_friction"],
        "energy_clearance_collar": -rows["work_clearance_collar"],
        "energy_clearance_damping": rows["heat_damping"],
    }
    kinetic = _since_start(rows["energy_kinetic"])
    return columns | {
        "energy_residual": whole_residual(columns | {"energy_kinetic": kinetic}),
        "energy_clearance_residual": clearance_residual(columns),
    }


def whole_residual(columns: Mapping[str, FloatArray]) -> FloatArray:
    """Return energies gained, plus heats, minus works put in [J]: zero if nothing is missed."""
    return np.asarray(
        columns["energy_kinetic"]
        + columns["energy_gravity"]
        + columns["energy_clearance_contact"]
        + columns["energy_friction"]
        + columns["energy_collar_friction"]
        + columns["energy_collar_tilt"]
        + columns["energy_damping"]
        - columns["energy_drive"]
        - columns["energy_loads"]
    )


def clearance_residual(columns: Mapping[str, FloatArray]) -> FloatArray:
    """Return the same for the clearance motion alone [J]."""
    return np.asarray(
        columns["energy_clearance_inertia"]
        + columns["energy_clearance_contact"]
        + columns["energy_clearance_friction"]
        + columns["energy_clearance_collar"]
        + columns["energy_clearance_damping"]
        - columns["energy_clearance_loads"]
    )


def residual_fractions(columns: Mapping[str, FloatArray]) -> tuple[float, float]:
    """Return the largest residuals as fractions of the largest term of their ledger [1].

    The clearance ledger is measured against its own largest contact term, stored energy or damping heat.
    Where a ledger met a state that the mechanism cannot have, its residual is not a number.
    """
    if not columns["energy_drive"].size:
        return 0.0, 0.0
    # np.max keeps what is not a number; max would lose it.
    whole = np.max([_largest(columns[f"energy_{name}"]) for name in ("drive", "loads", "friction")])
    contact = np.max([_largest(columns[f"energy_clearance_{name}"]) for name in ("contact", "damping")])
    return (
        _fraction(_largest(columns["energy_residual"]), float(whole)),
        _fraction(_largest(columns["energy_clearance_residual"]), float(contact)),
    )


def _since_start(values: FloatArray) -> FloatArray:
    return values - values[0] if values.size else values


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max(initial=0.0))


def _fraction(part: float, whole: float) -> float:
    return 0.0 if whole == 0.0 else part / whole
