"""A mechanism of ideal joints that follows its drives: positions and velocities without forces."""

from typing import Any, Final

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix
from tribodyn.kernels.actions import Signals
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.mechanism.bodies import collect
from tribodyn.kernels.mechanism.data import N_STATES, TURNING, Now, Parts, Pattern
from tribodyn.kernels.mechanism.redundancy import SMALL, choose_rows
from tribodyn.kernels.mechanism.solution import (
    close,
    correct_velocities,
    kinematics,
    largest_residual,
    mark_angles,
)
from tribodyn.kernels.mechanism.vectors import turn

_TRIES: Final = 3  #: Times that joints are closed: dependent rows may open again by the first correction.


@entry
def follow(
    parts: Parts,
    now: Now,
    signals: Signals,
    pattern: Pattern,
    blocks: FloatCube,
    times: FloatArray,
    first: int,
    most: float,
    closed: float,
    matrix: FloatMatrix,
    motion: FloatMatrix,
) -> int:
    """Lead bodies through times; return the number of the first at which joints do not close, or of none.

    Velocities are those of the drives; freedoms that are left are at rest. Bodies are where they are just
    before time ``first``. Joints are closed at once up to a residual ``most``, in units of the size or
    radians, and have closed below ``closed``. ``matrix`` (n_rows, n_rows) is work space; ``motion`` (n_t, 13
    n_bodies) is filled with states of the bodies, angular velocities in global axes.
    """
    wait = 0
    for k in range(first, times.size):
        kinematics(parts, now, signals, times[k])
        mark_angles(now.couplings)
        if not largest_residual(parts, now, parts.constants.extent) <= most:
            return k
        if parts.constants.rank < parts.constants.n_rows and wait <= 0:
            choose_rows(parts, now, matrix)
            wait = 1 + (parts.constants.n_rows // SMALL) ** 3
        wait -= 1
        for _ in range(_TRIES):
            close(parts, now, signals, pattern, blocks, times[k])
            if largest_residual(parts, now, parts.constants.extent) <= closed:
                break
        if not largest_residual(parts, now, parts.constants.extent) <= closed:
            return k
        _stop(now.bodies)
        correct_velocities(parts, now, pattern, blocks, 0.0)
        collect(now.bodies, motion[k])
        for b in range(now.bodies.size - 1):
            body, begin = now.bodies[b], N_STATES * b + TURNING
            turn(body.A, body.w, motion[k, begin : begin + 3])
    return times.size


@kernel
def _stop(bodies: Any) -> None:
    """Set all velocities to zero."""
    for b in range(bodies.size):
        for i in range(3):
            bodies[b].v[i] = 0.0
            bodies[b].w[i] = 0.0
