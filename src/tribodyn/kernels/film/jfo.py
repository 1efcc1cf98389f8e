"""Mass-conserving cavitation (Jakobsson, Floberg and Olsson) of a steady film with a groove.

A cavitated node holds oil over the fraction f of its gap, at p = 0; a full one has f = 1. What crosses a θ
face is K Δπ + ω [wedge] f, with f of the node upstream, so that the balance of every cell,

    Σ_faces K (π − π_neighbour) + ω Δζ (wedge f |_after − wedge f |_before) = 0,

has one unknown, π or f, and (p ≥ 0, 1 − f ≥ 0, p (1 − f) = 0) selects which. Primal-dual active set as for
Reynolds cavitation; the matrix is unsymmetric, but an M-matrix by columns, so that a band LU needs no pivots.
The groove supplies oil: f = 1 and p = 0 there. The film is steady: where oil is stored in a cavitated gap
over time, f would be a state.
"""

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.data import (
    CONVERGED,
    NO_CONVERGENCE,
    NO_MEAN_GAP,
    NOT_STEADY,
    FilmData,
    FilmFields,
    FilmMemory,
)
from tribodyn.kernels.jit import kernel

MOST_SOLVES = 200
ROUNDING = 1e-12


@kernel
def solve_transport(film: FilmData, memory: FilmMemory, omega: float) -> int:
    """Fill ``memory.pressure`` and ``memory.fill``; return a status."""
    u = memory.work.state
    if omega == 0.0 or u[4] != 0.0 or u[5] != 0.0 or u[6] != 0.0 or u[7] != 0.0:
        return NOT_STEADY
    n, m = memory.pressure.shape
    for i in range(n):
        for j in range(m):
            if not memory.fields.cells[i, j].wedge > 0.0:
                return NO_MEAN_GAP
    memory.work.effort[0] = 0
    for j in range(m):
        memory.active[0, j] = 1
        memory.fill[0, j] = 1.0
        memory.pressure[0, j] = 0.0
    d_zeta = film.constants.length / (film.z_face.size * film.constants.radius)
    for _ in range(MOST_SOLVES):
        _assemble(memory, omega * d_zeta)
        factorise_band(memory.transport, m)
        solve_band(memory.transport, memory.amount, m)
        memory.work.effort[0] += 1
        if _exchange(memory) == 0:
            return CONVERGED
    return NO_CONVERGENCE


@kernel
def _assemble(memory: FilmMemory, speed: float) -> None:
    """Fill the matrix, one row a node behind the groove, and the right-hand side."""
    fields, active, band, right = memory.fields, memory.active, memory.transport, memory.amount
    n, m = active.shape
    for k in range(band.shape[0]):
        right[k] = 0.0
        for d in range(band.shape[1]):
            band[k, d] = 0.0
    for i in range(1, n):
        for j in range(m):
            k = (i - 1) * m + j
            if active[i, j] == 1:
                centre = fields.cells[i, j].k_theta + fields.cells[i - 1, j].k_theta
                band[k, m] += centre + fields.z_faces[i, j].k_z + fields.z_faces[i, j + 1].k_z
                if i > 1:
                    band[k - m, 2 * m] -= fields.cells[i - 1, j].k_theta
                if i < n - 1:
                    band[k + m, 0] -= fields.cells[i, j].k_theta
                if j > 0:
                    band[k - 1, m + 1] -= fields.z_faces[i, j].k_z
                if j < m - 1:
                    band[k + 1, m - 1] -= fields.z_faces[i, j + 1].k_z
    for i in range(n):
        # What crosses the face behind column i comes from the column upstream.
        after = i + 1 if i < n - 1 else 0
        source = i if speed > 0.0 else after
        for j in range(m):
            flow = speed * fields.cells[i, j].wedge
            known = active[source, j] == 1
            column = (source - 1) * m + j
            if i > 0:
                k = (i - 1) * m + j
                if known:
                    right[k] -= flow
                else:
                    band[k, m + column - k] += flow
            if after > 0:
                k = (after - 1) * m + j
                if known:
                    right[k] += flow
                else:
                    band[k, m + column - k] -= flow


@kernel
def factorise_band(band: FloatArray, m: int) -> None:
    """Replace the matrix, diagonal in column ``m``, by its factors L (unit diagonal) and U."""
    size = band.shape[0]
    for k in range(size):
        inverse = 1.0 / band[k, m]
        last = min(size - 1 - k, m)
        for d in range(1, last + 1):
            factor = band[k + d, m - d]
            if factor != 0.0:
                factor *= inverse
                band[k + d, m - d] = factor
                for e in range(1, last + 1):
                    band[k + d, m - d + e] -= factor * band[k, m + e]


@kernel
def solve_band(band: FloatArray, right: FloatArray, m: int) -> None:
    """Replace ``right`` by the solution."""
    size = band.shape[0]
    for k in range(size):
        total = right[k]
        for d in range(1, min(k, m) + 1):
            total -= band[k, m - d] * right[k - d]
        right[k] = total
    for k in range(size - 1, -1, -1):
        total = right[k]
        for d in range(1, min(size - 1 - k, m) + 1):
            total -= band[k, m + d] * right[k + d]
        right[k] = total / band[k, m]


@kernel
def solve_band_transposed(band: FloatArray, right: FloatArray, m: int) -> None:
    """Replace ``right`` by the solution with the transposed matrix."""
    size = band.shape[0]
    for k in range(size):
        right[k] /= band[k, m]
        for d in range(1, min(size - 1 - k, m) + 1):
            right[k + d] -= band[k, m + d] * right[k]
    for k in range(size - 1, -1, -1):
        for d in range(1, min(k, m) + 1):
            right[k - d] -= band[k, m - d] * right[k]


@kernel
def _exchange(memory: FilmMemory) -> int:
    """Take over the solution, let nodes cavitate and fill; return how many did."""
    active = memory.active
    n, m = active.shape
    highest = 0.0
    for i in range(1, n):
        for j in range(m):
            if active[i, j] == 1:
                highest = max(highest, abs(memory.amount[(i - 1) * m + j]))
    changes = 0
    for i in range(1, n):
        for j in range(m):
            value = memory.amount[(i - 1) * m + j]
            full = active[i, j] == 1
            memory.pressure[i, j] = value if full else 0.0
            memory.fill[i, j] = 1.0 if full else value
            if full and value < -ROUNDING * highest:
                active[i, j] = 0
                changes += 1
            elif not full and value > 1.0 + ROUNDING:
                active[i, j] = 1
                changes += 1
    return changes


@kernel
def transport_adjoint(memory: FilmMemory, member: int) -> None:
    """Solve the transposed system for ``memory.amount``, into one member of ``memory.adjoint``."""
    n, m = memory.pressure.shape
    solve_band_transposed(memory.transport, memory.amount, m)
    for j in range(m):
        memory.adjoint[member, 0, j] = 0.0
    for i in range(1, n):
        for j in range(m):
            memory.adjoint[member, i, j] = memory.amount[(i - 1) * m + j]


@kernel
def filled_column(fill: FloatArray, i: int, face: int) -> float:
    """Return the filled fraction at a z face of column ``i``: the mean of its neighbours."""
    m = fill.shape[1]
    return 0.5 * (fill[i, max(face - 1, 0)] + fill[i, min(face, m - 1)])


@kernel
def couette_by_fill(fields: FilmFields, i: int, j: int) -> float:
    """Return the derivative of Σ couette times :func:`filled_column` by the fraction of a node."""
    faces = fields.z_faces[i]
    m = faces.size - 1
    total = 0.5 * (faces[j].couette + faces[j + 1].couette)
    if j == 0:
        total += 0.5 * faces[0].couette
    if j == m - 1:
        total += 0.5 * faces[m].couette
    return total
