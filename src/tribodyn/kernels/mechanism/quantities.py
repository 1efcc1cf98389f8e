"""Observed quantities of a mechanism: of the whole, then of each body, then of each coupling."""

from typing import Final

from tribodyn.core.quantities import Quantity, of_table
from tribodyn.kernels.film.report import FILM

WHOLE: Final = (
    Quantity("energy_kinetic", "J", "kinetic energy"),
    Quantity("energy_gravity", "J", "potential energy of gravity, zero as drawn"),
    Quantity("energy_stored", "J", "energy stored in springs and contacts"),
    Quantity("work_in", "J", "work of drives and loads"),
    Quantity("heat_damping", "J", "heat of dampers and contact damping"),
    Quantity("heat_friction", "J", "heat of friction"),
    Quantity("heat_film", "J", "heat of oil films"),
    Quantity("work_expansion", "J", "work of temperatures on what contacts store"),
    Quantity("momentum_x", "kg m s-1", "momentum along x"),
    Quantity("momentum_y", "kg m s-1", "momentum along y"),
    Quantity("momentum_z", "kg m s-1", "momentum along z"),
    Quantity("spin_x", "kg m2 s-1", "angular momentum about the origin, x"),
    Quantity("spin_y", "kg m2 s-1", "angular momentum about the origin, y"),
    Quantity("spin_z", "kg m2 s-1", "angular momentum about the origin, z"),
    Quantity("impulse_x", "N s", "impulse of gravity and ground along x"),
    Quantity("impulse_y", "N s", "impulse of gravity and ground along y"),
    Quantity("impulse_z", "N s", "impulse of gravity and ground along z"),
    Quantity("spin_impulse_x", "N m s", "their angular impulse about the origin, x"),
    Quantity("spin_impulse_y", "N m s", "their angular impulse about the origin, y"),
    Quantity("spin_impulse_z", "N m s", "their angular impulse about the origin, z"),
    Quantity("gap", "1", "largest residual of a constraint, in m or rad"),
    Quantity("gap_rate", "1", "largest rate of it, in m/s or rad/s"),
)

#: In global axes.
BODY: Final = (
    Quantity("position", "m", "mass centre of the body", size=3),
    Quantity("orientation", "1", "quaternion that turns the body from the drawing", size=4),
    Quantity("velocity", "m s-1", "velocity of the mass centre", size=3),
    Quantity("angular_velocity", "rad s-1", "angular velocity of the body, global axes", size=3),
    Quantity("acceleration", "m s-2", "acceleration of the mass centre", size=3),
    Quantity("angular_acceleration", "rad s-2", "angular acceleration of the body, global axes", size=3),
)

#: Of a joint, a spring or a load. Kernels observe them for the shaft; results, for the second body.
COUPLING: Final = (
    Quantity("joint_angle", "rad", "angle of the second body about the axis, from the drawing"),
    Quantity("displacement", "m", "displacement of the shaft in its socket, axes of the joint", size=3),
    Quantity("tilt_x", "rad", "tilt of the shaft in its socket about the x of the joint"),
    Quantity("tilt_y", "rad", "tilt of the shaft in its socket about the y of the joint"),
    Quantity(
        "relative_velocity", "m s-1", "velocity of the second body in the joint, axes of the joint", size=3
    ),
    Quantity(
        "relative_rate",
        "rad s-1",
        "angular velocity of the second body in the joint, axes of the joint",
        size=3,
    ),
    Quantity(
        "reaction_force", "N", "reaction force of the joint on the second body, axes of the joint", size=3
    ),
    Quantity(
        "reaction_moment", "N m", "reaction moment on the second body at the shaft, axes of the joint", size=3
    ),
    Quantity(
        "reaction_force_global", "N", "reaction force of the joint on the second body, global axes", size=3
    ),
    Quantity(
        "reaction_moment_global",
        "N m",
        "reaction moment on the second body at the shaft, global axes",
        size=3,
    ),
    Quantity("drive_moment", "N m", "moment of the drives of the joint on the second body, about the axis"),
    Quantity("drive_force", "N", "force of the drives of the joint on the second body, along the axis"),
    Quantity("joint_work", "J", "work that drives and loads have put in"),
    Quantity("joint_damping", "J", "heat of damping in the joint"),
    Quantity("joint_friction", "J", "heat of friction in the joint"),
    Quantity("joint_energy", "J", "energy stored in the joint"),
    Quantity("contact_force", "N", "normal contact force on the shaft, axes of the joint", size=3),
    Quantity("pressure_max", "Pa", "largest contact pressure in the joint"),
    Quantity("gap_min", "m", "smallest gap in the joint, negative where mean surfaces overlap"),
    Quantity("friction_power", "W", "power that friction turns into heat in the joint"),
    Quantity("damping_power", "W", "power that damping turns into heat in the joint"),
    *FILM,
    Quantity("film_power", "W", "power that the oil film turns into heat in the joint"),
    Quantity("joint_film", "J", "heat of the oil film in the joint"),
)

#: Those that change their sign where the shaft is on the first body.
OF_SECOND: Final = frozenset(
    {
        "joint_angle",
        "relative_velocity",
        "relative_rate",
        "reaction_force",
        "reaction_moment",
        "reaction_force_global",
        "reaction_moment_global",
        "drive_moment",
        "drive_force",
    }
)

Whole: Final = of_table(WHOLE)
Body: Final = of_table(BODY)
Coupling: Final = of_table(COUPLING)
N_WHOLE: Final = Whole.itemsize // 8
N_BODY: Final = Body.itemsize // 8
N_COUPLING: Final = Coupling.itemsize // 8  #: Numbers in each record.
