"""Quantities of a clearance joint: its coordinates, its report of an instant, its extremes.

Signs are those of the source paper: φ_x and M_x right-handed, φ_y and M_y left-handed.
"""

from typing import Final

from tribodyn.core.quantities import Quantity, by_axes, of_table

STATES: Final = (
    *by_axes("e_", "m", "offset of the trunnion centre along", "XY"),
    Quantity("phi_x", "rad", "tilt of the trunnion about X (right-handed)"),
    Quantity("phi_y", "rad", "tilt of the trunnion about Y (left-handed)"),
    Quantity("e_x_dot", "m s-1", "velocity of the trunnion centre along X"),
    Quantity("e_y_dot", "m s-1", "velocity of the trunnion centre along Y"),
    Quantity("phi_x_dot", "rad s-1", "tilt rate of the trunnion about X"),
    Quantity("phi_y_dot", "rad s-1", "tilt rate of the trunnion about Y"),
)

#: The report of an instant. Of powers it tells what friction and damping do to the motion.
REPORTED: Final = (
    *by_axes("F_c", "N", "normal contact force on the trunnion along", "XY"),
    Quantity("M_jcx", "N m", "moment of the contact pressure about X"),
    Quantity("M_jcy", "N m", "moment of the contact pressure about Y (left-handed)"),
    *by_axes("F_k", "N", "rigid (asperity stiffness) part of the contact force along", "XY"),
    *by_axes("F_f", "N", "friction force on the trunnion along", "XY"),
    Quantity("M_fx", "N m", "moment of the bushing friction about X"),
    Quantity("M_fy", "N m", "moment of the bushing friction about Y (left-handed)"),
    Quantity("M_jf", "N m", "friction moment of the bushing about Z"),
    Quantity("damping_power", "W", "power of the damping pressure, turned into heat"),
    Quantity("friction_power", "W", "power of the bushing friction, turned into heat"),
    Quantity("energy_contact", "J", "energy stored in the contact"),
    Quantity("p_max", "Pa", "peak contact pressure in the bushing, edges included"),
    Quantity("separation_min", "m", "smallest gap in the bushing, negative where mean surfaces overlap"),
    Quantity(
        "tensile_clip_share", "1", "share of the contact force held back by the clip of tensile pressure"
    ),
    Quantity("contact_fraction", "1", "share of the bushing surface in contact"),
    Quantity("M_kx", "N m", "moment of the rigid part of the contact pressure about X"),
    Quantity("M_ky", "N m", "moment of the rigid part of the contact pressure about Y (left-handed)"),
)

#: Sizes whose peaks are kept, see ``kernels/peaks.py``.
WATCHED: Final = (
    Quantity("contact_force", "N", "contact force"),
    Quantity("rigid_force", "N", "rigid part of the contact force"),
    Quantity("damping_force", "N", "damping part of the contact force"),
    Quantity("pressure", "Pa", "contact pressure"),
    Quantity("eccentricity", "m", "distance of the trunnion centre from the bushing axis"),
    Quantity("tilt", "rad", "tilt of the trunnion"),
)
SHARP: Final = 4  #: Number of those, the first ones, with sharp peaks: forces and pressure.

#: Over all accepted steps; output times would miss them.
EXTREMES: Final = (
    Quantity("separation_least", "m", "smallest gap at any accepted step", ()),
    Quantity("tensile_clip_time", "s", "time integral of the share of the contact where the clip acts", ()),
)

Report = of_table(REPORTED)
Watched = of_table(WATCHED)
Extremes = of_table(EXTREMES)
