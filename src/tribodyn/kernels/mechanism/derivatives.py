"""Derivatives of the equations of motion, coupling by coupling.

Positions change by δπ, a way and a small turn about the axes of the body for each body, velocities by δV. A
coupling acts on its two bodies with Hᵀ W, W its whole wrench, whose derivative has three parts: that of the
wrench, that of the axes it is given in, and that of its arms. Its rows change by Γ_q δπ + Γ_v δV besides G
δa.
"""

from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear, is_zero
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.constraints import row_gradient
from tribodyn.kernels.mechanism.data import NONE, Now, Parts
from tribodyn.kernels.mechanism.relative import rate_gradient, twist_gradient
from tribodyn.kernels.mechanism.vectors import cross_put, cross_rows, multiply_transposed, put, turn_back


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
