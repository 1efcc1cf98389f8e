"""Forces of a coupling on its shaft, at its origin, in the axes of the socket, with their derivatives.

The derivatives are those in relative displacement, a small turn ϑ of the shaft, velocity and angular
velocity. What a load or a torque that follows a coordinate changes with it is left out of them: it is never
stiff.
"""

import math
from typing import Annotated, Any

from mebdf.arrays import FloatArray
from mebdf.compiled.layouts import STACKED
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import Signals, add_following, add_terms, evaluate, norm, oppose, oppose_along
from tribodyn.kernels.film.data import FilmData, FilmMemory, film_at, memory_at
from tribodyn.kernels.jit import clear, entry, inlined, kernel
from tribodyn.kernels.joints.film import Oil, fill_report, film_wrench
from tribodyn.kernels.joints.surface import joint as surfaces
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import Scratch, SurfaceMemory
from tribodyn.kernels.mechanism.beam import beam
from tribodyn.kernels.mechanism.data import (
    BEAM,
    CONTACT,
    DAMPING,
    EXPANSION,
    FILM,
    FOLLOWED,
    FOLLOWED_SPEED,
    FRICTION,
    LOAD_BODY,
    LOAD_GROUND,
    LOAD_LINE,
    LOAD_MOTION,
    N_POWERS,
    NONE,
    REPORTS,
    SLOPES,
    SPRING,
    SPRINGS,
    TIME,
    WORK,
    CouplingNow,
    MechanismData,
    MechanismMemory,
)
from tribodyn.kernels.mechanism.relative import whole_angle


@entry
def film_force(
    mode: float,
    films: Annotated[FilmData, STACKED],
    memory: Annotated[FilmMemory, STACKED],
    k: int,
    now: Annotated[Record, CouplingNow],
    scratch: Annotated[Record, Scratch],
    oil: Annotated[Record, Oil, 1],
) -> None:
    """Add the wrench of film ``k`` to that of its coupling, ``now``, and what else ``mode`` asks for.

    ``scratch`` is that of the joints with clearance.
    """
    film, own, slopes = film_at(films, k), memory_at(memory, k), 1.0 if mode == SLOPES else 0.0
    film_wrench(film, own, now.pose, scratch, oil[k], slopes, now.slope)
    if mode == REPORTS:
        fill_report(film, own, now.pose, oil[k])
        now.powers[FILM] += oil[k].power
    for i in range(6):
        now.wrench[i] += oil[k].wrench[i]


@inlined
def force(
    data: MechanismData, memory: MechanismMemory, number: int, t: float, within: float, mode: float
) -> None:
    """Fill wrench, powers and stored energy of a coupling; slopes, and reports of a contact, by ``mode``."""
    coupling, now = data.parts.couplings[number], memory.now.couplings[number]
    for i in range(6):
        now.wrench[i] = 0.0
    for i in range(N_POWERS):
        now.powers[i] = 0.0
    now.stored = 0.0
    if mode == SLOPES:
        clear(now.slope)
    kind = coupling.force
    if kind == SPRINGS:
        _springs(coupling, now)
    elif kind == SPRING:
        _spring(coupling, now)
    elif kind in (LOAD_GROUND, LOAD_BODY, LOAD_MOTION, LOAD_LINE):
        _load(coupling, now, memory.now.couplings, data, t, within)
    elif kind == BEAM:
        beam(coupling, now, mode)
    elif kind == CONTACT:
        _open(coupling, now.pose, data.signals, t, within)
        _contact(coupling.contact, now, data.contact, memory.contact, mode)
    if coupling.film != NONE:
        scratch, oil = memory.contact.scratch, memory.oil
        film_force(mode, data.films, memory.films, coupling.film, now, scratch, oil)
    for axis in range(2):
        now.effort[axis] = 0.0
        if coupling.effort[axis] != NONE:
            value, _, _ = evaluate(data.signals, coupling.effort[axis], t, within)
            now.effort[axis] = value
            entry = 5 if axis == 0 else 2
            now.wrench[entry] += value
            now.powers[WORK] += value * now.twist[entry]


@kernel
def _open(coupling: Record, pose: Record, signals: Signals, t: float, within: float) -> None:
    """Fill the growth of a joint's clearance by temperatures."""
    for i in range(2):
        if coupling.opening[i] != NONE:
            pose.opening[i], pose.v_opening[i], _ = evaluate(signals, coupling.opening[i], t, within)


@inlined
def _contact(j: int, now: Record, joints: SurfaceData, memory: SurfaceMemory, mode: float) -> None:
    """Fill the forces of a joint with clearance."""
    if mode == SLOPES:
        surfaces.wrench_and_jacobian(joints, memory, j, now.pose, now.wrench, now.slope)
    elif mode == REPORTS:
        surfaces.report(joints, memory, j, now.pose)
        for s in range(joints.joints[j], joints.joints[j + 1]):
            report = memory.reports[s]
            surfaces.add_reported(report, now.wrench)
            now.stored += report.energy_contact
            now.powers[DAMPING] += report.damping_power
            now.powers[FRICTION] -= report.friction_power
            now.powers[EXPANSION] += report.expansion_power
    else:
        surfaces.wrench(joints, memory, j, now.pose, now.wrench)


@kernel
def _springs(coupling: Record, now: Record) -> None:
    """Fill the wrench of three springs along and three about the axes, with dampers.

    Those about the axes across have the energy ½ k_x f_y² + ½ k_y f_x² with the shaft's axis f, the one
    about the axis ½ k_z θ².
    """
    k, c, twist, slope = coupling.stiffness, coupling.damping, now.twist, now.slope
    f, q, angle = now.pose.rotation[:, 2], now.pose.rotation[:, 0], whole_angle(now)
    for i in range(3):
        now.wrench[i] = -k[i] * now.pose.d[i]
        now.stored += 0.5 * k[i] * now.pose.d[i] ** 2
        slope[i, i] = -k[i]
    now.stored += 0.5 * (k[3] * f[1] ** 2 + k[4] * f[0] ** 2 + k[5] * angle**2)
    inverse = 1.0 / (q[0] * q[0] + q[1] * q[1])
    # ∂θ/∂ϑ = q × (q_x e_y − q_y e_x) / (q_x² + q_y²).
    g_x, g_y, g_z = -q[2] * q[0] * inverse, -q[2] * q[1] * inverse, 1.0
    now.wrench[3] = k[3] * f[1] * f[2] - k[5] * angle * g_x
    now.wrench[4] = -k[4] * f[0] * f[2] - k[5] * angle * g_y
    now.wrench[5] = (k[4] - k[3]) * f[0] * f[1] - k[5] * angle * g_z
    for j in range(3):
        # δf = e_j × f.
        d_x = f[2] if j == 1 else (-f[1] if j == 2 else 0.0)
        d_y = -f[2] if j == 0 else (f[0] if j == 2 else 0.0)
        d_z = f[1] if j == 0 else (-f[0] if j == 1 else 0.0)
        twisted = k[5] * (g_x if j == 0 else (g_y if j == 1 else g_z))
        slope[3, 3 + j] = k[3] * (d_y * f[2] + f[1] * d_z) - twisted * g_x
        slope[4, 3 + j] = -k[4] * (d_x * f[2] + f[0] * d_z) - twisted * g_y
        slope[5, 3 + j] = (k[4] - k[3]) * (d_x * f[1] + f[0] * d_y) - twisted * g_z
    for i in range(6):
        now.wrench[i] -= c[i] * twist[i]
        now.powers[DAMPING] += c[i] * twist[i] ** 2
        slope[i, 6 + i] = -c[i]


@kernel
def _spring(coupling: Record, now: Record) -> None:
    """Fill the force of a spring and damper between the two origins."""
    d, v, slope = now.pose.d, now.pose.v, now.slope
    length = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    stretch = length - coupling.length
    k, c = coupling.stiffness[0], coupling.damping[0]
    rate = (d[0] * v[0] + d[1] * v[1] + d[2] * v[2]) / length
    tension = k * stretch + c * rate
    now.stored = 0.5 * k * stretch * stretch
    now.powers[DAMPING] = c * rate * rate
    for i in range(3):
        n_i = d[i] / length
        now.wrench[i] = -tension * n_i
        for j in range(3):
            n_j = d[j] / length
            across = (1.0 if i == j else 0.0) - n_i * n_j
            swing = (v[j] - rate * n_j) / length
            slope[i, j] = -k * n_i * n_j - c * n_i * swing - tension / length * across
            slope[i, 6 + j] = -c * n_i * n_j


@kernel
def _load(
    coupling: Record, now: Record, couplings: Any, data: MechanismData, t: float, within: float
) -> None:
    """Fill a load: its components are global, or turn with the body, or oppose the motion."""
    places = now.small
    places[TIME, 0], places[TIME, 1] = t, within
    if coupling.follows != NONE:
        _follow(coupling, couplings[coupling.follows], places)
    if coupling.own_speed == 1:
        places[FOLLOWED_SPEED, 0] = places[FOLLOWED_SPEED, 1] = _own_speed(coupling, now)
    first, last = coupling.first_term, coupling.last_term
    add_terms(data.signals, data.terms, first, last, 1.0, places, now.wrench)
    if coupling.force == LOAD_BODY:
        _turn_with_body(now)
    elif coupling.force != LOAD_GROUND:
        _oppose(coupling, now, data, places)
    for i in range(6):
        now.powers[WORK] += now.wrench[i] * now.twist[i]


@kernel
def _follow(coupling: Record, joint: Record, places: FloatArray) -> None:
    """Fill coordinate and speed of the joint that a load follows."""
    if coupling.follows_position == 1:
        x, speed = joint.pose.d[2], joint.twist[2]
    else:
        x, speed = whole_angle(joint), joint.twist[5]
    places[FOLLOWED, 0] = places[FOLLOWED, 1] = coupling.follows_sign * x
    places[FOLLOWED_SPEED, 0] = places[FOLLOWED_SPEED, 1] = coupling.follows_sign * speed


@kernel
def _own_speed(coupling: Record, now: Record) -> float:
    """Return the speed that a load opposes [m/s, rad/s]."""
    a = coupling.opposes
    if coupling.force == LOAD_MOTION:
        return norm(now.twist[a : a + 3])
    speed = 0.0
    for i in range(3):
        speed += coupling.direction[i] * now.twist[a + i]
    return abs(speed)


@kernel
def _oppose(coupling: Record, now: Record, data: MechanismData, places: FloatArray) -> None:
    """Make the size of a force or moment, at its first component, one that opposes the motion."""
    a, growth = coupling.opposes, 0.0
    size, now.wrench[a] = now.wrench[a], 0.0
    if coupling.own_speed == 1:
        following = now.work[0:2]
        clear(following)
        first, last = coupling.first_term, coupling.last_term
        add_following(data.signals, data.terms, first, last, 1.0, FOLLOWED_SPEED, places, following)
        growth = following[1, a]
    u, force, slope = now.twist[a : a + 3], now.wrench[a : a + 3], now.slope[a : a + 3, 6 + a : 9 + a]
    if coupling.force == LOAD_MOTION:
        oppose(size, growth, u, coupling.slip_velocity, force, slope)
    else:
        oppose_along(size, growth, coupling.direction, u, coupling.slip_velocity, force, slope)


@kernel
def _turn_with_body(now: Record) -> None:
    """Make a load on the socket the wrench on the shaft, which is the ground: −F, and −M + d × F."""
    w, d = now.wrench, now.pose.d
    f_x, f_y, f_z = w[0], w[1], w[2]
    w[0], w[1], w[2] = -f_x, -f_y, -f_z
    w[3] = d[1] * f_z - d[2] * f_y - w[3]
    w[4] = d[2] * f_x - d[0] * f_z - w[4]
    w[5] = d[0] * f_y - d[1] * f_x - w[5]
    now.slope[3, 1], now.slope[3, 2] = f_z, -f_y
    now.slope[4, 2], now.slope[4, 0] = f_x, -f_z
    now.slope[5, 0], now.slope[5, 1] = f_y, -f_x
