"""The two energy balances of the vane mechanism, see the manual, energy.

Whole mechanism: kinetic, gravity and stored contact energy against the work of the drive and of the
air loads and the heat of friction, collar and damping. Clearance motion alone: its inertia and stored
contact energy against the loads that drive it and its heats; the work of the air loads, thousands of
times larger, cannot hide an error there. Where the clearance follows temperatures, what that does to the
energy stored in the contact is put in; what it does against damping pressures at once becomes heat, and is
in neither column.
"""

from collections.abc import Mapping
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.views.energy_balance import EnergyBalance, EnergyTerm, energy_columns

WHOLE: Final = EnergyBalance(
    title="Whole mechanism",
    put_in={
        "energy_drive": "drive work, in",
        "energy_loads": "load work, in",
        "energy_expansion": "expansion, in",
    },
    gained={
        "energy_kinetic": "kinetic",
        "energy_gravity": "gravity",
        "energy_contact": "stored in contact",
        "energy_friction": "bushing friction, out",
        "energy_collar_friction": "collar friction, out",
        "energy_collar_tilt": "collar tilt, out",
        "energy_damping": "contact damping, out",
    },
    residual="energy_residual",
    measure=("energy_drive", "energy_loads", "energy_friction"),
    attribute="energy_residual",
    yardstick="largest term",
)
CLEARANCE: Final = EnergyBalance(
    title="Motion in the clearance alone",
    put_in={"energy_clearance_loads": "loads and reactions, in", "energy_expansion": "expansion, in"},
    gained={
        "energy_clearance_inertia": "inertia",
        "energy_clearance_contact": "stored in contact",
        "energy_clearance_friction": "friction, out",
        "energy_clearance_collar": "collar, out",
        "energy_clearance_damping": "contact damping, out",
    },
    residual="energy_clearance_residual",
    measure=("energy_clearance_contact", "energy_clearance_damping"),
    attribute="clearance_energy_residual",
    yardstick="largest contact term",
)
BALANCES: Final = (WHOLE, CLEARANCE)


TERMS: Final = {
    "energy_kinetic": EnergyTerm("energy_kinetic"),
    "energy_contact": EnergyTerm("energy_contact"),
    "energy_gravity": EnergyTerm("energy_gravity", since_start=True),
    "energy_drive": EnergyTerm("work_drive"),
    "energy_loads": EnergyTerm("work_loads"),
    "energy_friction": EnergyTerm("work_friction", -1.0),
    "energy_collar_friction": EnergyTerm("work_collar_friction", -1.0),
    "energy_collar_tilt": EnergyTerm("work_collar_tilt", -1.0),
    "energy_damping": EnergyTerm("heat_damping"),
    "energy_clearance_inertia": EnergyTerm("work_clearance_inertia"),
    "energy_clearance_loads": EnergyTerm("work_clearance_loads"),
    "energy_clearance_contact": EnergyTerm("energy_contact", since_start=True),
    "energy_clearance_friction": EnergyTerm("work_clearance_friction", -1.0),
    "energy_clearance_collar": EnergyTerm("work_clearance_collar", -1.0),
    "energy_clearance_damping": EnergyTerm("heat_damping"),
}


def balance_columns(rows: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    expansion = {"energy_expansion": EnergyTerm("work_expansion")} if rows["work_expansion"].any() else {}
    return energy_columns(rows, TERMS | expansion, BALANCES)
