"""Motion of a coupling's shaft relative to its socket, and its angle about the axis, with derivatives.

With the socket's body S and the shaft's J, R the axes of the socket and x from the mass centre of S to the
shaft's origin P,

    x = Rᵀ (r_J + A_J ρ_J − r_S),   ẋ = u − ω_S × x,   ω = B ω_J − ω_S,   B = Rᵀ A_J,

where u is the velocity of P against the mass centre of S, and, as accelerations,

    ẍ = s − α_S × x − 2 ω_S × ẋ − ω_S × (ω_S × x),   ω̇ = B α_J − α_S − ω_S × ω.

A small turn of a body about its own axes changes A by A [δθ]×, so that δ(Bᵀ..) and δ(Rᵀ y) = (Rᵀ y) × δθ_S
follow.
"""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import atan2
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import clear, kernel
from tribodyn.kernels.mechanism.vectors import (
    cross,
    cross_put,
    cross_rows,
    crossed,
    put_cross,
    turn,
    turn_axes,
    turn_axes_back,
    turned,
)


@kernel
def relative_position(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill the quantities that velocities do not change: displacement, rotation and H."""
    socket, shaft, rho = bodies[coupling.socket], bodies[coupling.shaft], coupling.shaft_point
    if coupling.socket < bodies.size - 1:  # the ground does not turn
        turn_axes_back(coupling.to_socket, socket.A, now.RT)
    turn_axes(now.RT, shaft.A, now.B)
    turn_axes(now.B, coupling.shaft_axes, now.pose.rotation)
    a, b = socket.r, shaft.r
    way = turned(now.RT, b[0] - a[0], b[1] - a[1], b[2] - a[2])
    arm = turned(now.B, rho[0], rho[1], rho[2])
    origin = coupling.socket_point
    point = turned(coupling.to_socket, origin[0], origin[1], origin[2])
    for i in range(3):
        now.x[i] = way[i] + arm[i]
        now.pose.d[i] = now.x[i] - point[i]
    _fill_map(coupling, now)


@kernel
def relative_velocity(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill twist and, of rows, its rate without accelerations, where positions are filled."""
    socket, shaft, rho, x = bodies[coupling.socket], bodies[coupling.shaft], coupling.shaft_point, now.x
    w, v, v_s, pose = shaft.w, shaft.v, socket.v, now.pose
    c_x, c_y, c_z = crossed(w[0], w[1], w[2], rho[0], rho[1], rho[2])
    arm = turned(now.B, c_x, c_y, c_z)
    u = turned(now.RT, v[0] - v_s[0], v[1] - v_s[1], v[2] - v_s[2])
    spin = turned(now.B, w[0], w[1], w[2])
    if coupling.socket == bodies.size - 1 and coupling.n_terms == 0:
        for i in range(3):
            now.u[i] = pose.v[i] = now.twist[i] = u[i] + arm[i]
            pose.w[i] = now.twist[3 + i] = spin[i]
        return
    w_x, w_y, w_z = turned(coupling.to_socket, socket.w[0], socket.w[1], socket.w[2])
    swing = crossed(w_x, w_y, w_z, x[0], x[1], x[2])
    now.w_s[0], now.w_s[1], now.w_s[2] = w_x, w_y, w_z
    for i in range(3):
        now.u[i] = u[i] + arm[i]
        pose.v[i] = now.twist[i] = now.u[i] - swing[i]
        pose.w[i] = now.twist[3 + i] = spin[i] - now.w_s[i]
    if coupling.n_terms > 0:
        # Rate of the twist while no body accelerates.
        d_x, d_y, d_z = crossed(w[0], w[1], w[2], c_x, c_y, c_z)
        outward = turned(now.B, d_x, d_y, d_z)
        coriolis = crossed(w_x, w_y, w_z, pose.v[0], pose.v[1], pose.v[2])
        inward = crossed(w_x, w_y, w_z, swing[0], swing[1], swing[2])
        turning = crossed(w_x, w_y, w_z, pose.w[0], pose.w[1], pose.w[2])
        for i in range(3):
            now.bias[i] = outward[i] - 2.0 * coriolis[i] - inward[i]
            now.bias[3 + i] = -turning[i]


@kernel
def _fill_map(coupling: Record, now: Record) -> None:
    """Fill H, the twist over the velocities of both bodies, but for what is always zero."""
    matrix, to_socket, rotation, x, rho = now.H, coupling.to_socket, now.B, now.x, coupling.shaft_point
    for i in range(3):
        way = crossed(x[0], x[1], x[2], to_socket[0, i], to_socket[1, i], to_socket[2, i])
        arm = crossed(rho[0], rho[1], rho[2], rotation[i, 0], rotation[i, 1], rotation[i, 2])
        for j in range(3):
            matrix[i, j], matrix[i, 6 + j] = -now.RT[i, j], now.RT[i, j]
            matrix[j, 3 + i], matrix[3 + i, 3 + j] = way[j], -to_socket[i, j]
            matrix[i, 9 + j], matrix[3 + i, 9 + j] = arm[j], rotation[i, j]


@kernel
def twist_gradient(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill Vq: the derivative of the twist in the positions of both bodies."""
    shaft, matrix, a = bodies[coupling.shaft], now.Vq, now.work[0, :3]
    clear(matrix)
    cross(shaft.w, coupling.shaft_point, a)
    put_cross(matrix, 0, 9, now.B, a, -1.0)
    cross_put(matrix, 0, 3, now.u, coupling.to_socket, 1.0)
    cross_rows(matrix, 0, now.w_s, now.H, -1.0)
    put_cross(matrix, 3, 9, now.B, shaft.w, -1.0)
    turn(now.B, shaft.w, a)
    cross_put(matrix, 3, 3, a, coupling.to_socket, 1.0)


@kernel
def rate_gradient(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill Aq and Av: the derivatives of the rate of the twist while accelerations are held."""
    socket, shaft = bodies[coupling.socket], bodies[coupling.shaft]
    to_socket, w_s = coupling.to_socket, now.w_s
    in_position, in_velocity = now.Aq, now.Av
    a, b, c = now.work[0, :3], now.work[1, :3], now.work[2, :3]
    clear(in_position)
    clear(in_velocity)
    # What the shaft's own turning does to the acceleration of its origin.
    cross(shaft.w, coupling.shaft_point, a)
    put_cross(in_velocity, 0, 9, now.B, a, -1.0)
    cross(shaft.w, a, b)
    cross(shaft.acceleration[3:6], coupling.shaft_point, a)
    for i in range(3):
        b[i] += a[i]
    put_cross(in_position, 0, 9, now.B, b, -1.0)
    clear(now.small)
    put_cross(now.small, 0, 0, now.B, shaft.w, 1.0)
    put_cross(in_velocity, 0, 9, now.small, coupling.shaft_point, -1.0)
    # s, the acceleration of the origin against the socket's mass centre.
    turn(now.B, b, a)
    for i in range(3):
        b[i] = shaft.acceleration[i] - socket.acceleration[i]
    turn(now.RT, b, c)
    for i in range(3):
        a[i] += c[i]
    cross_put(in_position, 0, 3, a, to_socket, 1.0)
    # The turning of the socket.
    turn(to_socket, socket.acceleration[3:6], c)
    cross_rows(in_position, 0, c, now.H, -1.0)
    cross_rows(in_position, 0, w_s, now.Vq, -2.0)
    clear(now.work)
    cross_rows(now.work, 0, w_s, now.H, 1.0)
    cross_rows(in_position, 0, w_s, now.work, -1.0)
    cross_rows(in_velocity, 0, w_s, now.H, -2.0)
    cross_put(in_velocity, 0, 3, now.pose.v, to_socket, 2.0)
    cross(w_s, now.x, a)
    cross_put(in_velocity, 0, 3, a, to_socket, 1.0)
    clear(now.small)
    cross_put(now.small, 0, 0, now.x, to_socket, 1.0)
    cross_put(in_velocity, 0, 3, w_s, now.small, 1.0)
    # Angular acceleration.
    put_cross(in_position, 3, 9, now.B, shaft.acceleration[3:6], -1.0)
    turn(now.B, shaft.acceleration[3:6], a)
    cross_put(in_position, 3, 3, a, to_socket, 1.0)
    cross_rows(in_position, 3, w_s, now.Vq, -1.0)
    cross_put(in_velocity, 3, 3, now.pose.w, to_socket, 1.0)
    cross_rows(in_velocity, 3, w_s, now.H, -1.0)


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
