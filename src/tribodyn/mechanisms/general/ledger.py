"""The energy ledger of a mechanism: all bodies, joints, springs, drives and loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.views.ledger import Ledger

WHOLE: Final = Ledger(
    title="Whole mechanism",
    put_in={"energy_in": "drives and loads, in"},
    gained={
        "energy_kinetic": "kinetic",
        "energy_gravity": "gravity",
        "energy_stored": "stored in springs and contact",
        "energy_friction": "friction, out",
        "energy_damping": "damping, out",
    },
    residual="energy_residual",
    measure=("energy_in", "energy_kinetic", "energy_gravity", "energy_stored"),
    attribute="energy_residual",
    yardstick="largest term",
)
LEDGERS: Final = (WHOLE,)
OBSERVED: Final = {
    "energy_in": "work_in",
    "energy_friction": "heat_friction",
    "energy_damping": "heat_damping",
}
"""What observed quantities are called in a ledger."""


def ledger_columns(whole: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from what is observed of the whole."""
    energies = {name: whole[name] for name in ("energy_kinetic", "energy_gravity", "energy_stored")}
    energies["energy_gravity"] = energies["energy_gravity"] - energies["energy_gravity"][:1]
    columns = energies | {name: whole[entry] for name, entry in OBSERVED.items()}
    return columns | {WHOLE.residual: WHOLE.balance(columns)}
