"""The full Newton-Euler system, Eqs. 20-43: four accelerations and twenty reactions at once.

Twenty-four equations for (ë_x, ë_y, φ̈_x, φ̈_y), the eighteen reactions of the paper, and F_43z and
F_cz, which follow from the pin and the vertical balance of the vane. It is assembled body by body,
independently of the projected equations, and gives the reactions.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from mebdf.kernels.elementary import cos, sin, tan
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.linalg import solve_in_place
from tribodyn.kernels.vsv.data import AIR_M, AIR_X, AIR_Y, AIR_Z, BEND_X, BEND_Y, VsvMemory
from tribodyn.kernels.vsv.equations import ring_centre
from tribodyn.kernels.vsv.layout import (
    BIAS,
    N_X,
    O1_X,
    O1_Z,
    O2_X,
    O2_Y,
    O2_Z,
    O3_X,
    O3_Y,
    O3_Z,
    OV_X,
    OV_Y,
    PHI_X,
    PHI_Y,
    S2_X,
    S2_Z,
    S3_X,
    S3_Z,
    THETA_A,
    THETA_B,
    THETA_V,
    VALUE,
)

F_AX, F_AY, F_AZ, M_AX, M_AZ, M_D = 4, 5, 6, 7, 8, 9
F_21, F_32, F_43 = 10, 13, 16
F_BX, F_BZ, M_BX, M_BZ, F_CZ = 19, 20, 21, 22, 23


ROWS_OF_EQUATIONS: Final = np.array(
    [
        (O1_X, 0),
        (O1_Z, 2),
        (THETA_A, 4),
        (O2_X, 6),
        (O2_Y, 7),
        (O2_Z, 8),
        (O3_X, 11),
        (O3_Y, 12),
        (O3_Z, 13),
        (THETA_B, 15),
        (OV_X, 17),
        (OV_Y, 18),
        (PHI_X, 20),
        (PHI_Y, 21),
        (THETA_V, 22),
    ]
)
"""Which row of the motion table gives the inertia and the weight of which equation."""


@kernel
def _inertia_and_weight(mechanism: Record, motion: FloatArray, matrix: FloatArray, rhs: FloatArray) -> None:
    """Enter −m a and the weight of every mass centre and rotation into its equation."""
    for k in range(ROWS_OF_EQUATIONS.shape[0]):
        row, equation = ROWS_OF_EQUATIONS[k, 0], ROWS_OF_EQUATIONS[k, 1]
        for j in range(4):
            matrix[equation, j] -= mechanism.inertia[row] * motion[row, 1 + j]
        rhs[equation, 0] += mechanism.inertia[row] * motion[row, BIAS] - mechanism.weight[row]


@kernel
def _crank(mechanism: Record, motion: FloatArray, matrix: FloatArray) -> None:
    """Equations 20 to 25; arms from the mass centre O_1."""
    theta_a = motion[THETA_A, VALUE]
    x_a = 0.5 * mechanism.l_1 * sin(theta_a)
    z_a = -0.5 * mechanism.l_1 * cos(theta_a)
    x_1, z_1 = -x_a, -z_a
    matrix[0, F_AX] = 1.0
    matrix[0, F_21] = 1.0
    matrix[1, F_AY] = 1.0
    matrix[1, F_21 + 1] = 1.0
    matrix[2, F_AZ] = 1.0
    matrix[2, F_21 + 2] = 1.0
    matrix[3, F_AY] = -z_a
    matrix[3, F_21 + 1] = -z_1
    matrix[3, M_AX] = 1.0
    matrix[4, F_AZ] = x_a
    matrix[4, F_AX] = -z_a
    matrix[4, F_21 + 2] = x_1
    matrix[4, F_21] = -z_1
    matrix[4, M_D] = 1.0
    matrix[5, F_AY] = x_a
    matrix[5, F_21 + 1] = x_1
    matrix[5, M_AZ] = 1.0


@kernel
def _drag_link(mechanism: Record, motion: FloatArray, matrix: FloatArray, rhs: FloatArray) -> None:
    """Equations 26 to 31, the moments projected on two directions across the thin rod.

    The inertia moment is −J n × n̈, so every term of the moment balance is n × (…), and the balance
    says that (l_2/2)(F_32 + F_21) − J n̈ has no part across n.
    """
    for axis in range(3):
        matrix[6 + axis, F_32 + axis] = 1.0
        matrix[6 + axis, F_21 + axis] = -1.0
    n_x, n_y, n_z = motion[N_X, VALUE], motion[N_X + 1, VALUE], motion[N_X + 2, VALUE]
    # The drag link never points along Y, so these two span the plane across it.
    first = (n_z, 0.0, -n_x)
    second = (n_x * n_y, -(n_x * n_x + n_z * n_z), n_y * n_z)
    for eq, across in ((9, first), (10, second)):
        for axis in range(3):
            row = N_X + axis
            matrix[eq, F_32 + axis] = 0.5 * mechanism.l_2 * across[axis]
            matrix[eq, F_21 + axis] = 0.5 * mechanism.l_2 * across[axis]
            for j in range(4):
                matrix[eq, j] -= across[axis] * mechanism.link_inertia * motion[row, 1 + j]
            rhs[eq, 0] += across[axis] * mechanism.link_inertia * motion[row, BIAS]


@kernel
def _ring(mechanism: Record, motion: FloatArray, matrix: FloatArray) -> None:
    """Equations 32 to 37 with F_43z; arms from the mass centre O_3."""
    o3_x, o3_z = ring_centre(mechanism.l_3, mechanism.ring_angle, motion[THETA_B, VALUE])
    x_2, z_2 = motion[S2_X, VALUE] - o3_x, motion[S2_Z, VALUE] - o3_z
    x_3, z_3 = motion[S3_X, VALUE] - o3_x, motion[S3_Z, VALUE] - o3_z
    x_b, z_b = -o3_x, -o3_z
    for axis in range(3):
        matrix[11 + axis, F_43 + axis] = 1.0
        matrix[11 + axis, F_32 + axis] = -1.0
    matrix[11, F_BX] = 1.0
    matrix[13, F_BZ] = 1.0
    matrix[14, F_32 + 1] = z_2
    matrix[14, F_43 + 1] = -z_3
    matrix[14, M_BX] = 1.0
    matrix[15, F_32] = z_2
    matrix[15, F_32 + 2] = -x_2
    matrix[15, F_BX] = -z_b
    matrix[15, F_BZ] = x_b
    matrix[15, F_43] = -z_3
    matrix[15, F_43 + 2] = x_3
    matrix[16, F_43 + 1] = x_3
    matrix[16, F_32 + 1] = -x_2
    matrix[16, M_BZ] = 1.0


@kernel
def _vane(
    mechanism: Record,
    y: FloatArray,
    memory: VsvMemory,
    lifted: float,
    matrix: FloatArray,
    rhs: FloatArray,
) -> None:
    """Equations 38 to 43 and the condition of the frictionless pin."""
    scratch = memory.scratch
    motion, collar, joint = scratch.motion, scratch.collar, scratch.wrench
    air, theta_v = scratch.air, motion[THETA_V, VALUE]
    f_x, f_y = air[AIR_X], air[AIR_Y]
    tan_x, tan_y = tan(y[2]), tan(y[3])
    sec2_x, sec2_y = 1.0 + tan_x * tan_x, 1.0 + tan_y * tan_y
    arm_x, arm_y = mechanism.vane_arm * sec2_x, mechanism.vane_arm * sec2_y
    lever = mechanism.exact
    sin_v, cos_v = sin(theta_v), cos(theta_v)

    matrix[17, F_43] = -1.0
    rhs[17, 0] -= joint[0] + f_x
    matrix[18, F_43 + 1] = -1.0
    rhs[18, 0] -= joint[1] + f_y
    matrix[19, F_CZ] = 1.0
    if lifted == 0.0:
        matrix[19, F_43 + 2] = -1.0
        rhs[19, 0] += mechanism.vane_weight - air[AIR_Z]

    matrix[20, F_43 + 1] = lever * mechanism.half_length * sec2_x
    matrix[20, F_43 + 2] = -lever * mechanism.l_4 * sin_v * sec2_x
    matrix[20, F_CZ] = collar[PHI_X]
    rhs[20, 0] -= sec2_x * (joint[2] + air[BEND_X]) + arm_x * f_y
    matrix[21, F_43] = lever * mechanism.half_length * sec2_y
    matrix[21, F_43 + 2] = -lever * mechanism.l_4 * cos_v * sec2_y
    matrix[21, F_CZ] = collar[PHI_Y]
    rhs[21, 0] -= sec2_y * (joint[3] + air[BEND_Y]) + arm_y * f_x
    for j in range(4):
        matrix[20, j] -= arm_x * mechanism.m_v * motion[OV_Y, 1 + j]
        matrix[21, j] -= arm_y * mechanism.m_v * motion[OV_X, 1 + j]
    rhs[20, 0] += arm_x * mechanism.m_v * motion[OV_Y, BIAS]
    rhs[21, 0] += arm_y * mechanism.m_v * motion[OV_X, BIAS]

    matrix[22, F_43] = mechanism.l_4 * sin_v
    matrix[22, F_43 + 1] = -mechanism.l_4 * cos_v
    matrix[22, F_43 + 2] = -lever * mechanism.l_4 * (cos_v * tan_x - sin_v * tan_y)
    matrix[22, F_CZ] = collar[THETA_V]
    rhs[22, 0] -= joint[4] + air[AIR_M]

    matrix[23, F_43 + 2] = 1.0
    matrix[23, F_43] = -lever * tan(motion[THETA_B, VALUE])


@kernel
def newton_euler(mechanism: Record, y: FloatArray, memory: VsvMemory, lifted: float) -> None:
    """Fill ``memory.scratch.reactions`` (24, 1) from the motion table and joint wrench in scratch.

    Parameters
    ----------
    mechanism
        Constants.
    y
        State, shape (8,).
    memory
        Holds motion table, loads, collar shares and joint wrench of this instant.
    lifted
        1 where the collar has let go (F_cz = 0), 0 otherwise.
    """
    matrix, rhs = memory.scratch.system, memory.scratch.reactions
    motion = memory.scratch.motion
    clear(matrix)
    clear(rhs)
    _inertia_and_weight(mechanism, motion, matrix, rhs)
    _crank(mechanism, motion, matrix)
    _drag_link(mechanism, motion, matrix, rhs)
    _ring(mechanism, motion, matrix)
    _vane(mechanism, y, memory, lifted, matrix, rhs)
    solve_in_place(matrix, rhs, 0, 1)
