"""The Jacobian of the equations of motion as a full matrix, column by column."""

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.blocks import solve
from tribodyn.kernels.mechanism.data import (
    N_STATES,
    NONE,
    ORIENTATION,
    TURNING,
    VELOCITY,
    Now,
    Parts,
    Pattern,
)


@kernel
def gyroscopic(body: Record, now: Record, matrix: FloatArray) -> None:
    """Fill ``matrix`` (3, 3) with the derivative of ω × J ω in ω."""
    w = now.w
    for j in range(3):
        a, b, c = body.inertia[0, j], body.inertia[1, j], body.inertia[2, j]
        matrix[0, j] = w[1] * c - w[2] * b
        matrix[1, j] = w[2] * a - w[0] * c
        matrix[2, j] = w[0] * b - w[1] * a
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        spin = body.inertia[i, 0] * w[0] + body.inertia[i, 1] * w[1] + body.inertia[i, 2] * w[2]
        # − [J ω]×.
        matrix[j, k] += spin
        matrix[k, j] -= spin


@kernel
def fill_gyroscopic(data: Parts, memory: Now) -> None:
    """Fill these derivatives of all bodies."""
    for b in range(data.bodies.size):
        gyroscopic(data.bodies[b], memory.bodies[b], memory.bodies[b].gyroscopic)


@kernel
def fill_jacobian(
    data: Parts, memory: Now, pattern: Pattern, blocks: FloatArray, jacobian: FloatArray
) -> None:
    """Fill the derivative of the rates (n, n); couplings hold theirs, blocks the factors."""
    n = jacobian.shape[0]
    for i in range(n):
        for j in range(n):
            jacobian[i, j] = 0.0
    for b in range(data.bodies.size):
        _kinematics(memory.bodies[b], N_STATES * b, jacobian)
        for column in range(12):
            _load_column(data, memory, b, column)
            solve(pattern, blocks, memory.x)
            _place_column(data, memory, b, column, jacobian)


@kernel
def _kinematics(now: Record, first: int, jacobian: FloatArray) -> None:
    """Fill the rows of position and quaternion."""
    p, w = now.p, now.w
    for i in range(3):
        jacobian[first + i, first + VELOCITY + i] = 1.0
    row, turned = first + ORIENTATION, first + TURNING
    # ½ p ∘ (0, ω) in ω and in p.
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        jacobian[row, turned + i] = -0.5 * p[1 + i]
        jacobian[row + 1 + i, turned + i] = 0.5 * p[0]
        jacobian[row + 1 + j, turned + i] = 0.5 * p[1 + k]
        jacobian[row + 1 + k, turned + i] = -0.5 * p[1 + j]
        jacobian[row, row + 1 + i] = -0.5 * w[i]
        jacobian[row + 1 + i, row] = 0.5 * w[i]
        jacobian[row + 1 + i, row + 1 + j] = 0.5 * w[k]
        jacobian[row + 1 + i, row + 1 + k] = -0.5 * w[j]


@kernel
def _load_column(data: Parts, memory: Now, body: int, column: int) -> None:
    """Fill the right-hand sides for a change of one coordinate, or velocity from 6 on, of a body."""
    x = memory.x
    for k in range(x.shape[0]):
        for i in range(6):
            x[k, i] = 0.0
    entry = column % 6
    if column >= 9:
        for i in range(3):
            x[body, 3 + i] = -memory.bodies[body].gyroscopic[i, entry - 3]
    for k in range(data.couplings.size):
        coupling, now = data.couplings[k], memory.couplings[k]
        if coupling.socket != body and coupling.shaft != body:
            continue
        j = entry if coupling.socket == body else 6 + entry
        forces = now.Kq if column < 6 else now.Kv
        rows = now.Gq if column < 6 else now.Gv
        for i in range(6):
            if coupling.socket < data.bodies.size:
                x[coupling.socket, i] -= forces[i, j]
            if coupling.shaft < data.bodies.size:
                x[coupling.shaft, i] -= forces[6 + i, j]
        if coupling.node != NONE:
            for m in range(coupling.n_terms):
                x[coupling.node, m] -= rows[m, j]


@kernel
def _place_column(data: Parts, memory: Now, body: int, column: int, jacobian: FloatArray) -> None:
    """Add the accelerations found to the columns of the states that move the coordinate."""
    p, first, entry = memory.bodies[body].p, N_STATES * body, column % 6
    square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]
    i = entry - 3
    j, k = (i + 1) % 3, (i + 2) % 3
    for b in range(data.bodies.size):
        for row in range(6):
            value, to = memory.x[b, row], N_STATES * b + VELOCITY + row
            if column >= 6:
                jacobian[to, first + VELOCITY + entry] += value
            elif column < 3:
                jacobian[to, first + entry] += value
            else:
                # δθ = 2 Im(p̄ ∘ δp)/|p|².
                scaled = 2.0 * value / square
                jacobian[to, first + ORIENTATION] -= scaled * p[1 + i]
                jacobian[to, first + ORIENTATION + 1 + i] += scaled * p[0]
                jacobian[to, first + ORIENTATION + 1 + k] -= scaled * p[1 + j]
                jacobian[to, first + ORIENTATION + 1 + j] += scaled * p[1 + k]
