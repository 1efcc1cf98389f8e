"""Factorisation and solution over the nodes where the film is full: L D Lᵀ of a band with a border.

Unknowns are numbered column after column (θ), so that the band is as wide as a column is high, and only nodes
with a full film are numbered. The circle is cut at a column without unknowns if cavitation leaves
one; otherwise the emptiest column becomes a border, numbered last. The matrix is symmetric, positive
definite and an M-matrix: no pivoting.
"""

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.data import SIDES, BandSystem, FilmFields, FlagArray
from tribodyn.kernels.jit import kernel


@kernel
def number_unknowns(system: BandSystem, active: FlagArray, rows: int) -> None:
    """Give the active nodes of the first ``rows`` rows numbers, and find how far elimination reaches."""
    n = active.shape[0]
    start, least = 0, rows + 1
    for i in range(n):
        count = 0
        for j in range(rows):
            count += active[i, j]
            system.number[i, j] = -1
        if count < least:
            start, least = i, count
    total = 0
    for step in range(1, n + 1):
        i = (start + step) % n
        if step == n:
            system.size[0] = total
        for j in range(rows):
            if active[i, j] == 1:
                system.number[i, j] = total
                total += 1
    system.size[1] = total - system.size[0]
    system.size[2] = start
    _find_reach(system, n, rows, start)


@kernel
def _find_reach(system: BandSystem, n: int, rows: int, start: int) -> None:
    reach = 0
    for step in range(1, n):
        i = (start + step) % n
        after = (i + 1) % n
        for j in range(rows):
            k = system.number[i, j]
            if k < 0:
                continue
            reach = max(reach, k)
            if j + 1 < rows:
                reach = max(reach, system.number[i, j + 1])
            if step < n - 1:
                reach = max(reach, system.number[after, j])
            system.reach[k] = reach


@kernel
def assemble(system: BandSystem, fields: FilmFields, rows: int) -> None:
    """Fill the matrix of the numbered nodes; the others have p = 0."""
    n = system.number.shape[0]
    width = system.band.shape[1]
    inner, edge, start = system.size[0], system.size[1], system.size[2]
    for k in range(inner):
        for d in range(width):
            system.band[k, d] = 0.0
        for e in range(edge):
            system.border[k, e] = 0.0
    for e in range(edge):
        for f in range(edge):
            system.corner[e, f] = 0.0
    for i in range(n):
        before = i - 1 if i > 0 else n - 1
        after = i + 1 if i < n - 1 else 0
        for j in range(rows):
            k = system.number[i, j]
            if k < 0:
                continue
            centre = (
                fields.cells[i, j].k_theta
                + fields.cells[before, j].k_theta
                + fields.z_faces[i, j].k_z
                + fields.z_faces[i, j + 1].k_z
            )
            above = system.number[i, j + 1] if j + 1 < rows else -1
            if i == start:
                e = k - inner
                system.corner[e, e] = centre
                if above >= 0:
                    system.corner[e + 1, e] = -fields.z_faces[i, j + 1].k_z
                if system.number[before, j] >= 0:
                    system.border[system.number[before, j], e] -= fields.cells[before, j].k_theta
                if system.number[after, j] >= 0:
                    system.border[system.number[after, j], e] -= fields.cells[i, j].k_theta
                continue
            system.band[k, 0] = centre
            if above >= 0:
                system.band[k, above - k] = -fields.z_faces[i, j + 1].k_z
            if after != start and system.number[after, j] >= 0:
                system.band[k, system.number[after, j] - k] = -fields.cells[i, j].k_theta


@kernel
def factorise(system: BandSystem) -> None:
    """Replace the matrix by its factors; pivots are kept inverted."""
    inner, edge = system.size[0], system.size[1]
    band, border, corner = system.band, system.border, system.corner
    for k in range(inner):
        inverse = 1.0 / band[k, 0]
        width = system.reach[k] - k
        for d in range(1, width + 1):
            factor = band[k, d] * inverse
            if factor != 0.0:
                for e in range(width + 1 - d):
                    band[k + d, e] -= factor * band[k, d + e]
                for e in range(edge):
                    border[k + d, e] -= factor * border[k, e]
        for e in range(edge):
            factor = border[k, e] * inverse
            if factor != 0.0:
                for f in range(e + 1):
                    corner[e, f] -= factor * border[k, f]
        band[k, 0] = inverse
        for d in range(1, width + 1):
            band[k, d] *= inverse
        for e in range(edge):
            border[k, e] *= inverse
    _factorise_corner(corner, edge)


@kernel
def _factorise_corner(corner: FloatArray, edge: int) -> None:
    for k in range(edge):
        inverse = 1.0 / corner[k, k]
        for i in range(k + 1, edge):
            factor = corner[i, k] * inverse
            for j in range(k + 1, i + 1):
                corner[i, j] -= factor * corner[j, k]
        corner[k, k] = inverse
        for i in range(k + 1, edge):
            corner[i, k] *= inverse


@kernel
def solve(system: BandSystem) -> None:
    """Replace all right-hand sides by the solutions."""
    inner, edge = system.size[0], system.size[1]
    band, border, corner, right = system.band, system.border, system.corner, system.right
    for k in range(inner):
        _forward(right, k, k + 1, band[k, 1:], system.reach[k] - k)
        _forward(right, k, inner, border[k], edge)
    for k in range(edge):
        for i in range(k + 1, edge):
            for c in range(SIDES):
                right[inner + i, c] -= corner[i, k] * right[inner + k, c]
    for k in range(edge - 1, -1, -1):
        for c in range(SIDES):
            right[inner + k, c] *= corner[k, k]
        for i in range(k + 1, edge):
            for c in range(SIDES):
                right[inner + k, c] -= corner[i, k] * right[inner + i, c]
    for k in range(inner - 1, -1, -1):
        for c in range(SIDES):
            right[k, c] *= band[k, 0]
        _backward(right, k, k + 1, band[k, 1:], system.reach[k] - k)
        _backward(right, k, inner, border[k], edge)


@kernel
def _forward(right: FloatArray, k: int, first: int, factors: FloatArray, count: int) -> None:
    """Subtract row ``k`` times the factors from the rows from ``first`` on."""
    a, b, c, d, e = right[k, 0], right[k, 1], right[k, 2], right[k, 3], right[k, 4]
    for i in range(count):
        factor = factors[i]
        right[first + i, 0] -= factor * a
        right[first + i, 1] -= factor * b
        right[first + i, 2] -= factor * c
        right[first + i, 3] -= factor * d
        right[first + i, 4] -= factor * e


@kernel
def _backward(right: FloatArray, k: int, first: int, factors: FloatArray, count: int) -> None:
    """Subtract the rows from ``first`` on times the factors from row ``k``."""
    a = b = c = d = e = 0.0
    for i in range(count):
        factor = factors[i]
        a += factor * right[first + i, 0]
        b += factor * right[first + i, 1]
        c += factor * right[first + i, 2]
        d += factor * right[first + i, 3]
        e += factor * right[first + i, 4]
    right[k, 0] -= a
    right[k, 1] -= b
    right[k, 2] -= c
    right[k, 3] -= d
    right[k, 4] -= e


@kernel
def solve_one(system: BandSystem) -> None:
    """Replace the single right-hand side by the solution."""
    inner, edge = system.size[0], system.size[1]
    band, border, corner, x = system.band, system.border, system.corner, system.single
    for k in range(inner):
        value = x[k]
        for d in range(1, system.reach[k] - k + 1):
            x[k + d] -= band[k, d] * value
        for e in range(edge):
            x[inner + e] -= border[k, e] * value
    for k in range(edge):
        for i in range(k + 1, edge):
            x[inner + i] -= corner[i, k] * x[inner + k]
    for k in range(edge - 1, -1, -1):
        total = x[inner + k] * corner[k, k]
        for i in range(k + 1, edge):
            total -= corner[i, k] * x[inner + i]
        x[inner + k] = total
    for k in range(inner - 1, -1, -1):
        # Two sums, so that one need not wait for the other.
        total, other = x[k] * band[k, 0], 0.0
        last = system.reach[k] - k
        for d in range(2, last + 1, 2):
            total -= band[k, d - 1] * x[k + d - 1]
            other -= band[k, d] * x[k + d]
        if last % 2 == 1:
            total -= band[k, last] * x[k + last]
        for e in range(edge):
            other -= border[k, e] * x[inner + e]
        x[k] = total + other
