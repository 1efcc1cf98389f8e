"""Observed quantities of the variable stator vane mechanism, in their order."""

from typing import Final

from tribodyn.core.quantities import Quantity, by_axes, names, of_table, of_tables, together
from tribodyn.kernels.joints.quantities import REPORTED, STATES
from tribodyn.kernels.joints.quantities import WATCHED as OF_JOINT

MOTION: Final = (
    Quantity("theta_a", "rad", "crank angle"),
    Quantity("theta_b", "rad", "unison ring angle"),
    Quantity("theta_v", "rad", "vane angle"),
    Quantity("theta_v_ideal", "rad", "vane angle without clearance"),
    Quantity("omega_a", "rad s-1", "crank speed"),
    Quantity("omega_v", "rad s-1", "vane speed"),
    Quantity("omega_v_ideal", "rad s-1", "vane speed without clearance"),
    Quantity("h_1", "m", "axial travel of the unison ring"),
)
COLLAR: Final = (
    Quantity("M_tcx", "N m", "moment of the thrust collar about X"),
    Quantity("M_tcy", "N m", "moment of the thrust collar about Y (left-handed)"),
    Quantity("M_tf", "N m", "friction moment of the thrust collar about Z"),
)
REACTIONS: Final = (
    *by_axes("F_a", "N", "force of the casing on the crank pivot along"),
    *by_axes("M_a", "N m", "moment of the casing on the crank pivot about", "XZ"),
    Quantity("M_d", "N m", "drive moment on the crank"),
    *by_axes("F_21", "N", "force of the drag link on the crank along"),
    *by_axes("F_32", "N", "force of the unison ring on the drag link along"),
    *by_axes("F_43", "N", "force of the lever arm on the unison ring along"),
    *by_axes("F_b", "N", "force of the casing on the unison ring along", "XZ"),
    *by_axes("M_b", "N m", "moment of the casing on the unison ring about", "XZ"),
    Quantity("F_cz", "N", "force of the thrust collar on the trunnion along Z"),
)
#: In the order of the loads in ``kernels/vsv/data.py``.
AIR: Final = (
    *by_axes("F_air", "N", "aerodynamic force on the vane along"),
    Quantity("M_airx", "N m", "moment of the aerodynamic force about X, over the vane's centre"),
    Quantity(
        "M_airy", "N m", "moment of the aerodynamic force about Y, over the vane's centre (left-handed)"
    ),
    Quantity("M_air", "N m", "aerodynamic moment on the vane about Z"),
)
ENERGIES: Final = (
    Quantity("energy_kinetic", "J", "kinetic energy of all bodies"),
    Quantity("energy_gravity", "J", "gravity energy of all bodies"),
)
#: Whole mechanism: what is integrated from powers.
POWERS: Final = (
    Quantity("work_drive", "J", "work of the drive"),
    Quantity("work_loads", "J", "work of the loads on the vane"),
    Quantity("work_friction", "J", "work of the bushing friction"),
    Quantity("work_collar_friction", "J", "work of the thrust collar's friction"),
    Quantity("work_collar_tilt", "J", "work of the thrust collar on tilting"),
    Quantity("work_expansion", "J", "work of the expansion on what the contact stores"),
)
#: Clearance motion: what is integrated from forces on its coordinates.
FORCES: Final = (
    Quantity("heat_damping", "J", "damping heat of the contact"),
    Quantity("work_clearance_loads", "J", "clearance motion: work of everything but the joint"),
    Quantity("work_clearance_friction", "J", "clearance motion: work of friction"),
    Quantity("work_clearance_collar", "J", "clearance motion: work of the thrust collar"),
)
INERTIA: Final = (Quantity("work_clearance_inertia", "J", "clearance motion: what inertia has taken in"),)

WATCHED_TABLES: Final = {
    "joint": OF_JOINT,
    "mechanism": (
        Quantity("drive_moment", "N m", "drive moment"),
        Quantity("vane_angle_error", "rad", "vane-angle error"),
    ),
}
#: Sizes whose peaks are kept after each reversal, in the order of ``kernels/peaks.py``.
WATCHED: Final = together(WATCHED_TABLES)

TABLES: Final = {
    "states": STATES,
    "motion": MOTION,
    "joint": REPORTED,
    "collar": COLLAR,
    "reactions": REACTIONS,
    "air": AIR,
    "energies": ENERGIES,
    "works": (*POWERS, *FORCES, *INERTIA),
}
QUANTITIES: Final = together(TABLES)  #: Everything observed, in the order of a row.
OBSERVED: Final = names(QUANTITIES)

Row: Final = of_tables(TABLES)
Watched: Final = of_tables(WATCHED_TABLES)
Powers: Final = of_table(POWERS)
Forces: Final = of_table(FORCES)
States: Final = of_table(STATES)
Air: Final = of_table(AIR)
Works: Final = of_table(TABLES["works"])
