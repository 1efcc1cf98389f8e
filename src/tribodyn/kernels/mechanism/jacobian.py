"""Derivatives of the equations of motion: coupling by coupling, and as a full matrix.

Positions change by δπ, a way and a small turn about the axes of the body for each body, velocities by δV. A
coupling acts on its two bodies with Hᵀ W, W its whole wrench, whose derivative has three parts: that of the
wrench, that of the axes it is given in, and that of its arms. Its rows change by Γ_q δπ + Γ_v δV besides G
δa.
"""

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import clear, is_zero, kernel
from tribodyn.kernels.mechanism.blocks import solve
from tribodyn.kernels.mechanism.constraints import row_gradient
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
from tribodyn.kernels.mechanism.relative import rate_gradient, twist_gradient
from tribodyn.kernels.mechanism.vectors import cross_put, cross_rows, multiply_transposed, put, turn_back


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


@kernel
def fill_derivatives(data: Parts, memory: Now) -> None:
    """Fill Kq, Kv, Gq, Gv of all couplings; accelerations and multipliers are those of the bodies' state."""
    for k in range(data.couplings.size):
        coupling, now = data.couplings[k], memory.couplings[k]
        twist_gradient(coupling, now, memory.bodies)
        if coupling.n_terms > 0:
            rate_gradient(coupling, now, memory.bodies)
            lead = memory.couplings[k if coupling.first_leg == NONE else coupling.first_leg]
            _fill_rows(coupling, now, memory, lead.law)
        _fill_forces(coupling, now)


@kernel
def _fill_rows(coupling: Record, now: Record, memory: Now, law: Record) -> None:
    """Fill Gq and Gv, and the slope of the constraint wrench."""
    rate = memory.rest[0]
    socket, shaft = memory.bodies[coupling.socket], memory.bodies[coupling.shaft]
    for i in range(6):
        rate[i] = now.bias[i]
        for j in range(6):
            rate[i] += now.H[i, j] * socket.acceleration[j] + now.H[i, 6 + j] * shaft.acceleration[j]
    row_gradient(coupling, now, rate, law)


@kernel
def _fill_forces(coupling: Record, now: Record) -> None:
    """Fill Kq and Kv, the derivatives of −Hᵀ W, which stands beside M a."""
    clear(now.Kq)
    clear(now.Kv)
    _add_slope(now)
    _add_axes(coupling, now)


@kernel
def _add_slope(now: Record) -> None:
    """Add −Hᵀ δW."""
    work, slope = now.work, now.slope
    for k in range(6):
        if is_zero(slope, k):
            continue
        for j in range(12):
            in_position = in_velocity = 0.0
            for m in range(6):
                in_position += slope[k, m] * now.H[m, j] + slope[k, 6 + m] * now.Vq[m, j]
                in_velocity += slope[k, 6 + m] * now.H[m, j]
            work[k, j], now.strip[k, j] = in_position, in_velocity
        for i in range(12):
            factor = now.H[k, i]
            if factor != 0.0:
                for j in range(12):
                    now.Kq[i, j] -= factor * work[k, j]
                    now.Kv[i, j] -= factor * now.strip[k, j]


@kernel
def _add_axes(coupling: Record, now: Record) -> None:
    """Add −(δH)ᵀ W."""
    to_socket, matrix, work = coupling.to_socket, now.Kq, now.work
    f, m, on_shaft, turned = work[0, :3], work[1, :3], work[2, :3], work[3, :3]
    for i in range(3):
        f[i] = now.wrench[i] + now.constraint[i]
        m[i] = now.wrench[3 + i] + now.constraint[3 + i]
    # The force is fixed in the socket: R (δθ_S × F) on the shaft's body, the opposite on the socket's.
    clear(now.small)
    cross_put(now.small, 0, 0, f, to_socket, 1.0)
    multiply_transposed(now.RT, now.small, now.turned)
    put(matrix, 6, 3, now.turned, 1.0)
    put(matrix, 0, 3, now.turned, -1.0)
    # Moment on the shaft's body: ρ × Bᵀ F + Bᵀ M.
    multiply_transposed(now.B, now.small, now.turned)
    cross_put(matrix, 9, 3, coupling.shaft_point, now.turned, 1.0)
    clear(now.small)
    cross_put(now.small, 0, 0, m, to_socket, 1.0)
    multiply_transposed(now.B, now.small, now.turned)
    put(matrix, 9, 3, now.turned, 1.0)
    turn_back(now.B, f, on_shaft)
    turn_back(now.B, m, turned)
    clear(now.small)
    for i in range(3):
        now.small[i, i] = 1.0
    clear(now.turned)
    cross_put(now.turned, 0, 0, on_shaft, now.small, 1.0)
    cross_put(matrix, 9, 9, coupling.shaft_point, now.turned, -1.0)
    cross_put(matrix, 9, 9, turned, now.small, -1.0)
    # Moment on the socket's body: −Cᵀ (x × F + M), and δx stands in H.
    clear(now.strip)
    cross_rows(now.strip, 0, f, now.H, 1.0)
    for i in range(3):
        for j in range(12):
            for k in range(3):
                matrix[3 + i, j] -= to_socket[k, i] * now.strip[k, j]
