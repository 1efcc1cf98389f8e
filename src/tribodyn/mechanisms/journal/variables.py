"""What results of the journal hold beside what every result has: one line a variable."""

from __future__ import annotations

from typing import Final

from tribodyn.kernels.joints.quantities import EXTREMES
from tribodyn.mechanisms.journal.quantities import COUNTS, ENERGIES, FILM, LOADS, ROTATION, WATCHED
from tribodyn.results.peaks import of_run_described
from tribodyn.results.variables import Variable, described

VARIABLES: Final[dict[str, Variable]] = {
    **described(FILM, LOADS, ROTATION, ENERGIES, EXTREMES, COUNTS),
    **of_run_described(WATCHED),
    "energy_film": Variable("J", "heat of the oil film"),
    "settling_time": Variable(
        "s", "time after which the centre stays within 1 % of the clearance of its static equilibrium", ()
    ),
    "contact_start": Variable("s", "first output time at which any point is in contact", ()),
    "e_x_balance": Variable("m", "e_x of the static equilibrium", ()),
    "e_y_balance": Variable("m", "e_y of the static equilibrium", ()),
    "friction_coefficient_end": Variable("1", "friction moment over radius and load, at the end", ()),
    "energy_drive": Variable("J", "work of the drive"),
    "energy_loads": Variable("J", "work of the loads"),
    "energy_friction": Variable("J", "friction heat of the bushing"),
    "energy_damping": Variable("J", "damping heat of the contact"),
    "energy_residual": Variable("J", "error of the energy balance"),
}
"""By name."""
