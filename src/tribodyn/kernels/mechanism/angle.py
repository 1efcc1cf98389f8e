"""The angle of a shaft about the axis of its socket, with its derivatives.

With the x axis q of the shaft in the axes of the socket, of length one, and s = q_x² + q_y², h = q_z/s,

    θ = atan2(q_y, q_x),   θ̇ = g·ω,   g = (−h q_x, −h q_y, 1),   q̇ = ω × q,   ḣ = c q̇_z,   c = (2 − s)/s².

Where the shaft does not tilt, g is the axis. Few couplings need the angle itself at every evaluation.
"""

import math
from typing import Final

from mebdf.kernels.elementary import atan2
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel

WHOLE_TURN: Final = 2.0 * math.pi


@kernel
def whole_angle(now: Record) -> float:
    """Return the angle of the shaft of a coupling with its whole turns [rad]."""
    raw: float = atan2(now.pose.rotation[1, 0], now.pose.rotation[0, 0])
    return raw + WHOLE_TURN * round((now.angle_mark - raw) / WHOLE_TURN)


@kernel
def angle_gradient(q: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3,) with g."""
    h = q[2] / (q[0] * q[0] + q[1] * q[1])
    out[0], out[1], out[2] = -h * q[0], -h * q[1], 1.0


@kernel
def angle_rate(q: FloatArray, w: FloatArray) -> float:
    """Return ġ·ω, the angular acceleration about the axis where ω does not change [rad/s²]."""
    s = q[0] * q[0] + q[1] * q[1]
    v_x, v_y, v_z = w[1] * q[2] - w[2] * q[1], w[2] * q[0] - w[0] * q[2], w[0] * q[1] - w[1] * q[0]
    across = q[0] * w[0] + q[1] * w[1]
    return -(2.0 - s) / (s * s) * v_z * across - q[2] / s * (v_x * w[0] + v_y * w[1])


@kernel
def angle_hessian(
    q: FloatArray,
    w: FloatArray,
    w_rate: FloatArray,
    turned: FloatArray,
    turning: FloatArray,
    of_gradient: FloatArray,
) -> None:
    """Fill the derivatives of g·ω̇ + ġ·ω in a small turn ϑ of the shaft and in ω (3,), and that of g in ϑ.

    ``of_gradient`` (3, 3) holds the components of g in its rows; δq = ϑ × q.
    """
    s = q[0] * q[0] + q[1] * q[1]
    h, c = q[2] / s, (2.0 - s) / (s * s)
    v_x, v_y, v_z = w[1] * q[2] - w[2] * q[1], w[2] * q[0] - w[0] * q[2], w[0] * q[1] - w[1] * q[0]
    across, swing = q[0] * w[0] + q[1] * w[1], v_x * w[0] + v_y * w[1]
    pulled = q[0] * w_rate[0] + q[1] * w_rate[1]
    for k in range(3):
        # e_k × q: the change of q with ϑ_k, and that of q̇ with ω_k.
        d_x = q[2] if k == 1 else (-q[1] if k == 2 else 0.0)
        d_y = -q[2] if k == 0 else (q[0] if k == 2 else 0.0)
        d_z = q[1] if k == 0 else (-q[0] if k == 1 else 0.0)
        d_h, d_c = c * d_z, 2.0 * q[2] * d_z * (4.0 - s) / (s * s * s)
        of_gradient[0, k], of_gradient[1, k] = -d_h * q[0] - h * d_x, -d_h * q[1] - h * d_y
        of_gradient[2, k] = 0.0
        # q̇ changes by ω × δq.
        e_x, e_y, e_z = w[1] * d_z - w[2] * d_y, w[2] * d_x - w[0] * d_z, w[0] * d_y - w[1] * d_x
        d_across, d_swing = d_x * w[0] + d_y * w[1], e_x * w[0] + e_y * w[1]
        d_pulled = d_x * w_rate[0] + d_y * w_rate[1]
        turned[k] = (
            -d_h * (pulled + swing)
            - h * (d_pulled + d_swing)
            - (d_c * v_z + c * e_z) * across
            - c * v_z * d_across
        )
        own, speed = (q[0], v_x) if k == 0 else ((q[1], v_y) if k == 1 else (0.0, 0.0))
        turning[k] = -c * (d_z * across + v_z * own) - h * (d_across + speed)
