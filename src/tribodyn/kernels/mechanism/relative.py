"""Motion of a coupling's shaft relative to its socket, in the axes of the socket, with its derivatives.

With the socket's body S and the shaft's J, R the axes of the socket and x from the mass centre of S to the
shaft's origin P,

    x = Rᵀ (r_J + A_J ρ_J − r_S),   ẋ = u − ω_S × x,   ω = B ω_J − ω_S,   B = Rᵀ A_J,

where u is the velocity of P against the mass centre of S, and, as accelerations,

    ẍ = s − α_S × x − 2 ω_S × ẋ − ω_S × (ω_S × x),   ω̇ = B α_J − α_S − ω_S × ω.

A small turn of a body about its own axes changes A by A [δθ]×, so that δ(Bᵀ..) and δ(Rᵀ y) = (Rᵀ y) × δθ_S
follow.
"""

from __future__ import annotations

from typing import Any

from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.vectors import (
    cross,
    cross_put,
    cross_rows,
    put,
    put_cross,
    turn,
    turn_axes,
    turn_axes_back,
)


@kernel
def relative_motion(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill pose, twist, its rate without accelerations, and H."""
    _relative_position(coupling, now, bodies)
    relative_velocity(coupling, now, bodies)


@kernel
def _relative_position(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill what velocities do not change: displacement, rotation and H."""
    socket, shaft = bodies[coupling.socket], bodies[coupling.shaft]
    pose, x, arm, point = now.pose, now.x, now.work[0, :3], now.work[1, :3]
    turn_axes_back(coupling.to_socket, socket.A, now.RT)
    turn_axes(now.RT, shaft.A, now.B)
    turn_axes(now.B, coupling.shaft_axes, pose.rotation)
    for i in range(3):
        point[i] = shaft.r[i] - socket.r[i]
    turn(now.RT, point, x)
    turn(now.B, coupling.shaft_point, arm)
    for i in range(3):
        x[i] += arm[i]
    turn(coupling.to_socket, coupling.socket_point, point)
    for i in range(3):
        pose.d[i] = x[i] - point[i]
    _fill_map(coupling, now)


@kernel
def relative_velocity(coupling: Record, now: Record, bodies: Any) -> None:
    """Fill twist and its rate without accelerations, where positions are filled."""
    socket, shaft = bodies[coupling.socket], bodies[coupling.shaft]
    pose, x, u, w_s, arm, point = now.pose, now.x, now.u, now.w_s, now.work[0, :3], now.work[1, :3]
    turn(coupling.to_socket, socket.w, w_s)
    cross(shaft.w, coupling.shaft_point, point)
    turn(now.B, point, arm)
    for i in range(3):
        point[i] = shaft.v[i] - socket.v[i]
    turn(now.RT, point, u)
    for i in range(3):
        u[i] += arm[i]
    cross(w_s, x, point)
    turn(now.B, shaft.w, pose.w)
    for i in range(3):
        pose.v[i] = u[i] - point[i]
        pose.w[i] -= w_s[i]
        now.twist[i], now.twist[3 + i] = pose.v[i], pose.w[i]
    _fill_bias(coupling, now, shaft)


@kernel
def _fill_bias(coupling: Record, now: Record, shaft: Record) -> None:
    """Fill the rate of the twist while no body accelerates."""
    a, b, c = now.work[0, :3], now.work[1, :3], now.work[2, :3]
    cross(shaft.w, coupling.shaft_point, a)
    cross(shaft.w, a, b)
    turn(now.B, b, a)
    cross(now.w_s, now.pose.v, b)
    for i in range(3):
        now.bias[i] = a[i] - 2.0 * b[i]
    cross(now.w_s, now.x, a)
    cross(now.w_s, a, b)
    cross(now.w_s, now.pose.w, c)
    for i in range(3):
        now.bias[i] -= b[i]
        now.bias[3 + i] = -c[i]


@kernel
def _fill_map(coupling: Record, now: Record) -> None:
    """Fill H: the twist over the velocities of both bodies."""
    matrix, to_socket = now.H, coupling.to_socket
    clear(matrix)
    put(matrix, 0, 0, now.RT, -1.0)
    cross_put(matrix, 0, 3, now.x, to_socket, 1.0)
    put(matrix, 3, 3, to_socket, -1.0)
    put(matrix, 0, 6, now.RT, 1.0)
    put_cross(matrix, 0, 9, now.B, coupling.shaft_point, -1.0)
    put(matrix, 3, 9, now.B, 1.0)


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
