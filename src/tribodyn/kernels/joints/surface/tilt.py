"""Pose of a joint's shaft in its socket, its tilt, and the moment that does the work of the pressure.

Gaps follow the tilt φ(R), not the angular velocity: φ̇ = G ω with a matrix G that is the identity only as
drawn. With the moment m = Σ A x × (−p n) about P, the power of the pressure over all gaps is F·v + m·φ̇. So
the moment on the shaft is M = Gᵀ m, and approach speeds are taken with φ̇. With m and ω in their places a
tilted shaft that spins about its own axis would do work against frictionless walls: by Ω (m_y φ_x − m_x
φ_y), first order in the tilt.

Four kinds of surfaces: a sphere has no tilt. On a surface of revolution only the axis a of the shaft counts,
φ = (−a_y/a_z, a_x/a_z, 0), so that it passes the height z where gaps say it does. Any other surface is held
against turning about Z, too, with φ_z = ½ (R_yx − R_xy), the sine of a small twist. A pin along X that turns
in a slot between flat walls has φ_z = b_y/b_x alone, b being its axis.

The cross-section of a tilted cylinder is an ellipse. With the slope of the axis, l = φ × ẑ, the gap at the
radial normal n and the height z is

    h = h0 − n·d − z n·l − ½ ρ (n·l)²,    −∂h/∂φ = (z + ρ n·l) ẑ × n.

ρ is the radius of the pin if z is a height on the bore, and minus that radius if z is a height on the pin.
The pressure acts along the normal of the pin in the first case, along that of the bore in the second; both
give the lever arm z + ρ n·l. The derivation is in ``docs/theory/mechanisms.md``.

Wrenches are (F_x, F_y, F_z, M_x, M_y, M_z) on the shaft, moments about its origin P. Their derivatives are
taken with respect to displacement, a small rotation of the shaft, velocity and angular velocity, three of
each. On the socket the same forces act backwards: −F, and −(M + d × F) about the socket's origin O.
"""

from typing import Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import clear, kernel

NO_TILT: Final = 0.0
AXIS: Final = 1.0
WHOLE: Final = 2.0
LINE: Final = 3.0

#: φ [rad], φ̇ [rad/s], G, and ∂φ̇/∂ϑ [1/s] for a small rotation ϑ of the shaft, whose ω is held fixed.
Tilt: Final = record_type(
    ("phi", "f8", (3,)), ("rate", "f8", (3,)), ("to_rate", "f8", (3, 3)), ("rate_turn", "f8", (3, 3))
)


@kernel
def fill_tilt(kind: float, rotation: FloatArray, w: FloatArray, tilt: Record) -> None:
    """Fill φ, G and φ̇ of a kind of tilt from rotation and angular velocity."""
    phi, matrix, rate = tilt.phi, tilt.to_rate, tilt.rate
    clear(matrix)
    for i in range(3):
        phi[i] = rate[i] = 0.0
    if kind == LINE:
        z, q = rotation[1, 0] / rotation[0, 0], rotation[2, 0] / rotation[0, 0]
        phi[2] = z
        matrix[2, 0], matrix[2, 1], matrix[2, 2] = -q, -z * q, 1.0 + z * z
    elif kind != NO_TILT:
        x, y = -rotation[1, 2] / rotation[2, 2], rotation[0, 2] / rotation[2, 2]
        phi[0], phi[1] = x, y
        matrix[0, 0], matrix[0, 1], matrix[0, 2] = 1.0 + x * x, x * y, -y
        matrix[1, 0], matrix[1, 1], matrix[1, 2] = x * y, 1.0 + y * y, x
    if kind == WHOLE:
        phi[2] = 0.5 * (rotation[1, 0] - rotation[0, 1])
        matrix[2, 0], matrix[2, 1] = -0.5 * rotation[2, 0], -0.5 * rotation[2, 1]
        matrix[2, 2] = 0.5 * (rotation[0, 0] + rotation[1, 1])
    for i in range(3):
        for k in range(3):
            rate[i] += matrix[i, k] * w[k]


@kernel
def moment_of(tilt: Record, m: FloatArray, moment: FloatArray) -> None:
    """Add Gᵀ m to ``moment``, both of shape (3,) [N m]."""
    matrix = tilt.to_rate
    for i in range(3):
        for k in range(3):
            moment[i] += matrix[k, i] * m[k]


@kernel
def fill_derivatives(
    kind: float, rotation: FloatArray, w: FloatArray, m: FloatArray, tilt: Record, out: FloatArray
) -> None:
    """Fill ``tilt.rate_turn`` and add ∂(Gᵀ m)/∂ϑ with m held fixed to the columns of ``out`` (3, 3)."""
    rate_turn, matrix = tilt.rate_turn, tilt.to_rate
    clear(rate_turn)
    if kind == LINE:
        z, q, across = tilt.phi[2], rotation[2, 0] / rotation[0, 0], w[0] + tilt.phi[2] * w[1]
        q_by = (z, -1.0 - q * q, q * z)
        for k in range(3):
            turn, leaning = matrix[2, k], q_by[k]
            rate_turn[2, k] = (2.0 * z * w[2] - q * w[1]) * turn - across * leaning
            out[0, k] -= m[2] * leaning
            out[1, k] -= m[2] * (q * turn + z * leaning)
            out[2, k] += 2.0 * m[2] * z * turn
    elif kind != NO_TILT:
        x, y = tilt.phi[0], tilt.phi[1]
        # G as a function of φ; φ turns with G ϑ.
        by_x = (2.0 * x * w[0] + y * w[1], y * w[0] + w[2])
        by_y = (x * w[1] - w[2], x * w[0] + 2.0 * y * w[1])
        m_by_x = (2.0 * x * m[0] + y * m[1], y * m[0], m[1])
        m_by_y = (x * m[1], x * m[0] + 2.0 * y * m[1], -m[0])
        for k in range(3):
            turn_x, turn_y = matrix[0, k], matrix[1, k]
            for i in range(2):
                rate_turn[i, k] = by_x[i] * turn_x + by_y[i] * turn_y
            for i in range(3):
                out[i, k] += m_by_x[i] * turn_x + m_by_y[i] * turn_y
    if kind == WHOLE:
        # G_z = ½ (tr R ẑ − R_z) with dR = ϑ × R column by column, and d tr R = −(R − Rᵀ)·ϑ as a vector.
        for k in range(3):
            a, b = (k + 1) % 3, (k + 2) % 3
            trace = 0.5 * (rotation[b, a] - rotation[a, b])
            rate_turn[2, k] -= trace * w[2]
            out[2, k] -= trace * m[2]
            rate_turn[2, 0] -= 0.5 * rotation[1, k] * w[k]
            rate_turn[2, 1] += 0.5 * rotation[0, k] * w[k]
            out[k, 0] -= 0.5 * rotation[1, k] * m[2]
            out[k, 1] += 0.5 * rotation[0, k] * m[2]


Pose: Final = record_type(
    ("d", "f8", (3,)),
    ("rotation", "f8", (3, 3)),
    ("v", "f8", (3,)),
    ("w", "f8", (3,)),
    ("opening", "f8", (2,)),
    ("v_opening", "f8", (2,)),
)
"""
d
    From O to P [m].
rotation
    Turns components in the shaft's frame into those in the socket's; the identity as drawn. Its last column
    is the axis of the shaft.
v
    Velocity of P relative to the socket [m/s].
w
    Angular velocity of the shaft relative to the socket [rad/s].
opening, v_opening
    What temperatures have added to the radial clearance and to the play along the axis [m], and the rates.
"""

#: First column of the small rotation in the derivative; for the others see ``joints/pose.py``.
TURN: Final = 3
