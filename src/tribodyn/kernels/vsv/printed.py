"""Equation 46 and Appendix 2 as printed: what formulation ``printed`` has in place of ``paper``.

Only symbols that the paper does not define are replaced: α by φ, θ_s1z by θ_sz and α_4 by θ̈_v. The rows of
Eq. 46 are in the order of ``paper``: 1, 4, 2, 3, all with the opposite sign. Most of them is a sum over the
rows of the motion table like those of the other formulations; :func:`add_printed_entries` adds the rest.
"""

import math

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import atan2, cos, sin
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.data import AIR_X


@kernel
def _fill_link_angles(motion: FloatArray, angles: FloatArray) -> None:
    """Fill θ_sz and θ_sx of the drag link in the frame of the crank, their rates and accelerations (2, 3).

    θ_sx is near zero, as the arctangent of Eq. 56 has it; θ_sz has the sign of the link's x.
    """
    omega_a, alpha_a = motion[at.THETA_A, at.VELOCITY], motion[at.THETA_A, at.BIAS]
    c, s = cos(motion[at.THETA_A, at.VALUE]), sin(motion[at.THETA_A, at.VALUE])
    x, y, z = motion[at.N_X, at.VALUE], motion[at.N_Y, at.VALUE], motion[at.N_Z, at.VALUE]
    x_1, y_1, z_1 = motion[at.N_X, at.VELOCITY], motion[at.N_Y, at.VELOCITY], motion[at.N_Z, at.VELOCITY]
    x_2, y_2, z_2 = motion[at.N_X, at.BIAS], motion[at.N_Y, at.BIAS], motion[at.N_Z, at.BIAS]
    u, w = x * c + z * s, z * c - x * s
    u_1, w_1 = x_1 * c + z_1 * s + omega_a * w, z_1 * c - x_1 * s - omega_a * u
    u_2 = x_2 * c + z_2 * s + omega_a * (2.0 * w_1 + omega_a * u) + alpha_a * w
    w_2 = z_2 * c - x_2 * s - omega_a * (2.0 * u_1 - omega_a * w) - alpha_a * u
    side = math.copysign(1.0, u)
    square = u * u + y * y
    across = side * math.sqrt(square)
    angles[0, 0], angles[1, 0] = atan2(across, w), atan2(side * y, side * u)
    angles[0, 1] = -w_1 / across
    angles[0, 2] = -(w_2 + w * angles[0, 1] * angles[0, 1]) / across
    angles[1, 1] = (u * y_1 - y * u_1) / square
    angles[1, 2] = (u * y_2 - y * u_2 - 2.0 * angles[1, 1] * (u * u_1 + y * y_1)) / square


@kernel
def fill_printed_motion(mechanism: Record, y: FloatArray, motion: FloatArray, angles: FloatArray) -> None:
    """Fill the accelerations that Appendix 2 prints for the drag link, and its place of the vane centre."""
    theta_a, omega_a, alpha_a = (
        motion[at.THETA_A, at.VALUE],
        motion[at.THETA_A, at.VELOCITY],
        motion[at.THETA_A, at.BIAS],
    )
    c, s = cos(theta_a), sin(theta_a)
    _fill_link_angles(motion, angles)
    cz, sz, cx, sx = cos(angles[0, 0]), sin(angles[0, 0]), cos(angles[1, 0]), sin(angles[1, 0])
    z_1, z_2, x_1, x_2 = angles[0, 1], angles[0, 2], angles[1, 1], angles[1, 2]
    l_1, half = mechanism.l_1, 0.5 * mechanism.l_2
    motion[at.O2_X, at.BIAS] = (
        -alpha_a * (s * sz * cx + cz * c - l_1 * s)
        - omega_a * omega_a * (sz * cx * c - s * cz - l_1 * c)
        + half
        * (
            z_2 * (cz * cx * c + s * sz)
            - z_1 * omega_a * (2.0 * s * cz * cx - c * sz)
            + x_1 * omega_a * (2.0 * s * sz * sx)
            - (z_1 * z_1 + x_1 * x_1) * sz * cx * c
            + z_1 * z_1 * s * cz
            - 2.0 * z_1 * x_1 * cz * sx * c
            - x_2 * sz * sx * c
        )
    )
    both_c, both_s = cz * c - sz * s, sz * c + cz * s
    motion[at.O2_Z, at.BIAS] = (
        alpha_a * (-l_1 * s - half * both_s)
        - omega_a * omega_a * (l_1 * c + half * both_c)
        - half * z_2 * both_s
        - half * z_1 * z_1 * both_c
        - 2.0 * half * z_1 * omega_a * both_c
    )
    arm = mechanism.vane_arm
    for row, k, column in ((at.OV_X, 3, 4), (at.OV_Y, 2, 3)):
        cosine, sine, rate = cos(y[k]), sin(y[k]), y[4 + k]
        motion[row, column] = arm * cosine
        motion[row, at.BIAS] = -arm * rate * rate * sine
        motion[row, at.VELOCITY] = y[row - at.OV_X + 4] + arm * cosine * rate
        motion[row, at.VALUE] = y[row - at.OV_X] + arm * sine


@kernel
def _ring_arms(mechanism: Record, motion: FloatArray) -> tuple[float, float, float, float, float]:
    """Return X and Z of S_2 − B, X and Z of B, and Z of S_3 from the mass centre of the ring [m], part 3."""
    l_3 = mechanism.l_3
    c_3, s_3 = cos(motion[at.THETA_B, at.VALUE]), sin(motion[at.THETA_B, at.VALUE])
    c_2 = c_3 * mechanism.ring_cos + s_3 * mechanism.ring_sin
    s_2 = s_3 * mechanism.ring_cos - c_3 * mechanism.ring_sin
    b_x, b_z = -0.25 * l_3 * (c_3 + c_2), -0.25 * l_3 * (s_3 + s_2)
    return l_3 * c_2, l_3 * s_2, b_x, b_z, l_3 * s_3 + b_z


@kernel
def fill_printed_tests(mechanism: Record, motion: FloatArray, test: FloatArray) -> None:
    """Fill columns 1 to 4 of the test motions with Loc_1 to Loc_5 of Appendix 2."""
    n_x, n_y, n_z = motion[at.N_X, at.VALUE], motion[at.N_Y, at.VALUE], motion[at.N_Z, at.VALUE]
    l_2, l_4, theta_v = mechanism.l_2, mechanism.l_4, motion[at.THETA_V, at.VALUE]
    out_x, out_z, _, b_z, s3_z = _ring_arms(mechanism, motion)
    x, y, z = -l_2 * n_x, -l_2 * n_y, l_2 * n_z
    bottom = out_z * x + out_x * z
    ratio = y / bottom
    loc_1, loc_2 = ratio * (b_z - s3_z), ratio * b_z
    loc_3 = -0.5 * z * out_x * y / (-out_z * x * x - x * out_x * z) - 0.5 * y / x
    s3_x, s3_y = l_4 * cos(theta_v), l_4 * sin(theta_v)
    for column, share in ((1, 1.0), (2, s3_x)):
        test[at.E_X, column] = test[at.OV_X, column] = share * loc_1
        test[at.O3_X, column], test[at.O2_X, column] = share * loc_2, share * loc_3
        test[at.O2_Y, column] = share * 0.5
        test[at.O3_Y, column] = share
        test[at.THETA_B, column] = share * ratio
        test[at.O3_Z, column] = -share * ratio * b_z
        test[at.O2_Z, column] = share * ratio * 0.5 * out_x
    test[at.E_Y, 1] = test[at.OV_Y, 1] = 1.0
    test[at.E_X, 2] += s3_y
    test[at.OV_X, 2] += s3_y
    test[at.THETA_V, 2] = 1.0
    test[at.PHI_X, 3] = test[at.PHI_Y, 4] = 1.0
    test[at.OV_Y, 3] = test[at.OV_X, 4] = mechanism.vane_arm


@kernel
def add_printed_entries(mechanism: Record, y: FloatArray, scratch: Record) -> None:
    """Add the printed extra terms of A_12, A_42, B_11 and B_41, and subtract the missing ones of B_41."""
    motion, test, angles = scratch.motion, scratch.test, scratch.angles
    mass, load = scratch.mass, scratch.load
    m_2, m_3, m_v = mechanism.m_2, mechanism.m_3, mechanism.m_v
    s3_x, s3_y = test[at.O3_Y, 2], mechanism.l_4 * sin(motion[at.THETA_V, at.VALUE])
    mass[1, 1] += 0.5 * m_2 - m_3
    mass[2, 1] -= 0.5 * s3_x * m_3
    cone = angles[1, 1] * angles[1, 1] * angles[0, 0] - angles[0, 2]
    swing = 2.0 * angles[0, 1] * angles[1, 1] + angles[1, 2] * angles[0, 0]
    m_2y = -mechanism.link_inertia * (swing * sin(angles[1, 0]) + cone * cos(angles[1, 0]))
    arm = test[at.O2_Z, 1] * 2.0 / (mechanism.l_2 * motion[at.N_X, at.VALUE])
    load[1] += arm * m_2y
    par_x2, par_y2 = motion[at.O2_X, at.BIAS], motion[at.O2_Y, at.BIAS]
    load[2] += s3_x * (
        arm * m_2y
        + m_2 * test[at.O2_Y, 1] * (par_y2 - par_x2)
        + m_3 * (motion[at.O3_Y, at.BIAS] - motion[at.O3_X, at.BIAS])
    )
    spin = y[7] * y[7] * sin(y[3])
    load[2] += s3_y * (m_v * (1.0 - mechanism.vane_arm) * spin - scratch.air[AIR_X])
