"""The energy balance of a mechanism: all bodies, joints, springs, drives and loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.views.energy_balance import EnergyBalance, EnergyTerm, energy_columns

WHOLE: Final = EnergyBalance(
    title="Whole mechanism",
    put_in={"energy_in": "drives and loads, in", "energy_expansion": "expansion, in"},
    gained={
        "energy_kinetic": "kinetic",
        "energy_gravity": "gravity",
        "energy_stored": "stored in springs and contact",
        "energy_friction": "friction, out",
        "energy_damping": "damping, out",
        "energy_film": "oil films, out",
    },
    residual="energy_residual",
    measure=("energy_in", "energy_kinetic", "energy_gravity", "energy_stored"),
    attribute="energy_residual",
    yardstick="largest term",
)
BALANCES: Final = (WHOLE,)
TERMS: Final = {
    "energy_kinetic": EnergyTerm("energy_kinetic"),
    "energy_gravity": EnergyTerm("energy_gravity", since_start=True),
    "energy_stored": EnergyTerm("energy_stored"),
    "energy_in": EnergyTerm("work_in"),
    "energy_expansion": EnergyTerm("work_expansion"),
    "energy_friction": EnergyTerm("heat_friction"),
    "energy_damping": EnergyTerm("heat_damping"),
    "energy_film": EnergyTerm("heat_film"),
}


def balance_columns(whole: Mapping[str, FloatArray], *, oiled: bool, opening: bool) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from what is observed of the whole.

    Those of films and of clearances that follow temperatures are left out where there are none.
    """
    left_out = {"energy_film": not oiled, "energy_expansion": not opening}
    terms = {name: term for name, term in TERMS.items() if not left_out.get(name, False)}
    return energy_columns(whole, terms, BALANCES)
