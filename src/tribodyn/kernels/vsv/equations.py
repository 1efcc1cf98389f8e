"""Projected equations of motion, M(q, t) q̈ = Q; see the manual, the mechanism.

Every body contributes Σ_rows (F_r − m_r a_r) δr = 0 along a test motion δr. In ``exact`` the test
motions are the true ones, the columns of the motion table. In ``paper`` they are those with which
the printed equations eliminate the reactions (rows of Eq. 46): ring and drag link with the vane
following in translation, rotation of the vane about the pin, and the two tilts without the moment
of the lever force. In ``printed`` they are the coefficients that Appendix 2 prints.
"""

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import cos, sin, tanh
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import add_terms, follow
from tribodyn.kernels.dense import solve_in_place
from tribodyn.kernels.jit import clear, inlined, kernel
from tribodyn.kernels.joints import bushing as thrust
from tribodyn.kernels.joints.bushing import wrench, wrench_and_jacobian
from tribodyn.kernels.joints.pose import from_jacobian, from_wrench
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.closure import place
from tribodyn.kernels.vsv.data import (
    AIR_M,
    AIR_X,
    AIR_Y,
    AIR_Z,
    BEND_X,
    BEND_Y,
    CRANK_ANGLE,
    CRANK_SPEED,
    TIME,
    VANE,
    VANE_SPEED,
    VsvData,
    VsvMemory,
)
from tribodyn.kernels.vsv.motion import drive, fill_motion, ring_centre
from tribodyn.kernels.vsv.printed import add_printed_entries, fill_printed_motion, fill_printed_tests


@kernel
def fill_test_motions(mechanism: Record, motion: FloatArray, test: FloatArray) -> None:
    """Fill the bodies' test motions (N_BODY, 5): along the crank, then four for the clearance motion."""
    if mechanism.exact > 0.0:
        for row in range(at.N_BODY):
            for k in range(5):
                test[row, k] = motion[row, k]
        return
    clear(test)
    for row in range(at.N_BODY):
        test[row, 0] = motion[row, 0]
    for row in (at.E_X, at.OV_X):
        # F_43 has no part along Z here, so it drops out only where vane and ring keep together along X.
        test[row, 0] = -motion[at.S3_Z, at.VALUE] * motion[at.THETA_B, 0] - motion[at.S3_X, 0]
    if mechanism.exact < 0.0:
        fill_printed_tests(mechanism, motion, test)
        return
    s2_x, s2_z = motion[at.S2_X, at.VALUE], motion[at.S2_Z, at.VALUE]
    d_x = s2_x - motion[at.S1_X, at.VALUE]
    d_y = motion[at.S2_X + 1, at.VALUE] - mechanism.l_4
    d_z = s2_z - motion[at.S1_Z, at.VALUE]
    kappa = -d_y / (d_z * s2_x - d_x * s2_z)
    o3_x, o3_z = ring_centre(mechanism, s2_x, s2_z)
    test[at.THETA_B, 1] = kappa
    d_s2 = (-s2_z * kappa, 1.0, s2_x * kappa)
    d_o3 = (-o3_z * kappa, 1.0, o3_x * kappa)
    for axis in range(3):
        test[at.O2_X + axis, 1] = 0.5 * d_s2[axis]
        test[at.N_X + axis, 1] = d_s2[axis] / mechanism.l_2
        test[at.O3_X + axis, 1] = d_o3[axis]
    for row in (at.E_X, at.OV_X):
        test[row, 1] = -motion[at.S3_Z, at.VALUE] * kappa
        test[row + 1, 1] = 1.0
    theta_v = motion[at.THETA_V, at.VALUE]
    test[at.THETA_V, 2] = 1.0
    for row in (at.E_X, at.OV_X):
        test[row, 2] = mechanism.l_4 * sin(theta_v)
        test[row + 1, 2] = -mechanism.l_4 * cos(theta_v)
    test[at.PHI_X, 3] = 1.0
    test[at.OV_Y, 3] = motion[at.OV_Y, 3]
    test[at.PHI_Y, 4] = 1.0
    test[at.OV_X, 4] = motion[at.OV_X, 4]


@kernel
def fill_air(data: VsvData, t: float, memory: VsvMemory) -> None:
    """Fill the loads on the vane: those of the paper's Table 3, and those from tables."""
    mechanism, actions, segment = data.mechanism, data.actions, memory.segment
    air, places, motion = memory.scratch.air, memory.scratch.places, memory.scratch.motion
    theta_v, direction = motion[at.THETA_V, at.VALUE], memory.regime[0]
    for k in range(air.size):
        air[k] = 0.0
    past = (theta_v - mechanism.switch_angle) / mechanism.switch_width
    air[AIR_X] = mechanism.air_force_x * tanh(past)
    air[AIR_Y] = mechanism.air_force_y
    air[AIR_M] = -mechanism.air_moment * direction
    follow(places, segment, TIME, t)
    follow(places, segment, VANE, theta_v)
    follow(places, segment, CRANK_ANGLE, motion[at.THETA_A, at.VALUE])
    follow(places, segment, VANE_SPEED, motion[at.THETA_V, at.VELOCITY])
    follow(places, segment, CRANK_SPEED, motion[at.THETA_A, at.VELOCITY])
    add_terms(actions.signals, actions.terms, 0, actions.terms.size, direction, places, air)


@kernel
def slip_speed(regime: FloatArray, motion: FloatArray) -> float:
    """Return the vane speed that traction sees [rad/s]: the actual one, or fully sliding if asked."""
    if regime[1] != 0.0:
        return regime[1]
    return motion[at.THETA_V, at.VELOCITY]


@kernel
def fill_forces(data: VsvData, y: FloatArray, memory: VsvMemory) -> None:
    """Fill the force of each row and the collar's share per unit of F_cz from the joint wrench."""
    mechanism, scratch = data.mechanism, memory.scratch
    force, collar = scratch.force, scratch.collar
    direction, air = memory.regime[0], scratch.air
    for row in range(at.N_BODY):
        force[row] = mechanism.weight[row]
    force[at.E_X] = scratch.wrench[0]
    force[at.E_Y] = scratch.wrench[1]
    force[at.PHI_X] = scratch.secants[0] * (scratch.wrench[2] + air[BEND_X])
    force[at.PHI_Y] = scratch.secants[1] * (scratch.wrench[3] + air[BEND_Y])
    force[at.THETA_V] = air[AIR_M] + scratch.wrench[4]
    force[at.OV_X] = air[AIR_X]
    force[at.OV_Y] = air[AIR_Y]
    collar[at.PHI_X], collar[at.PHI_Y], collar[at.THETA_V] = thrust.moments(
        data.collar, y[2], y[3], direction
    )


@kernel
def assemble(inertias: FloatArray, scratch: Record) -> None:
    """Fill the mass matrix (5, 4) and the load (5,); row 0 belongs to the crank and gives M_d."""
    motion, test, force = scratch.motion, scratch.test, scratch.force
    mass, load = scratch.mass, scratch.load
    clear(mass)
    for i in range(5):
        load[i] = 0.0
    for row in range(at.N_BODY):
        inertia = inertias[row]
        applied = force[row] - inertia * motion[row, at.BIAS]
        for i in range(5):
            share = test[row, i]
            load[i] += share * applied
            for j in range(4):
                mass[i, j] += inertia * share * motion[row, 1 + j]


@kernel
def collar_share(test: FloatArray, collar: FloatArray, i: int) -> float:
    """Return the generalised force of a unit F_cz along test motion ``i``."""
    return (
        test[at.PHI_X, i] * collar[at.PHI_X]
        + test[at.PHI_Y, i] * collar[at.PHI_Y]
        + test[at.THETA_V, i] * collar[at.THETA_V]
    )


@inlined
def lever_lift(exact: float, motion: FloatArray) -> float:
    """Return tan θ_b, the vertical per horizontal force of the frictionless pin; 0 in ``paper``."""
    return float(-motion[at.S3_X, at.VALUE] / motion[at.S3_Z, at.VALUE]) if exact > 0.0 else 0.0


@kernel
def add_collar(mechanism: Record, scratch: Record, factor: float) -> None:
    """Add ``factor`` times the terms of the thrust collar, whose force depends on ẍ of the vane centre."""
    lift = lever_lift(mechanism.exact, scratch.motion)
    at_rest = (
        mechanism.vane_weight
        - scratch.air[AIR_Z]
        + lift
        * (scratch.wrench[0] + scratch.force[at.OV_X] - mechanism.m_v * scratch.motion[at.OV_X, at.BIAS])
    )
    for i in range(5):
        share = factor * collar_share(scratch.test, scratch.collar, i)
        scratch.load[i] += share * at_rest
        for j in range(4):
            scratch.mass[i, j] += share * lift * mechanism.m_v * scratch.motion[at.OV_X, 1 + j]


@kernel
def collar_force(mechanism: Record, scratch: Record, acceleration: FloatArray) -> float:
    """Return m_v g − F_airz + F_43z [N] for given clearance accelerations; negative means lift-off."""
    x_ov = scratch.motion[at.OV_X, at.BIAS]
    for j in range(4):
        x_ov += scratch.motion[at.OV_X, 1 + j] * acceleration[j]
    f_43x = scratch.wrench[0] + scratch.force[at.OV_X] - mechanism.m_v * x_ov
    lift = lever_lift(mechanism.exact, scratch.motion)
    return mechanism.vane_weight - scratch.air[AIR_Z] + lift * f_43x


@kernel
def set_up(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> float:
    """Fill motion table, test motions and loads; return the vane speed that traction sees [rad/s]."""
    mechanism, scratch = data.mechanism, memory.scratch
    scratch.marked = 0.0
    secants = fill_motion(mechanism, drive(data, memory.segment, t), y, scratch.motion)
    scratch.secants[0], scratch.secants[1] = secants
    if mechanism.exact < 0.0:
        scratch.secants[0] = scratch.secants[1] = 1.0
        fill_printed_motion(mechanism, y, scratch.motion, scratch.angles)
    fill_air(data, t, memory)
    fill_test_motions(mechanism, scratch.motion, scratch.test)
    return slip_speed(memory.regime, scratch.motion)


@kernel
def solve_accelerations(data: VsvData, y: FloatArray, memory: VsvMemory) -> float:
    """Solve for the clearance accelerations with the joint wrench in ``memory.scratch``.

    Where the collar would have to pull, it lets go (F_cz = 0). Returns F_cz [N].
    """
    mechanism = data.mechanism
    fill_forces(data, y, memory)
    assemble(mechanism.inertia, memory.scratch)
    if mechanism.exact < 0.0:
        add_printed_entries(mechanism, y, memory.scratch)
    add_collar(mechanism, memory.scratch, 1.0)
    f_cz = _solve(mechanism, memory.scratch)
    if f_cz < 0.0:
        add_collar(mechanism, memory.scratch, -1.0)
        _solve(mechanism, memory.scratch)
        return 0.0
    return f_cz


@kernel
def _solve(mechanism: Record, scratch: Record) -> float:
    """Solve the four clearance equations and return the collar force that follows."""
    for i in range(4):
        scratch.solved[i, 0] = scratch.load[1 + i]
        for j in range(4):
            scratch.small[i, j] = scratch.mass[1 + i, j]
    solve_in_place(scratch.small, scratch.solved, 0, 1)
    for i in range(4):
        scratch.acceleration[i] = scratch.solved[i, 0]
    return collar_force(mechanism, scratch, scratch.acceleration)


@kernel
def drive_moment(scratch: Record) -> float:
    """Return M_d [N m] from the crank row of the projected equations."""
    moment = -scratch.load[0]
    for j in range(4):
        moment += scratch.mass[0, j] * scratch.acceleration[j]
    return moment


@inlined
def accelerations(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> float:
    """Fill ``memory.scratch.acceleration`` with (ë_x, ë_y, φ̈_x, φ̈_y) and return F_cz [N]."""
    joint = memory.joint.scratch
    omega = set_up(data, t, y, memory)
    place(data, t, y, omega, memory.regime[0], memory)
    wrench(data.joint, memory.joint, joint.pose, joint.wrench)
    from_wrench(joint.wrench, memory.scratch.wrench)
    return solve_accelerations(data, y, memory)


@kernel
def fill_load_gradient(
    data: VsvData, y: FloatArray, memory: VsvMemory, f_cz: float, gradient: FloatArray
) -> None:
    """Fill columns 1 to 8 with ∂(generalised joint and collar forces)/∂y, the motion table held fixed."""
    mechanism, scratch = data.mechanism, memory.scratch
    motion, test, dw = scratch.motion, scratch.test, scratch.wrench_jacobian
    sec2_x, sec2_y = scratch.secants[0], scratch.secants[1]
    lift = lever_lift(mechanism.exact, motion) if f_cz > 0.0 else 0.0
    free_slip = 1.0 if memory.regime[1] == 0.0 else 0.0
    collar_xx, collar_yy, collar_xy = thrust.stiffness(data.collar, y[2], y[3], f_cz)
    for i in range(4):
        c_i = collar_share(test, scratch.collar, 1 + i)
        t_x = test[at.E_X, 1 + i] + c_i * lift
        t_y = test[at.E_Y, 1 + i]
        t_px = test[at.PHI_X, 1 + i]
        t_py = test[at.PHI_Y, 1 + i]
        t_v = test[at.THETA_V, 1 + i]
        d_omega = 0.0
        for k in range(8, -1, -1):
            total = t_x * dw[0, k] + t_y * dw[1, k] + t_px * sec2_x * dw[2, k] + t_py * sec2_y * dw[3, k]
            total += t_v * dw[4, k]
            if k == 8:
                d_omega = total
                continue
            if k >= 4:
                total += free_slip * d_omega * motion[at.THETA_V, k - 3]
            gradient[i, 1 + k] = total
        gradient[i, 3] += t_px * collar_xx + t_py * collar_xy
        gradient[i, 4] += t_px * collar_xy + t_py * collar_yy


@inlined
def accelerations_and_gradient(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> float:
    """As :func:`accelerations`, and leave ∂q̈/∂y in columns 1 to 8 of ``memory.scratch.solved``.

    Exact in the joint and the collar; the slow dependence of geometry and mass matrix on the
    clearance coordinates, smaller by five orders than the contact stiffness, is left out.
    """
    scratch, joint = memory.scratch, memory.joint.scratch
    omega = set_up(data, t, y, memory)
    place(data, t, y, omega, memory.regime[0], memory)
    wrench_and_jacobian(data.joint, memory.joint, joint.pose, joint.wrench, joint.jacobian)
    from_wrench(joint.wrench, scratch.wrench)
    from_jacobian(joint.jacobian, scratch.wrench_jacobian)
    f_cz = solve_accelerations(data, y, memory)
    fill_load_gradient(data, y, memory, f_cz, scratch.solved)
    for i in range(4):
        for j in range(4):
            scratch.small[i, j] = scratch.mass[1 + i, j]
    solve_in_place(scratch.small, scratch.solved, 1, 9)
    return f_cz
