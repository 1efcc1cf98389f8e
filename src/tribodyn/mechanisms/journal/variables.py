"""What results of the journal hold beside what every result has: one line a variable."""

from __future__ import annotations

from typing import Final

from tribodyn.results.variables import Variable

VARIABLES: Final[dict[str, Variable]] = {
    "F_ox": Variable("N", "force of the oil film on the journal along X"),
    "F_oy": Variable("N", "force of the oil film on the journal along Y"),
    "M_ox": Variable("N m", "moment of the oil film about X"),
    "M_oy": Variable("N m", "moment of the oil film about Y (left-handed)"),
    "M_of": Variable("N m", "friction moment of the oil film about Z"),
    "energy_film": Variable("J", "heat of the oil film"),
    "settling_time": Variable(
        "s", "time after which the centre stays within 1 % of the clearance of its static equilibrium", ()
    ),
    "contact_start": Variable("s", "first output time at which any point is in contact", ()),
    "rebounds": Variable("1", "how often the journal left contact again", ()),
    "contact_force_peak": Variable("N", "largest contact force at any accepted step", ()),
    "contact_force_peak_time": Variable("s", "when the contact force was largest", ()),
    "film_force_peak": Variable("N", "largest film force at any accepted step", ()),
    "pressure_peak": Variable("Pa", "largest contact pressure at any accepted step", ()),
    "separation_least": Variable("m", "smallest gap at any accepted step", ()),
    "e_x_balance": Variable("m", "e_x of the static equilibrium", ()),
    "e_y_balance": Variable("m", "e_y of the static equilibrium", ()),
    "friction_coefficient_end": Variable("1", "friction moment over radius and load, at the end", ()),
    "energy_kinetic": Variable("J", "kinetic energy of the motion in the clearance"),
    "energy_contact": Variable("J", "energy stored in the contact"),
    "energy_drive": Variable("J", "work of the drive"),
    "energy_loads": Variable("J", "work of the loads"),
    "energy_friction": Variable("J", "friction heat of the bushing"),
    "energy_damping": Variable("J", "damping heat of the contact"),
    "energy_residual": Variable("J", "what the ledger misses"),
}
"""By name."""
