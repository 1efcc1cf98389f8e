"""Equations of motion of the journal: Newton for its centre, Euler for small tilts of its axis.

The states are (e_x, e_y) and their rates, or (e_x, e_y, φ_x, φ_y) and their rates. With φ_x right-handed and
φ_y left-handed, as everywhere in the joint, a journal that spins about Z turns gyroscopically by

    J φ̈_x = Q_x + J_z ω φ̇_y,    J φ̈_y = Q_y − J_z ω φ̇_x,

and the moments of the joint act on the tilts as Q_x = M_x sec²φ_x, Q_y = M_y sec²φ_y, because a point of the
axis at height z moves by −z sec²φ dφ.
"""

from __future__ import annotations

import math

from mebdf.kernels.elementary import hypot, tan
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import add_following, add_terms, follow, held, norm, oppose
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.film.data import CONVERGED, FilmData, FilmMemory
from tribodyn.kernels.film.wrench import film_wrench, film_wrench_and_jacobian
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.bushing import BushingData, wrench, wrench_and_jacobian
from tribodyn.kernels.joints.paper import fill_pose, from_jacobian, from_wrench
from tribodyn.kernels.journal.data import (
    OPPOSED,
    ROTATION,
    SLIDING,
    SPEED,
    TIME,
    TURNED,
    TURNING,
    JournalData,
    JournalMemory,
)
from tribodyn.kernels.signals import evaluate


@kernel
def spread(y: FloatArray, state: FloatArray) -> None:
    """Fill the eight states of the joint from ``y`` (4,) or (8,); without tilt the journal stays parallel."""
    n = y.size // 2
    for i in range(4):
        state[i] = y[i] if i < n else 0.0
        state[4 + i] = y[n + i] if i < n else 0.0


@kernel
def act(data: JournalData, t: float, memory: JournalMemory) -> None:
    """Fill the rotation and the loads at ``t`` [s], where the states are filled."""
    scratch, segment, actions = memory.scratch, memory.segment, data.actions
    within, places, load = held(segment, TIME, t), scratch.places, scratch.load
    scratch.turned, _, _ = evaluate(actions.signals, ROTATION, t, within)
    scratch.speed, _, _ = evaluate(actions.signals, SPEED, t, within)
    follow(places, segment, TIME, t)
    follow(places, segment, TURNED, scratch.turned)
    follow(places, segment, TURNING, scratch.speed)
    follow(places, segment, SLIDING, norm(scratch.state[4:6]))
    for i in range(4):
        load[i] = data.constants.load[i]
    load[OPPOSED] = 0.0
    add_terms(actions.signals, actions.terms, 0, actions.terms.size, 1.0, places, load)
    clear(scratch.resistance)
    if load[OPPOSED] != 0.0:
        resist(data, memory)


@kernel
def resist(data: JournalData, memory: JournalMemory) -> None:
    """Add the load against the velocity of the centre, and fill its derivative."""
    scratch, actions, following = memory.scratch, data.actions, memory.scratch.following
    clear(following)
    n = actions.terms.size
    add_following(actions.signals, actions.terms, 0, n, 1.0, SLIDING, scratch.places, following)
    size, growth = scratch.load[OPPOSED], following[1, OPPOSED]
    slip = data.constants.slip_velocity
    oppose(size, growth, scratch.state[4:6], slip, scratch.load[0:2], scratch.resistance)


@kernel
def place(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Fill rotation, loads, the eight states and the pose of the joint at ``t`` [s]."""
    spread(y, memory.scratch.state)
    act(data, t, memory)
    pose = memory.joint.scratch.pose
    fill_pose(memory.scratch.state, memory.scratch.speed, memory.segment.direction, pose)


@kernel
def least_gap(joint: BushingData, state: FloatArray) -> float:
    """Return the smallest gap between the mean planes of the unworn bushing [m]; it lies on an edge."""
    tan_x, tan_y = tan(state[2]), tan(state[3])
    half = joint.z[joint.z.size - 1]
    low = hypot(state[0] + half * tan_y, state[1] + half * tan_x)
    high = hypot(state[0] - half * tan_y, state[1] - half * tan_x)
    return joint.clearance - max(low, high)


@kernel
def film_force(film: FilmData | None, cache: FilmMemory | None, speed: float, scratch: Record) -> None:
    """Fill ``scratch.film`` at ``scratch.state``; without oil it stays zero."""
    # The test is for compile time, which sees it only on an argument of its own.
    if film is not None:
        status = film_wrench(film, cache, scratch.state, speed, scratch.film)
        if status != CONVERGED:
            scratch.film_status = status


@kernel
def film_force_and_gradient(
    film: FilmData | None, cache: FilmMemory | None, speed: float, scratch: Record
) -> None:
    """Fill ``scratch.film`` and add its derivatives to ``scratch.wrench_jacobian``."""
    if film is not None:
        gradient, total = scratch.film_jacobian, scratch.wrench_jacobian
        status = film_wrench_and_jacobian(film, cache, scratch.state, speed, scratch.film, gradient)
        if status != CONVERGED:
            scratch.film_status = status
        for i in range(4):
            for k in range(8):
                total[i, k] += gradient[i, k]


@kernel
def gather(data: JournalData, memory: JournalMemory) -> None:
    """Fill ``scratch.total`` (4,) with loads, gyroscopic moments and the wrenches on the journal."""
    scratch, constants = memory.scratch, data.constants
    state, total, force, film = scratch.state, scratch.total, scratch.wrench, scratch.film
    sec2_x = 1.0 + tan(state[2]) ** 2
    sec2_y = 1.0 + tan(state[3]) ** 2
    spin, load = constants.spin_inertia * scratch.speed, scratch.load
    total[0] = load[0] + force[0] + film[0]
    total[1] = load[1] + force[1] + film[1]
    total[2] = load[2] + sec2_x * (force[2] + film[2]) + spin * state[7]
    total[3] = load[3] + sec2_y * (force[3] + film[3]) - spin * state[6]


@inlined
def forces(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Fill ``scratch.total``; not a number once an accepted step has left the range of the contact law."""
    scratch, joint = memory.scratch, memory.joint.scratch
    place(data, t, y, memory)
    if memory.course.beyond > 0.0:
        for i in range(4):
            scratch.total[i] = math.nan
        return
    wrench(data.joint, memory.joint, joint.pose, joint.wrench)
    from_wrench(joint.wrench, scratch.wrench)
    film_force(data.film, memory.film, scratch.speed, scratch)
    gather(data, memory)


@inlined
def forces_and_gradient(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Fill ``scratch.total`` and turn ``scratch.wrench_jacobian`` (4 rows) into its derivative."""
    scratch, joint = memory.scratch, memory.joint.scratch
    place(data, t, y, memory)
    jacobian = scratch.wrench_jacobian
    wrench_and_jacobian(data.joint, memory.joint, joint.pose, joint.wrench, joint.jacobian)
    from_wrench(joint.wrench, scratch.wrench)
    from_jacobian(joint.jacobian, jacobian)
    film_force_and_gradient(data.film, memory.film, scratch.speed, scratch)
    gather(data, memory)
    for i in range(2):
        for k in range(2):
            jacobian[i, 4 + k] += scratch.resistance[i, k]
    spin = data.constants.spin_inertia * scratch.speed
    for i in (2, 3):
        tangent = tan(scratch.state[i])
        sec2 = 1.0 + tangent * tangent
        for k in range(8):
            jacobian[i, k] *= sec2
        jacobian[i, i] += 2.0 * sec2 * tangent * (scratch.wrench[i] + scratch.film[i])
    jacobian[2, 7] += spin
    jacobian[3, 6] -= spin
