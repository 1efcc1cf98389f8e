"""The force of a straight beam without mass between a node of the socket's body and one of the shaft's.

Both origins are at the second node, where they coincide as drawn; the first node lies a length l before it
along z, fixed to the socket. With the chord e of length c between the nodes, axes x, y of the first one and
x', y' of the second, the strains are

    c − l,   ½ (x'·y − y'·x),   e·x,   e·y,   e·x',   e·y',

the last four sines of angles between the chord and the tangents at its ends: a rigid motion strains nothing.
Their forces are those of Timoshenko's beam, in each plane D ((4 + φ) θ₁ + (2 − φ) θ₂) with D = B/(l (1 + φ))
and φ = 12 B/(S l²) of the bending and shear rigidities B, S. Rates of strains are damped in proportion.
"""

import math

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import clear, kernel
from tribodyn.kernels.mechanism.data import DAMPING, SLOPES

_STRAIN = 6
_RATE = 7
_FORCE = 8  #: Columns of the work space behind the gradients of the strains.


@kernel
def beam(coupling: Record, now: Record, mode: float) -> None:
    """Fill the wrench of a beam, its stored energy and heat; slopes where ``mode`` asks for them.

    ``stiffness`` holds those of tension and torsion, D across x and across y, and φ of both; the first of
    ``damping`` is the time that a rate of strain is multiplied with.
    """
    e, d, rotation, made, curved = now.small[0], now.pose.d, now.pose.rotation, now.work, now.strip
    e[0], e[1], e[2] = d[0], d[1], d[2] + coupling.length
    chord = math.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2])
    for i in range(3):
        e[i] /= chord
    delay = coupling.damping[0]
    _fill_strains(e, chord, rotation, made)
    made[0, _STRAIN] = chord - coupling.length
    for k in range(6):
        made[k, _RATE] = 0.0
        for i in range(6):
            made[k, _RATE] += made[k, i] * now.twist[i]
    for k in range(6):
        elastic = _over(coupling.stiffness, made, k, _STRAIN)
        damping = delay * _over(coupling.stiffness, made, k, _RATE)
        now.stored += 0.5 * elastic * made[k, _STRAIN]
        now.powers[DAMPING] += damping * made[k, _RATE]
        made[k, _FORCE] = elastic + damping
        for i in range(6):
            now.wrench[i] -= made[k, _FORCE] * made[k, i]
    if mode == SLOPES:
        _fill_slope(coupling.stiffness, delay, chord, now, made, curved)


@kernel
def _over(stiffness: FloatArray, made: FloatArray, k: int, column: int) -> float:
    """Return the force of strain k over a column of the work space."""
    if k < 2:
        return stiffness[k] * made[k, column]
    plane = k % 2
    phi, other = stiffness[4 + plane], 6 - k + 2 * plane
    return stiffness[2 + plane] * ((4.0 + phi) * made[k, column] + (2.0 - phi) * made[other, column])


@kernel
def _fill_strains(e: FloatArray, chord: float, rotation: FloatArray, made: FloatArray) -> None:
    """Fill the strains but the first, and the gradients of all over displacement and turn."""
    clear(made)
    made[1, _STRAIN] = 0.5 * (rotation[1, 0] - rotation[0, 1])
    made[1, 3], made[1, 4] = -0.5 * rotation[2, 0], -0.5 * rotation[2, 1]
    made[1, 5] = 0.5 * (rotation[0, 0] + rotation[1, 1])
    for i in range(3):
        made[0, i] = e[i]
    for plane in range(2):
        made[2 + plane, _STRAIN] = e[plane]
        x, y, z = rotation[0, plane], rotation[1, plane], rotation[2, plane]
        sine = e[0] * x + e[1] * y + e[2] * z
        made[4 + plane, _STRAIN] = sine
        for i in range(3):
            made[2 + plane, i] = ((1.0 if i == plane else 0.0) - e[i] * e[plane]) / chord
            made[4 + plane, i] = (rotation[i, plane] - e[i] * sine) / chord
        made[4 + plane, 3] = y * e[2] - z * e[1]
        made[4 + plane, 4] = z * e[0] - x * e[2]
        made[4 + plane, 5] = x * e[1] - y * e[0]


@kernel
def _fill_slope(
    stiffness: FloatArray, delay: float, chord: float, now: Record, made: FloatArray, curved: FloatArray
) -> None:
    """Fill the derivatives of the wrench; ``curved`` (6, 12) is work space.

    A displacement changes strains and their rates, which stand in its last columns, and the gradients.
    """
    slope = now.slope
    for k in range(6):
        _fill_curvature(now.small[0], chord, now.pose.rotation, made, k, curved)
        for j in range(6):
            turning = 0.0
            for i in range(6):
                slope[i, j] -= made[k, _FORCE] * curved[i, j]
                turning += now.twist[i] * curved[i, j]
            curved[k, 6 + j] = made[k, j] + delay * turning
    for j in range(6):
        for k in range(6):
            in_position, in_velocity = (
                _over(stiffness, curved, k, 6 + j),
                delay * _over(stiffness, made, k, j),
            )
            for i in range(6):
                slope[i, j] -= made[k, i] * in_position
                slope[i, 6 + j] -= made[k, i] * in_velocity


@kernel
def _fill_curvature(
    e: FloatArray, chord: float, rotation: FloatArray, made: FloatArray, k: int, curved: FloatArray
) -> None:
    """Fill the first (6, 6) of ``curved`` with the derivative of the gradient of strain k."""
    sine, plane = made[k, _STRAIN], k % 2
    for i in range(6):
        for j in range(6):
            curved[i, j] = 0.0
    for i in range(3):
        for j in range(3):
            across = ((1.0 if i == j else 0.0) - e[i] * e[j]) / chord
            if k == 0:
                curved[i, j] = across
            elif k == 1:
                turned = (rotation[i, 0] if j == 1 else 0.0) - (rotation[i, 1] if j == 0 else 0.0)
                curved[3 + i, 3 + j] = 0.5 * turned - (sine if i == j else 0.0)
            else:
                curved[i, j] = -(sine * across + e[i] * made[k, j] + made[k, i] * e[j]) / chord
            if k > 3:
                curved[3 + i, 3 + j] = rotation[i, plane] * e[j] - (sine if i == j else 0.0)
    if k > 3:
        _fill_mixed(e, chord, rotation[:, plane], curved)


@kernel
def _fill_mixed(e: FloatArray, chord: float, x: FloatArray, curved: FloatArray) -> None:
    """Fill the mixed part of the curvature of a sine e·x: that of a turn of x, and its transpose."""
    for j in range(3):
        # e_j × x, without its part along the chord.
        t_x = x[2] if j == 1 else (-x[1] if j == 2 else 0.0)
        t_y = -x[2] if j == 0 else (x[0] if j == 2 else 0.0)
        t_z = x[1] if j == 0 else (-x[0] if j == 1 else 0.0)
        along = e[0] * t_x + e[1] * t_y + e[2] * t_z
        curved[0, 3 + j] = curved[3 + j, 0] = (t_x - along * e[0]) / chord
        curved[1, 3 + j] = curved[3 + j, 1] = (t_y - along * e[1]) / chord
        curved[2, 3 + j] = curved[3 + j, 2] = (t_z - along * e[2]) / chord
