"""Kinetostatic equilibrium of the trunnion in its bushing.

The attitude at which the generalised loads balance with the clearance motion at rest, q̇ = q̈ = 0,
while crank, ring and vane move as the ideal mechanism does at that time.
"""

import math
from functools import partial
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.kernels.vsv.data import VsvData, VsvMemory
from tribodyn.kernels.vsv.functions import kinetostatic_residual
from tribodyn.mechanisms.balance import damped_newton

#: Vane speed [rad/s] at which the traction is saturated for any slip velocity that makes sense.
FULLY_SLIDING: Final = 1.0e3

_START_DEPTHS: Final = (2.0, 1.0, 3.0, 0.0)  #: Separations over σ tried for the first guess.
#: Moments over the half length of the bushing, over the force, that lay opposite ends against it.
_MOMENTS_RULE: Final = 2.0


def equilibrium(
    data: VsvData,
    memory: VsvMemory,
    t: float,
    *,
    direction: float,
    slip_speed: float | None = None,
    guess: FloatArray | None = None,
) -> FloatArray:
    """Return the attitude (e_x, e_y, φ_x, φ_y) in kinetostatic equilibrium [m, rad], shape (4,).

    Raises InputError if none is found: the loads are more than the contact law can carry. The memory is left
    as it was. ``direction``: of the ideal vane motion, ±1, for M_air and friction; ``slip_speed``: of the
    vane that traction sees [rad/s], fully sliding in ``direction`` by default; ``guess``: attitude to start
    from; by default the trunnion is laid against the bushing.
    """
    half = data.mechanism.half_length
    scale = np.array([1.0, 1.0, 1.0 / half, 1.0 / half])
    regime = memory.regime.copy()
    memory.regime[0] = direction
    memory.regime[1] = direction * FULLY_SLIDING if slip_speed is None else slip_speed
    try:
        starts = _starts(data, memory, t) if guess is None else [guess]
        for start in starts:
            q = damped_newton(partial(_residual, data, memory, t), start, scale, 0.5 * data.joint.roughness)
            if q is not None:
                return q
    finally:
        memory.regime[:] = regime
    raise InputError(
        "no equilibrium of the trunnion was found: the loads may be more than this contact can carry; "
        'try run.start = "centred"',
        key="run.start",
    )


def _residual(data: VsvData, memory: VsvMemory, t: float, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    residual, jacobian = np.empty(4), np.empty((4, 4))
    kinetostatic_residual(t, np.append(q, np.zeros(4)), data, memory, residual, jacobian)
    return residual, jacobian


def _starts(data: VsvData, memory: VsvMemory, t: float) -> list[FloatArray]:
    """Lay the trunnion against the bushing, opposite to the load that it feels when centred.

    Along its length, or tilted with the ends at opposite sides; first the one that the load asks for.
    """
    load, _ = _residual(data, memory, t, np.zeros(4))
    half = data.mechanism.half_length
    laid, tilted = [], []
    for depth in _START_DEPTHS:
        e = max(data.joint.clearance - depth * data.joint.roughness, 0.1 * data.joint.clearance)
        laid.append(np.append(_along(load[:2], e), [0.0, 0.0]))
        tilted.append(np.append([0.0, 0.0], _along(load[2:], e / half)))
    moments = math.hypot(load[2], load[3]) / half
    turns = moments > _MOMENTS_RULE * math.hypot(load[0], load[1])
    return tilted + laid if turns else laid + tilted


def _along(direction: FloatArray, length: float) -> FloatArray:
    """Return the vector of a length along another one; along the first axis if that one is zero."""
    angle = portable.atan2(direction[1], direction[0])
    return length * np.array([portable.cos(angle), portable.sin(angle)])
