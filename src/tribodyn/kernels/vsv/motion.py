"""Motion of the crank, and positions, velocities and accelerations of every body, section 2.2 of the paper.

``exact``: everything follows from the closure with the trunnion where it is; derivatives by
implicit differentiation. ``paper``: the rods follow the ideal closure and the clearance motion
shifts O2 by (e_x/2, e_y/2) and O3 by (e_x/2, e_y), Appendix 2.
"""

from typing import Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import atan2, cos, sin, tan
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import evaluate, held
from tribodyn.kernels.jit import clear, kernel
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.closure import ring_end, sinusoid, vane_attitude
from tribodyn.kernels.vsv.data import CRANK, TIME, VsvData


@kernel
def drive(data: VsvData, segment: Record, t: float) -> tuple[float, float, float]:
    """Return crank angle [rad], speed [rad/s] and acceleration [rad/s²] at ``t`` [s] within a segment."""
    if data.mechanism.tabulated == 0.0:
        return sinusoid(data.mechanism, t)
    return _tabulated(data, segment, t)


@kernel
def _tabulated(data: VsvData, segment: Record, t: float) -> tuple[float, float, float]:
    """Return the same from the signal.

    Apart, because whatever reaches into ``data.actions`` pays for it on every path: its arrays are counted.
    """
    return evaluate(data.actions.signals, CRANK, t, held(segment, TIME, t))


#: Angle of the crank [rad], its speed [rad/s] and acceleration [rad/s²].
Crank: TypeAlias = tuple[float, float, float]
Four: TypeAlias = tuple[float, float, float, float]

CENTRED: Final = (0.0, 0.0, 0.0, 0.0)  #: Place, and rates, of a trunnion in the middle of its bushing.
SHIFTED: Final = np.array([at.O2_X, at.O2_Y, at.O3_X, at.O3_Y])
SHIFTS: Final = np.array([0, 1, 0, 1])
#: Rows that the clearance motion shifts in ``paper``, by which coordinate and by how much of it.
SHARES: Final = np.array([0.5, 0.5, 0.5, 1.0])


@kernel
def fill_motion(mechanism: Record, crank: Crank, y: FloatArray, motion: FloatArray) -> tuple[float, float]:
    """Fill the motion table at a motion of the crank and a state (8,); return sec² φ_x and sec² φ_y."""
    clear(motion)
    tan_x, tan_y = tan(y[2]), tan(y[3])
    if mechanism.exact > 0.0:
        _fill_trunnion(mechanism, y, tan_x, tan_y, motion)
        fill_rods(mechanism, crank, (y[0], y[1], tan_x, tan_y), (y[4], y[5], y[6], y[7]), motion)
    else:
        fill_rods(mechanism, crank, CENTRED, CENTRED, motion)
        for row in range(at.S3_Z + 1):
            for column in range(1, 5 if row < at.E_X or row >= at.S1_X else 1):
                motion[row, column] = 0.0
        _fill_trunnion(mechanism, y, tan_x, tan_y, motion)
        for k in range(SHIFTED.size):
            row, coordinate, share = SHIFTED[k], SHIFTS[k], SHARES[k]
            motion[row, 1 + coordinate] = share
            motion[row, at.VALUE] += share * y[coordinate]
            motion[row, at.VELOCITY] += share * y[4 + coordinate]
    return 1.0 + tan_x * tan_x, 1.0 + tan_y * tan_y


@kernel
def _fill_trunnion(mechanism: Record, y: FloatArray, tan_x: float, tan_y: float, motion: FloatArray) -> None:
    """Fill the rows of the trunnion and of the vane centre O_v."""
    for k in range(4):
        motion[at.E_X + k, 1 + k] = 1.0
        motion[at.E_X + k, at.VELOCITY] = y[4 + k]
        motion[at.E_X + k, at.VALUE] = y[k]
    arm = mechanism.vane_arm
    sec2_x = 1.0 + tan_x * tan_x
    sec2_y = 1.0 + tan_y * tan_y
    motion[at.OV_X, 1] = 1.0
    motion[at.OV_X, 4] = arm * sec2_y
    motion[at.OV_X, at.VELOCITY] = y[4] + arm * sec2_y * y[7]
    motion[at.OV_X, at.BIAS] = 2.0 * arm * sec2_y * tan_y * y[7] * y[7]
    motion[at.OV_X, at.VALUE] = y[0] + arm * tan_y
    motion[at.OV_Y, 2] = 1.0
    motion[at.OV_Y, 3] = arm * sec2_x
    motion[at.OV_Y, at.VELOCITY] = y[5] + arm * sec2_x * y[6]
    motion[at.OV_Y, at.BIAS] = 2.0 * arm * sec2_x * tan_x * y[6] * y[6]
    motion[at.OV_Y, at.VALUE] = y[1] + arm * tan_x


@kernel
def fill_rods(mechanism: Record, crank: Crank, place: Four, rates: Four, motion: FloatArray) -> None:
    """Fill the rows of crank, drag link, ring and vane rotation from the closure.

    The place is e_x and e_y [m], tan φ_x and tan φ_y; rates are those of e_x, e_y, φ_x and φ_y.
    """
    theta_a, omega_a, alpha_a = crank
    e_x, e_y, tan_x, tan_y = place
    phi_x_dot, phi_y_dot = rates[2], rates[3]
    sec2_x = 1.0 + tan_x * tan_x
    sec2_y = 1.0 + tan_y * tan_y
    l_4 = mechanism.l_4
    half = mechanism.half_length
    sin_a = sin(theta_a)
    cos_a = cos(theta_a)
    s1_x = mechanism.pivot_x - mechanism.l_1 * sin_a
    s1_z = mechanism.pivot_z + mechanism.l_1 * cos_a
    s1_x_a = -mechanism.l_1 * cos_a
    s1_z_a = -mechanism.l_1 * sin_a
    theta_v, sin_v, cos_v = vane_attitude(mechanism, theta_a, s1_x, s1_z, e_x, e_y, tan_x, tan_y)

    x3 = e_x + l_4 * cos_v - half * tan_y
    y3 = e_y + l_4 * sin_v - half * tan_x
    z3 = mechanism.l_3 + l_4 * (sin_v * tan_x + cos_v * tan_y)
    inverse = 1.0 / (x3 * x3 + z3 * z3)
    theta_b = atan2(-x3, z3)
    s2_x, s2_z = ring_end(mechanism, x3, z3)
    d_x = s2_x - s1_x
    d_y = y3 - l_4
    d_z = s2_z - s1_z

    # Partial derivatives along θ_v alone.
    x3_v = -l_4 * sin_v
    y3_v = l_4 * cos_v
    z3_v = l_4 * (cos_v * tan_x - sin_v * tan_y)
    b_v = (-z3 * x3_v + x3 * z3_v) * inverse
    g_v = (d_z * s2_x - d_x * s2_z) * b_v + d_y * y3_v

    over = 1.0 / g_v
    speeds = (omega_a, rates[0], rates[1], rates[2], rates[3])
    for k in range(5):
        x3_k = 1.0 if k == 1 else (-half * sec2_y if k == 4 else 0.0)
        y3_k = 1.0 if k == 2 else (-half * sec2_x if k == 3 else 0.0)
        z3_k = l_4 * sin_v * sec2_x if k == 3 else (l_4 * cos_v * sec2_y if k == 4 else 0.0)
        b_k = (-z3 * x3_k + x3 * z3_k) * inverse
        g_k = (d_z * s2_x - d_x * s2_z) * b_k + d_y * y3_k
        if k == 0:
            g_k -= d_x * s1_x_a + d_z * s1_z_a
        v_k = -g_k * over
        motion[at.THETA_V, k] = v_k
        motion[at.THETA_B, k] = b_k + b_v * v_k
        motion[at.S3_X, k] = x3_k + x3_v * v_k
        motion[at.S3_Y, k] = y3_k + y3_v * v_k
        motion[at.S3_Z, k] = z3_k + z3_v * v_k
    motion[at.THETA_A, 0] = 1.0
    motion[at.S1_X, 0] = s1_x_a
    motion[at.S1_Z, 0] = s1_z_a
    for row in (at.THETA_A, at.THETA_V, at.THETA_B, at.S1_X, at.S1_Z, at.S3_X, at.S3_Y, at.S3_Z):
        for k in range(5):
            motion[row, at.VELOCITY] += motion[row, k] * speeds[k]

    motion[at.THETA_A, at.VALUE] = theta_a
    motion[at.THETA_A, at.BIAS] = alpha_a
    motion[at.THETA_V, at.VALUE] = theta_v
    motion[at.THETA_B, at.VALUE] = theta_b
    motion[at.S1_X, at.VALUE] = s1_x
    motion[at.S1_Z, at.VALUE] = s1_z
    motion[at.S1_X, at.BIAS] = s1_x_a * alpha_a + mechanism.l_1 * sin_a * omega_a * omega_a
    motion[at.S1_Z, at.BIAS] = s1_z_a * alpha_a - mechanism.l_1 * cos_a * omega_a * omega_a
    motion[at.S3_X, at.VALUE] = x3
    motion[at.S3_Y, at.VALUE] = y3
    motion[at.S3_Z, at.VALUE] = z3

    # Accelerations with the clearance accelerations zero: first with θ̈_v = 0, then θ̈_v from the closure.
    omega_v = motion[at.THETA_V, at.VELOCITY]
    omega_b = motion[at.THETA_B, at.VELOCITY]
    tan_x_1 = sec2_x * phi_x_dot
    tan_y_1 = sec2_y * phi_y_dot
    tan_x_2 = 2.0 * tan_x * tan_x_1 * phi_x_dot
    tan_y_2 = 2.0 * tan_y * tan_y_1 * phi_y_dot
    x3_2 = -l_4 * cos_v * omega_v * omega_v - half * tan_y_2
    y3_2 = -l_4 * sin_v * omega_v * omega_v - half * tan_x_2
    z3_2 = l_4 * (
        -(sin_v * tan_x + cos_v * tan_y) * omega_v * omega_v
        + 2.0 * omega_v * (cos_v * tan_x_1 - sin_v * tan_y_1)
        + sin_v * tan_x_2
        + cos_v * tan_y_2
    )
    x3_1 = motion[at.S3_X, at.VELOCITY]
    y3_1 = motion[at.S3_Y, at.VELOCITY]
    z3_1 = motion[at.S3_Z, at.VELOCITY]
    b_2 = (-z3 * x3_2 + x3 * z3_2 - 2.0 * omega_b * (x3 * x3_1 + z3 * z3_1)) * inverse
    dot_x = -s2_z * omega_b - motion[at.S1_X, at.VELOCITY]
    dot_z = s2_x * omega_b - motion[at.S1_Z, at.VELOCITY]
    speed2 = dot_x * dot_x + y3_1 * y3_1 + dot_z * dot_z
    ddot_x = -s2_z * b_2 - s2_x * omega_b * omega_b - motion[at.S1_X, at.BIAS]
    ddot_z = s2_x * b_2 - s2_z * omega_b * omega_b - motion[at.S1_Z, at.BIAS]
    v_2 = -(d_x * ddot_x + d_y * y3_2 + d_z * ddot_z + speed2) * over
    motion[at.THETA_V, at.BIAS] = v_2
    motion[at.THETA_B, at.BIAS] = b_2 + b_v * v_2
    motion[at.S3_X, at.BIAS] = x3_2 + x3_v * v_2
    motion[at.S3_Y, at.BIAS] = y3_2 + y3_v * v_2
    motion[at.S3_Z, at.BIAS] = z3_2 + z3_v * v_2
    _fill_bodies(mechanism, motion, s2_x, s2_z, omega_b)


@kernel
def _fill_bodies(mechanism: Record, motion: FloatArray, s2_x: float, s2_z: float, omega_b: float) -> None:
    """Fill S2, the mass centres O1, O2, O3 and the direction n of the drag link."""
    o3_x, o3_z = ring_centre(mechanism, s2_x, s2_z)
    for k in range(7):
        b_k = motion[at.THETA_B, k]
        motion[at.S2_X, k] = -s2_z * b_k
        motion[at.S2_Y, k] = motion[at.S3_Y, k]
        motion[at.S2_Z, k] = s2_x * b_k
        motion[at.O3_X, k] = -o3_z * b_k
        motion[at.O3_Y, k] = motion[at.S3_Y, k]
        motion[at.O3_Z, k] = o3_x * b_k
    centripetal = omega_b * omega_b
    motion[at.S2_X, at.BIAS] -= s2_x * centripetal
    motion[at.S2_Z, at.BIAS] -= s2_z * centripetal
    motion[at.O3_X, at.BIAS] -= o3_x * centripetal
    motion[at.O3_Z, at.BIAS] -= o3_z * centripetal
    motion[at.S2_X, at.VALUE] = s2_x
    motion[at.S2_Y, at.VALUE] = motion[at.S3_Y, at.VALUE]
    motion[at.S2_Z, at.VALUE] = s2_z
    motion[at.O3_X, at.VALUE] = o3_x
    motion[at.O3_Y, at.VALUE] = motion[at.S3_Y, at.VALUE]
    motion[at.O3_Z, at.VALUE] = o3_z
    over = 1.0 / mechanism.l_2
    for k in range(8):
        at_value = 1.0 if k == at.VALUE else 0.0
        s1 = (motion[at.S1_X, k], at_value * mechanism.l_4, motion[at.S1_Z, k])
        pivot = (at_value * mechanism.pivot_x, 0.0, at_value * mechanism.pivot_z)
        motion[at.O1_X, k] = 0.5 * (pivot[0] + s1[0])
        motion[at.O1_X + 1, k] = 0.5 * (pivot[2] + s1[2])
        for axis in range(3):
            motion[at.O2_X + axis, k] = 0.5 * (s1[axis] + motion[at.S2_X + axis, k])
            motion[at.N_X + axis, k] = (motion[at.S2_X + axis, k] - s1[axis]) * over


@kernel
def ring_centre(mechanism: Record, s2_x: float, s2_z: float) -> tuple[float, float]:
    """Return x and z of the ring's mass centre relative to its axis [m]: the mean of those of both arms.

    One of them ends at S2, the other lies by the angle of the ring before it.
    """
    along, across = 0.25 * (1.0 + mechanism.ring_cos), 0.25 * mechanism.ring_sin
    return along * s2_x - across * s2_z, along * s2_z + across * s2_x
