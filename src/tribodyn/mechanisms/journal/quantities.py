"""What results of a journal hold over time, and whose peaks are kept."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import Quantity
from tribodyn.kernels.joints.quantities import WATCHED as OF_JOINT

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
