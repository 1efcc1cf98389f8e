"""Variables of a journal beside those of every result, and whose peaks are kept: one line each."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import Quantity
from tribodyn.kernels.joints.quantities import EXTREMES
from tribodyn.kernels.joints.quantities import WATCHED as OF_JOINT
from tribodyn.results.peaks import of_run_described
from tribodyn.results.variables import Variable, described

FILM: Final = (
    Quantity("F_ox", "N", "force of the oil film on the journal along X"),
    Quantity("F_oy", "N", "force of the oil film on the journal along Y"),
    Quantity("M_ox", "N m", "moment of the oil film about X"),
    Quantity("M_oy", "N m", "moment of the oil film about Y (left-handed)"),
    Quantity("M_of", "N m", "friction moment of the oil film about Z"),
)
LOADS: Final = (
    Quantity("W_x", "N", "load on the journal along X"),
    Quantity("W_y", "N", "load on the journal along Y"),
    Quantity("W_mx", "N m", "moment of the load about X"),
    Quantity("W_my", "N m", "moment of the load about Y (left-handed)"),
)
ROTATION: Final = (Quantity("omega", "rad s-1", "speed of rotation about Z"),)
ENERGIES: Final = (Quantity("energy_kinetic", "J", "kinetic energy of the motion in the clearance"),)
WATCHED: Final = (*OF_JOINT, Quantity("film_force", "N", "film force"))
"""Sizes whose peaks are kept."""
COUNTS: Final = (Quantity("rebounds", "1", "how often the journal left contact again", ()),)

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
