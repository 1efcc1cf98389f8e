"""Factorisation and solution over the nodes where the film is full: L D Lᵀ of a band with a border.

Unknowns are numbered column after column (θ), so that the band is as wide as a column is high, and only nodes
with a full film are numbered. The circle is cut at a column without unknowns if cavitation leaves
one; otherwise the emptiest column becomes a border, numbered last. The matrix is symmetric, positive
definite and an M-matrix: no pivoting.
"""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.film.data import BandSystem, FilmFields, FlagArray
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
                fields.k_theta[i, j] + fields.k_theta[before, j] + fields.k_z[i, j] + fields.k_z[i, j + 1]
            )
            above = system.number[i, j + 1] if j + 1 < rows else -1
            if i == start:
                e = k - inner
                system.corner[e, e] = centre
                if above >= 0:
                    system.corner[e + 1, e] = -fields.k_z[i, j + 1]
                if system.number[before, j] >= 0:
                    system.border[system.number[before, j], e] -= fields.k_theta[before, j]
                if system.number[after, j] >= 0:
                    system.border[system.number[after, j], e] -= fields.k_theta[i, j]
                continue
            system.band[k, 0] = centre
            if above >= 0:
                system.band[k, above - k] = -fields.k_z[i, j + 1]
            if after != start and system.number[after, j] >= 0:
                system.band[k, system.number[after, j] - k] = -fields.k_theta[i, j]


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
def solve(system: BandSystem, columns: int) -> None:
    """Replace the first ``columns`` right-hand sides by the solutions."""
    inner, edge = system.size[0], system.size[1]
    band, border, corner, right = system.band, system.border, system.corner, system.right
    for k in range(inner):
        for d in range(1, system.reach[k] - k + 1):
            factor = band[k, d]
            for c in range(columns):
                right[k + d, c] -= factor * right[k, c]
        for e in range(edge):
            factor = border[k, e]
            for c in range(columns):
                right[inner + e, c] -= factor * right[k, c]
    for k in range(edge):
        for i in range(k + 1, edge):
            for c in range(columns):
                right[inner + i, c] -= corner[i, k] * right[inner + k, c]
    for k in range(edge - 1, -1, -1):
        for c in range(columns):
            right[inner + k, c] *= corner[k, k]
        for i in range(k + 1, edge):
            for c in range(columns):
                right[inner + k, c] -= corner[i, k] * right[inner + i, c]
    for k in range(inner - 1, -1, -1):
        for c in range(columns):
            right[k, c] *= band[k, 0]
        for d in range(1, system.reach[k] - k + 1):
            factor = band[k, d]
            for c in range(columns):
                right[k, c] -= factor * right[k + d, c]
        for e in range(edge):
            factor = border[k, e]
            for c in range(columns):
                right[k, c] -= factor * right[inner + e, c]
