"""Bodies at one instant: from states to attitudes, and back; their own forces and rates."""

import math
from typing import Annotated, Any

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, TURNING, VELOCITY, BodyNow
from tribodyn.kernels.mechanism.vectors import turn


@kernel
def attitude(p: FloatArray, matrix: FloatArray) -> None:
    """Fill ``matrix`` (3, 3), which turns body axes into global ones; the quaternion may have any length."""
    scale = 2.0 / (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        matrix[i, i] = 1.0 - scale * (p[1 + j] * p[1 + j] + p[1 + k] * p[1 + k])
        matrix[i, j] = scale * (p[1 + i] * p[1 + j] - p[0] * p[1 + k])
        matrix[j, i] = scale * (p[1 + i] * p[1 + j] + p[0] * p[1 + k])


@entry
def place(y: FloatArray, bodies: Annotated[Record, BodyNow, 1]) -> None:
    """Fill the records of all bodies but the ground from the state (n,)."""
    for b in range(bodies.size - 1):
        body, first = bodies[b], N_STATES * b
        for i in range(3):
            body.r[i] = y[first + i]
            body.v[i] = y[first + VELOCITY + i]
            body.w[i] = y[first + TURNING + i]
        for i in range(4):
            body.p[i] = y[first + ORIENTATION + i]
        attitude(body.p, body.A)


@entry
def collect(bodies: Annotated[Record, BodyNow, 1], y: FloatArray) -> None:
    """Fill the state from the records."""
    for b in range(bodies.size - 1):
        body, first = bodies[b], N_STATES * b
        for i in range(3):
            y[first + i] = body.r[i]
            y[first + VELOCITY + i] = body.v[i]
            y[first + TURNING + i] = body.w[i]
        for i in range(4):
            y[first + ORIENTATION + i] = body.p[i]


@kernel
def own_force(constants: Record, body: Record, now: Record, momentum: FloatArray) -> None:
    """Fill the weight, and the gyroscopic moment −ω × J ω; ``momentum`` (3,) is work space for J ω."""
    for i in range(3):
        now.force[i] = body.mass * constants.gravity[i]
    turn(body.inertia, now.w, momentum)
    w, j = now.w, momentum
    now.force[3] = w[2] * j[1] - w[1] * j[2]
    now.force[4] = w[0] * j[2] - w[2] * j[0]
    now.force[5] = w[1] * j[0] - w[0] * j[1]


@kernel
def rates(bodies: Any, f: FloatArray) -> None:
    """Fill the time derivative of the state (n,); that of a quaternion is half its product with ω."""
    for b in range(bodies.size - 1):
        body, first = bodies[b], N_STATES * b
        p, w = body.p, body.w
        for i in range(3):
            f[first + i] = body.v[i]
            f[first + VELOCITY + i] = body.acceleration[i]
            f[first + TURNING + i] = body.acceleration[3 + i]
        turn_quaternion(p, w, 0.5, f[first + ORIENTATION : first + VELOCITY])


@kernel
def turn_quaternion(p: FloatArray, w: FloatArray, factor: float, out: FloatArray) -> None:
    """Fill ``out`` (4,) with ``factor`` p ∘ (0, w)."""
    out[0] = -factor * (p[1] * w[0] + p[2] * w[1] + p[3] * w[2])
    out[1] = factor * (p[0] * w[0] + p[2] * w[2] - p[3] * w[1])
    out[2] = factor * (p[0] * w[1] + p[3] * w[0] - p[1] * w[2])
    out[3] = factor * (p[0] * w[2] + p[1] * w[1] - p[2] * w[0])


@entry
def move(body: Annotated[Record, BodyNow], change: FloatArray, step: FloatArray) -> None:
    """Displace a body by a way and a small turn in its own axes (6,); ``step`` (4,) is work space."""
    for i in range(3):
        body.r[i] += change[i]
    turn_quaternion(body.p, change[3:6], 0.5, step)
    for i in range(4):
        body.p[i] += step[i]
    make_unit(body.p)
    attitude(body.p, body.A)


@kernel
def make_unit(p: FloatArray) -> None:
    """Make a quaternion one of length 1."""
    inverse = 1.0 / math.sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    for i in range(4):
        p[i] *= inverse


@kernel
def kinetic(body: Record, now: Record, momentum: FloatArray) -> float:
    """Return the kinetic energy [J] and fill ``momentum`` (3,), the angular one in the axes of the body."""
    turn(body.inertia, now.w, momentum)
    total = 0.0
    for i in range(3):
        total += body.mass * now.v[i] * now.v[i] + now.w[i] * momentum[i]
    return 0.5 * total
