"""The energy balance of the journal.

Kinetic energy of the motion in the clearance and energy stored in the contact against the work of loads and
drive and the heat of friction, contact damping and film. The work of the drive, which turns into heat at
once, is no measure of the residual: it could hide any error.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.presets.journal.parameters import Journal
from tribodyn.views.energy_balance import EnergyBalance, EnergyTerm, energy_columns

BALANCE: Final = EnergyBalance(
    title="Motion in the clearance",
    put_in={"energy_loads": "load work, in", "energy_drive": "drive work, in"},
    gained={
        "energy_kinetic": "kinetic",
        "energy_contact": "stored in contact",
        "energy_damping": "contact damping, out",
        "energy_friction": "friction, out",
        "energy_film": "film, out",
    },
    residual="energy_residual",
    measure=("energy_loads", "energy_kinetic", "energy_contact", "energy_damping"),
    attribute="energy_residual",
    yardstick="largest energy of the motion",
)
TERMS: Final = {
    "energy_kinetic": EnergyTerm("energy_kinetic"),
    "energy_contact": EnergyTerm("energy_contact"),
    "energy_loads": EnergyTerm("work_loads"),
    "energy_drive": EnergyTerm("work_drive"),
    "energy_friction": EnergyTerm("work_friction", -1.0),
    "energy_damping": EnergyTerm("heat_damping"),
}
_LEAST_SCALE: Final = 1.0e-3
"""Share of load times clearance below which no term counts as large."""


def balance_columns(rows: Mapping[str, FloatArray], *, lubricated: bool) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    film = {"energy_film": EnergyTerm("work_film", -1.0)} if lubricated else {}
    return energy_columns(rows, TERMS | film, (BALANCE,))


def residual_fraction(columns: Mapping[str, FloatArray], journal: Journal) -> float:
    """Return the largest residual as a fraction of the largest energy of the motion in the clearance [1]."""
    return BALANCE.fraction(columns, _LEAST_SCALE * journal.loads.force * journal.joint.geometry.clearance)
