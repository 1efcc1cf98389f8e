"""The full Newton-Euler system, Eqs. 20-43: four accelerations and twenty reactions at once.

Twenty-four equations for (ë_x, ë_y, φ̈_x, φ̈_y), the eighteen reactions of the paper, and F_43z and
F_cz, which follow from the pin and the vertical balance of the vane. It is assembled body by body and solved
as a whole, independently of the projected equations and of the way in which the model finds its reactions.
"""

import math

import numpy as np

from tribodyn.core.quantities import names
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.data import AIR_M, AIR_X, AIR_Y, AIR_Z, BEND_X, BEND_Y
from tribodyn.kernels.vsv.quantities import OBSERVED, REACTIONS

AGREE = 1e-9  #: Required of accelerations, forces and moments, relative to the largest of them.
F_AX, F_AY, F_AZ, M_AX, M_AZ, M_D = 4, 5, 6, 7, 8, 9
F_21, F_32, F_43 = 10, 13, 16
F_BX, F_BZ, M_BX, M_BZ, F_CZ = 19, 20, 21, 22, 23
UNKNOWNS = 24
VALUE, BIAS = at.VALUE, at.BIAS
#: Which row of the motion table gives the inertia and the weight of which equation.
EQUATIONS = {
    at.O1_X: 0,
    at.O1_Z: 2,
    at.THETA_A: 4,
    at.O2_X: 6,
    at.O2_Y: 7,
    at.O2_Z: 8,
    at.O3_X: 11,
    at.O3_Y: 12,
    at.O3_Z: 13,
    at.THETA_B: 15,
    at.OV_X: 17,
    at.OV_Y: 18,
    at.PHI_X: 20,
    at.PHI_Y: 21,
    at.THETA_V: 22,
}


def solve(vsv, mechanism, y, scratch):
    """Return the 24 unknowns from motion table, loads, collar shares and joint wrench of an instant."""
    matrix, right = np.zeros((UNKNOWNS, UNKNOWNS)), np.zeros(UNKNOWNS)
    motion = scratch.motion
    for row, equation in EQUATIONS.items():
        matrix[equation, :4] -= mechanism.inertia[row] * motion[row, 1:5]
        right[equation] += mechanism.inertia[row] * motion[row, BIAS] - mechanism.weight[row]
    _crank(mechanism, motion, matrix)
    _drag_link(mechanism, motion, matrix, right)
    _ring(vsv.lengths, motion, matrix)
    _vane(mechanism, y, scratch, matrix, right)
    return np.linalg.solve(matrix, right)


def assert_solved(vsv, mechanism, y, scratch, accelerations, row):
    """Assert that given accelerations and the reactions of an observed row are the solution."""
    full = solve(vsv, mechanism, y, scratch)
    found = np.concatenate([accelerations, row[[OBSERVED.index(name) for name in names(REACTIONS)]]])
    kinds = [0] * 4 + [1 if name.startswith("F") else 2 for name in names(REACTIONS)]
    for kind in range(3):
        chosen = np.equal(kinds, kind)
        scale = np.abs(found[chosen]).max()
        np.testing.assert_allclose(full[chosen], found[chosen], rtol=0.0, atol=AGREE * scale)


def _crank(mechanism, motion, matrix):
    """Equations 20 to 25; arms from the mass centre O_1."""
    theta_a = motion[at.THETA_A, VALUE]
    x_a, z_a = 0.5 * mechanism.l_1 * math.sin(theta_a), -0.5 * mechanism.l_1 * math.cos(theta_a)
    x_1, z_1 = -x_a, -z_a
    matrix[0, [F_AX, F_21]] = 1.0
    matrix[1, [F_AY, F_21 + 1]] = 1.0
    matrix[2, [F_AZ, F_21 + 2]] = 1.0
    matrix[3, [F_AY, F_21 + 1, M_AX]] = -z_a, -z_1, 1.0
    matrix[4, [F_AZ, F_AX, F_21 + 2, F_21, M_D]] = x_a, -z_a, x_1, -z_1, 1.0
    matrix[5, [F_AY, F_21 + 1, M_AZ]] = x_a, x_1, 1.0


def _drag_link(mechanism, motion, matrix, right):
    """Equations 26 to 31, the moments projected on two directions across the thin rod.

    The inertia moment is −J n × n̈, so every term of the moment balance is n × (…), and the balance
    says that (l_2/2)(F_32 + F_21) − J n̈ has no part across n.
    """
    for axis in range(3):
        matrix[6 + axis, [F_32 + axis, F_21 + axis]] = 1.0, -1.0
    rod = slice(at.N_X, at.N_Z + 1)
    n_x, n_y, n_z = motion[rod, VALUE]
    # The drag link never points along Y, so these two span the plane across it.
    first = np.array([n_z, 0.0, -n_x])
    second = np.array([n_x * n_y, -(n_x * n_x + n_z * n_z), n_y * n_z])
    for equation, across in ((9, first), (10, second)):
        for force in (F_32, F_21):
            matrix[equation, force : force + 3] = 0.5 * mechanism.l_2 * across
        matrix[equation, :4] -= mechanism.link_inertia * across @ motion[rod, 1:5]
        right[equation] += mechanism.link_inertia * across @ motion[rod, BIAS]


def _ring(lengths, motion, matrix):
    """Equations 32 to 37 with F_43z; arms from the mass centre O_3."""
    radius, angle = (
        0.5 * lengths.l_3 * math.cos(0.5 * lengths.phi),
        motion[at.THETA_B, VALUE] - 0.5 * lengths.phi,
    )
    o3 = np.array([-radius * math.sin(angle), radius * math.cos(angle)])
    x_2, z_2 = motion[[at.S2_X, at.S2_Z], VALUE] - o3
    x_3, z_3 = motion[[at.S3_X, at.S3_Z], VALUE] - o3
    x_b, z_b = -o3
    for axis in range(3):
        matrix[11 + axis, [F_43 + axis, F_32 + axis]] = 1.0, -1.0
    matrix[11, F_BX] = matrix[13, F_BZ] = 1.0
    matrix[14, [F_32 + 1, F_43 + 1, M_BX]] = z_2, -z_3, 1.0
    matrix[15, [F_32, F_32 + 2, F_BX, F_BZ, F_43, F_43 + 2]] = z_2, -x_2, -z_b, x_b, -z_3, x_3
    matrix[16, [F_43 + 1, F_32 + 1, M_BZ]] = x_3, -x_2, 1.0


def _vane(mechanism, y, scratch, matrix, right):
    """Equations 38 to 43 and the condition of the frictionless pin."""
    motion, collar, joint, air = scratch.motion, scratch.collar, scratch.wrench, scratch.air
    tan_x, tan_y = np.tan(y[2:4])
    sec2_x, sec2_y = 1.0 + tan_x**2, 1.0 + tan_y**2
    arm_x, arm_y = mechanism.vane_arm * sec2_x, mechanism.vane_arm * sec2_y
    lever, l_4, half = mechanism.exact, mechanism.l_4, mechanism.half_length
    sin_v, cos_v = math.sin(motion[at.THETA_V, VALUE]), math.cos(motion[at.THETA_V, VALUE])
    forces = [F_43, F_43 + 1, F_43 + 2, F_CZ]
    matrix[17, F_43] = matrix[18, F_43 + 1] = -1.0
    right[17] -= joint[0] + air[AIR_X]
    right[18] -= joint[1] + air[AIR_Y]
    matrix[19, F_CZ] = 1.0
    if scratch.f_cz > 0.0:
        matrix[19, F_43 + 2] = -1.0
        right[19] += mechanism.vane_weight - air[AIR_Z]
    matrix[20, forces] = 0.0, lever * half * sec2_x, -lever * l_4 * sin_v * sec2_x, collar[at.PHI_X]
    matrix[21, forces] = lever * half * sec2_y, 0.0, -lever * l_4 * cos_v * sec2_y, collar[at.PHI_Y]
    right[20] -= sec2_x * (joint[2] + air[BEND_X]) + arm_x * air[AIR_Y]
    right[21] -= sec2_y * (joint[3] + air[BEND_Y]) + arm_y * air[AIR_X]
    for equation, arm, row in ((20, arm_x, at.OV_Y), (21, arm_y, at.OV_X)):
        matrix[equation, :4] -= arm * mechanism.m_v * motion[row, 1:5]
        right[equation] += arm * mechanism.m_v * motion[row, BIAS]
    raised = -lever * l_4 * (cos_v * tan_x - sin_v * tan_y)
    matrix[22, forces] = l_4 * sin_v, -l_4 * cos_v, raised, collar[at.THETA_V]
    right[22] -= joint[4] + air[AIR_M]
    matrix[23, [F_43 + 2, F_43]] = 1.0, -lever * math.tan(motion[at.THETA_B, VALUE])
