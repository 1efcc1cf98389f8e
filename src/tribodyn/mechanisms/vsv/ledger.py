"""The two energy ledgers of the vane mechanism, see the manual, energy.

Whole mechanism: kinetic, gravity and stored contact energy against the work of the drive and of the
air loads and the heat of friction, collar and damping. Clearance motion alone: its inertia and stored
contact energy against the loads that drive it and its heats; the work of the air loads, thousands of
times larger, cannot hide an error there. Where the clearance follows temperatures, what that does to the
energy stored in the contact is put in; what it does against damping pressures at once becomes heat, and is
in neither column.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.views.ledger import Ledger

WHOLE: Final = Ledger(
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
CLEARANCE: Final = Ledger(
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
LEDGERS: Final = (WHOLE, CLEARANCE)


def ledger_columns(rows: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from the observed rows."""
    columns = {
        "energy_kinetic": rows["energy_kinetic"],
        "energy_contact": rows["energy_contact"],
        "energy_gravity": rows["energy_gravity"] - rows["energy_gravity"][:1],
        "energy_drive": rows["work_drive"],
        "energy_loads": rows["work_loads"],
        "energy_friction": -rows["work_friction"],
        "energy_collar_friction": -rows["work_collar_friction"],
        "energy_collar_tilt": -rows["work_collar_tilt"],
        "energy_damping": rows["heat_damping"],
        "energy_clearance_inertia": rows["work_clearance_inertia"],
        "energy_clearance_loads": rows["work_clearance_loads"],
        "energy_clearance_contact": rows["energy_contact"] - rows["energy_contact"][:1],
        "energy_clearance_friction": -rows["work_clearance_friction"],
        "energy_clearance_collar": -rows["work_clearance_collar"],
        "energy_clearance_damping": rows["heat_damping"],
    }
    if rows["work_expansion"].any():
        columns["energy_expansion"] = rows["work_expansion"]
    return columns | {ledger.residual: ledger.balance(columns) for ledger in LEDGERS}
