"""What is observed of a mechanism: of the whole, then of each body, then of each coupling."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import Quantity

WHOLE: Final = (
    Quantity("energy_kinetic", "J", "kinetic energy"),
    Quantity("energy_gravity", "J", "potential energy of gravity, zero as drawn"),
    Quantity("energy_stored", "J", "energy stored in springs and contacts"),
    Quantity("work_in", "J", "work of drives and loads"),
    Quantity("heat_damping", "J", "heat of dampers and contact damping"),
    Quantity("heat_friction", "J", "heat of friction"),
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

BODY: Final = (
    *(Quantity(name, "m", f"mass centre, {name}") for name in "xyz"),
    *(Quantity(f"p_{i}", "1", f"quaternion from the drawing, entry {i}") for i in range(4)),
    *(Quantity(f"v_{name}", "m s-1", f"velocity of the mass centre, {name}") for name in "xyz"),
    *(Quantity(f"omega_{name}", "rad s-1", f"angular velocity, {name}") for name in "xyz"),
    *(Quantity(f"a_{name}", "m s-2", f"acceleration of the mass centre, {name}") for name in "xyz"),
    *(Quantity(f"alpha_{name}", "rad s-2", f"angular acceleration, {name}") for name in "xyz"),
)
"""In global axes."""

COUPLING: Final = (
    Quantity("angle", "rad", "angle of the shaft about the axis, whole turns included"),
    *(Quantity(f"d_{name}", "m", f"displacement of the shaft, {name} of the joint") for name in "xyz"),
    *(Quantity(f"tilt_{name}", "rad", f"tilt of the shaft about {name} of the joint") for name in "xy"),
    *(Quantity(f"u_{name}", "m s-1", f"relative velocity, {name} of the joint") for name in "xyz"),
    *(Quantity(f"w_{name}", "rad s-1", f"relative angular velocity, {name} of the joint") for name in "xyz"),
    *(
        Quantity(f"F_{name}", "N", f"reaction force on the shaft's body, {name} of the joint")
        for name in "xyz"
    ),
    *(Quantity(f"M_{name}", "N m", f"reaction moment at the shaft, {name} of the joint") for name in "xyz"),
    *(Quantity(f"R_{name}", "N", f"reaction force on the shaft's body, global {name}") for name in "xyz"),
    *(Quantity(f"T_{name}", "N m", f"reaction moment at the shaft, global {name}") for name in "xyz"),
    Quantity("drive_moment", "N m", "moment of the drives about the axis"),
    Quantity("drive_force", "N", "force of the drives along the axis"),
    Quantity("work", "J", "work that the coupling has put in"),
    Quantity("damping", "J", "what it has turned into heat by damping"),
    Quantity("friction", "J", "what it has turned into heat by friction"),
    Quantity("stored", "J", "energy stored in it"),
    *(Quantity(f"c_{name}", "N", f"normal contact force, {name} of the joint") for name in "xyz"),
    Quantity("pressure_max", "Pa", "largest contact pressure"),
    Quantity("gap_min", "m", "smallest gap, negative where mean surfaces overlap"),
    Quantity("friction_power", "W", "power that friction turns into heat"),
    Quantity("damping_power", "W", "power that damping turns into heat"),
)
