"""Observed quantities of a mechanism, of each body and coupling, and joints whose model has ended."""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import hypot
from mebdf.kernels.jit import copy
from tribodyn.core.quantities import Quantity, Record, by_axes, of_table
from tribodyn.kernels.film.report import FILM as OF_FILM
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.mechanism.data import (
    ANGLE,
    CONTACT,
    COORDINATE,
    DAMPING,
    DISTANCE,
    EXPANSION,
    FILM,
    FRICTION,
    INTACT,
    LEFT,
    NONE,
    OPENED,
    OVERLAPPED,
    POINT,
    POSITION,
    WORK,
    MechanismData,
    MechanismMemory,
    Now,
    Parts,
)
from tribodyn.kernels.mechanism.relative import whole_angle
from tribodyn.kernels.mechanism.vectors import turn, turn_back

WHOLE: Final = (
    Quantity("energy_kinetic", "J", "kinetic energy"),
    Quantity("energy_gravity", "J", "potential energy of gravity, zero as drawn"),
    Quantity("energy_stored", "J", "energy stored in springs and contacts"),
    Quantity("work_in", "J", "work of drives and loads"),
    Quantity("heat_damping", "J", "heat of dampers and contact damping"),
    Quantity("heat_friction", "J", "heat of friction"),
    Quantity("heat_film", "J", "heat of oil films"),
    Quantity("work_expansion", "J", "work of temperatures on what contacts store"),
    *by_axes("momentum_", "kg m s-1", "momentum along", "xyz"),
    *by_axes("spin_", "kg m2 s-1", "angular momentum about the origin,", "xyz"),
    *by_axes("impulse_", "N s", "impulse of gravity and ground along", "xyz"),
    *by_axes("spin_impulse_", "N m s", "their angular impulse about the origin,", "xyz"),
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
    *OF_FILM,
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


@kernel
def fill_row(data: MechanismData, memory: MechanismMemory, row: FloatArray) -> None:
    """Fill a row with the records of the whole, of each body and of each coupling."""
    _whole(data.parts, memory.now, memory.books, row[:N_WHOLE].view(Whole)[0])
    first = N_WHOLE
    for b in range(data.parts.bodies.size):
        _body(memory.now.bodies[b], row[first : first + N_BODY].view(Body)[0])
        first += N_BODY
    for k in range(data.parts.couplings.size):
        coupling, out = data.parts.couplings[k], row[first : first + N_COUPLING].view(Coupling)[0]
        _coupling(coupling, memory.now.couplings[k], memory.books[k], out)
        _contact(data.contact, memory.contact, coupling, out)
        _film(coupling.film, memory.oil, out)
        first += N_COUPLING


@kernel
def _whole(data: Parts, memory: Now, books: Any, out: Record) -> None:
    """Energies, works, momenta and impulses of the whole, and how well constraints hold."""
    course, n = memory.course, data.couplings.size
    out.energy_kinetic, out.energy_gravity = course.kinetic, course.potential
    out.energy_stored = out.work_in = out.heat_damping = out.heat_friction = out.heat_film = 0.0
    out.work_expansion = 0.0
    out.gap = out.gap_rate = 0.0
    for k in range(n):
        now, book = memory.couplings[k], books[k]
        out.energy_stored += now.stored
        out.work_in += book.sums[WORK]
        out.heat_damping += book.sums[DAMPING]
        out.heat_friction += book.sums[FRICTION]
        out.heat_film += book.sums[FILM]
        out.work_expansion += book.sums[EXPANSION]
        for m in range(data.couplings[k].n_rows):
            out.gap = max(out.gap, abs(now.residual[m]))
            out.gap_rate = max(out.gap_rate, abs(now.rate[m]))
    momentum, impulse, spin = course.momentum, books[n].sums, books[n + 1].sums
    out.momentum_x, out.momentum_y, out.momentum_z = momentum[0], momentum[1], momentum[2]
    out.spin_x, out.spin_y, out.spin_z = momentum[3], momentum[4], momentum[5]
    out.impulse_x, out.impulse_y, out.impulse_z = impulse[0], impulse[1], impulse[2]
    out.spin_impulse_x, out.spin_impulse_y, out.spin_impulse_z = spin[0], spin[1], spin[2]


@kernel
def _body(now: Record, out: Record) -> None:
    """Place, velocities and accelerations of a body."""
    copy(now.r, out.position)
    copy(now.p, out.orientation)
    copy(now.v, out.velocity)
    turn(now.A, now.w, out.angular_velocity)
    copy(now.acceleration[:3], out.acceleration)
    turn(now.A, now.acceleration[3:6], out.angular_acceleration)


@kernel
def _coupling(coupling: Record, now: Record, book: Record, out: Record) -> None:
    """Motion of the shaft, wrench of the joint and of its drives on it, works and powers of a coupling."""
    axis, driving = now.pose.rotation[:, 2], now.work[0, :6]
    _drive(coupling, now, driving)
    out.joint_angle = whole_angle(now)
    copy(now.pose.d, out.displacement)
    out.tilt_x, out.tilt_y = -axis[1] / axis[2], axis[0] / axis[2]
    copy(now.twist[:3], out.relative_velocity)
    copy(now.twist[3:], out.relative_rate)
    for i in range(3):
        out.reaction_force[i] = now.wrench[i] + now.constraint[i] - driving[i]
        out.reaction_moment[i] = now.wrench[3 + i] + now.constraint[3 + i] - driving[3 + i]
    turn_back(now.RT, out.reaction_force, out.reaction_force_global)
    turn_back(now.RT, out.reaction_moment, out.reaction_moment_global)
    out.drive_moment, out.drive_force = driving[5], driving[2]
    out.joint_work, out.joint_damping = book.sums[WORK], book.sums[DAMPING]
    out.joint_friction, out.joint_energy = book.sums[FRICTION], now.stored
    out.friction_power, out.damping_power = now.powers[FRICTION], now.powers[DAMPING]
    out.film_power, out.joint_film = now.powers[FILM], book.sums[FILM]


@kernel
def _drive(coupling: Record, now: Record, out: FloatArray) -> None:
    """Fill the wrench of the drives of a joint on its shaft (6,)."""
    for i in range(6):
        out[i] = 0.0
    out[5], out[2] = now.effort[0], now.effort[1]
    for m in range(coupling.n_rows):
        if coupling.row_kind[m] == ANGLE or coupling.row_kind[m] == POSITION:
            for i in range(6):
                out[i] += now.N[m, i] * now.multiplier[m]


@kernel
def _contact(joints: SurfaceData, memory: SurfaceMemory, coupling: Record, out: Record) -> None:
    """Add up the surfaces of a joint with clearance; without one there is no contact force."""
    for i in range(3):
        out.contact_force[i] = 0.0
    out.pressure_max = out.gap_min = 0.0
    if coupling.force != CONTACT:
        return
    out.gap_min = math.inf
    for s in range(joints.joints[coupling.contact], joints.joints[coupling.contact + 1]):
        report = memory.reports[s]
        out.contact_force[0] += report.F_cx
        out.contact_force[1] += report.F_cy
        out.contact_force[2] += report.F_cz
        out.pressure_max = max(out.pressure_max, report.p_max)
        out.gap_min = min(out.gap_min, report.separation_min)


@kernel
def _film(k: int, oil: Any, out: Record) -> None:
    """Fill the report of a joint's oil film; nothing without one."""
    for i in range(3):
        out.film_force[i] = out.film_moment[i] = 0.0
    out.film_pressure_max = out.film_thickness_min = out.film_leakage = 0.0
    if k == NONE:
        return
    report = oil[k].report
    copy(report.film_force, out.film_force)
    copy(report.film_moment, out.film_moment)
    out.film_pressure_max, out.film_thickness_min = report.film_pressure_max, report.film_thickness_min
    out.film_leakage = report.film_leakage


#: Residual of an ideal joint, in units of the mechanism's size or in radians, that is not rounding.
OPEN: Final = 1.0e-6


@kernel
def watch(data: MechanismData, memory: MechanismMemory) -> None:
    """Note the first joint whose model does not hold where ``advance`` has left the mechanism."""
    course, size = memory.now.course, data.parts.constants.extent
    for k in range(data.parts.couplings.size):
        if course.broken != INTACT:
            return
        coupling, now = data.parts.couplings[k], memory.now.couplings[k]
        for m in range(coupling.n_rows):
            is_length = coupling.row_kind[m] in (POINT, POSITION, COORDINATE, DISTANCE)
            if not abs(now.residual[m]) <= OPEN * (size if is_length else 1.0):
                course.broken, course.broken_at = OPENED, k
        if coupling.force == CONTACT:
            _watch_surfaces(data.contact, memory.contact, coupling.contact, now.pose.d, course)


@kernel
def _watch_surfaces(
    joints: SurfaceData, memory: SurfaceMemory, j: int, d: FloatArray, course: Record
) -> None:
    """Note the first surface of a joint that is beyond its contact law, or whose shaft has left it."""
    for s in range(joints.joints[j], joints.joints[j + 1]):
        surface = joints.surfaces[s]
        if memory.reports[s].separation_min < surface.deepest:
            course.broken, course.broken_at = OVERLAPPED, s
            return
        if hypot(d[0], d[1]) > surface.reach[0] or abs(d[2]) > surface.reach[1]:
            course.broken, course.broken_at = LEFT, s
            return
