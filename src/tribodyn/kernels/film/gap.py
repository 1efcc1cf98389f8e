"""Conductances and sources of Eq. 52 at one state, with their derivatives by the gap.

Finite volumes around the nodes. With ζ = z/r, h̄ = h/c and π = p/(6 η r²/c²), Eq. 52 over one cell reads

    Σ_faces K (π − π_neighbour) = −ω [wedge]_θ Δζ − 2 φ_c (∂h̄/∂t) Δθ Δζ,

K = φ_θ h̄³ Δζ/Δθ or φ_z h̄³ Δθ/Δζ at the faces, wedge = (h_T + σ φ_s)/c, with the journal as the moving
surface 1. φ_c ∂h/∂θ is written as ∂h_T/∂θ, which it is, so that what leaves one cell enters the next. Gaps
are taken where they are needed, at nodes and at faces, not averaged.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.film.attitude import groove_direction
from tribodyn.kernels.film.data import CONVERGED, OUT_OF_RANGE, FilmData, FilmFields
from tribodyn.kernels.film.factors import LEAST_SEPARATION, cubic, cubic_slope, mean_gap, place
from tribodyn.kernels.jit import kernel

LEAST_RANGE = -4.0
"""h/σ below which there is no answer."""


@kernel
def evaluate_gap(
    film: FilmData, fields: FilmFields, u: FloatArray, omega: float, rows: int, half: bool
) -> int:
    """Fill ``fields`` for the chart ``u`` and return a status.

    ``rows`` rows of nodes are filled; with ``half`` the last of them is the middle of a symmetric film.
    """
    _turn_grid(film, fields, u)
    _offsets(film, fields, u, rows, half)
    alike = film.uniform == 1 and u[2] == 0.0 and u[3] == 0.0
    least = LEAST_RANGE * film.roughness
    lowest = _theta_faces(film, fields, rows, alike)
    lowest = min(lowest, _z_faces(film, fields, rows, half, alike))
    lowest = min(lowest, _nodes(film, fields, rows, alike))
    if not lowest > least:  # also when something is not a number
        return OUT_OF_RANGE
    _sources(film, fields, omega, rows)
    return CONVERGED


@kernel
def _turn_grid(film: FilmData, fields: FilmFields, u: FloatArray) -> None:
    """Cosines and sines of the grid, whose first column lies on the groove if there is one."""
    c, s = 1.0, 0.0
    if film.groove == 1:
        c, s = groove_direction(u)
    for i in range(film.cos_node.size):
        fields.cos_node[i] = film.cos_node[i] * c - film.sin_node[i] * s
        fields.sin_node[i] = film.sin_node[i] * c + film.cos_node[i] * s
        fields.cos_face[i] = film.cos_face[i] * c - film.sin_face[i] * s
        fields.sin_face[i] = film.sin_face[i] * c + film.cos_face[i] * s


@kernel
def _offsets(film: FilmData, fields: FilmFields, u: FloatArray, rows: int, half: bool) -> None:
    """Offsets and velocities of the journal axis at the rows and z faces, and the weights of the rows."""
    for j in range(rows):
        z = film.z_node[j + 1]
        fields.offset[0, j] = u[0] - z * u[3]
        fields.offset[1, j] = u[1] - z * u[2]
        fields.offset[2, j] = u[4] - z * u[7]
        fields.offset[3, j] = u[5] - z * u[6]
        fields.weight[j] = 1.0
    if half:
        fields.weight[rows - 1] = 0.5
    for j in range(rows + 1):
        z = film.z_face[j]
        fields.face_offset[0, j] = u[0] - z * u[3]
        fields.face_offset[1, j] = u[1] - z * u[2]


@kernel
def theta_face(film: FilmData, gap: float) -> tuple[float, float, float, float, float, float]:
    """Return φ_θ h³/c³ [1], (h_T + σ φ_s)/c [1] and h φ_fp [m], each followed by its derivative by h."""
    sigma, inverse = film.roughness, 1.0 / film.clearance
    if sigma == 0.0:
        cube = (gap * inverse) ** 3
        return cube, 3.0 * cube / gap, gap * inverse, inverse, gap, 1.0
    mean, slope, _ = mean_gap(film.table, sigma, gap)
    h = max(gap, LEAST_SEPARATION * sigma)
    k, x, dx = place(film.table, sigma, h)
    pressure, shear, friction = film.table.factors[k, 0], film.table.factors[k, 2], film.table.factors[k, 4]
    cube = (h * inverse) ** 3
    phi, phi_fp = cubic(pressure, x), cubic(friction, x)
    wedge = (mean + sigma * cubic(shear, x)) * inverse
    if gap < h:
        return cube * phi, 0.0, wedge, slope * inverse, h * phi_fp, 0.0
    d_k = cube * (3.0 * phi / h + cubic_slope(pressure, x) * dx)
    d_wedge = (slope + sigma * cubic_slope(shear, x) * dx) * inverse
    return cube * phi, d_k, wedge, d_wedge, h * phi_fp, phi_fp + h * cubic_slope(friction, x) * dx


@kernel
def z_face(film: FilmData, gap: float) -> tuple[float, float, float, float]:
    """Return φ_z h³/c³ and c φ_f/h, each followed by its derivative by h [1/m]."""
    sigma, inverse = film.roughness, 1.0 / film.clearance
    h = max(gap, LEAST_SEPARATION * sigma)
    cube, thinness, per_gap = (h * inverse) ** 3, film.clearance / h, 1.0 / h
    if sigma == 0.0:
        return cube, 3.0 * cube * per_gap, thinness, -thinness * per_gap
    k, x, dx = place(film.table, sigma, h)
    pressure, friction = film.table.factors[k, 1], film.table.factors[k, 3]
    phi, phi_f = cubic(pressure, x), cubic(friction, x)
    if gap < h:
        return cube * phi, 0.0, thinness * phi_f, 0.0
    d_k = cube * (3.0 * phi * per_gap + cubic_slope(pressure, x) * dx)
    return cube * phi, d_k, thinness * phi_f, thinness * (cubic_slope(friction, x) * dx - phi_f * per_gap)


@kernel
def _theta_faces(film: FilmData, fields: FilmFields, rows: int, alike: bool) -> float:
    """Fill what lives on θ faces and return the smallest gap there [m]."""
    n = film.cos_node.size
    d_zeta = film.length / (film.z_face.size * film.radius)
    shape = d_zeta * n / (2.0 * math.pi)
    lowest = math.inf
    for i in range(n):
        c, s = fields.cos_face[i], fields.sin_face[i]
        for j in range(rows):
            weight = fields.weight[j]
            if alike and j > 0:
                fields.k_theta[i, j] = weight * fields.k_theta[i, 0]
                fields.dk_theta[i, j] = weight * fields.dk_theta[i, 0]
                fields.wedge[i, j] = weight * fields.wedge[i, 0]
                fields.d_wedge[i, j] = weight * fields.d_wedge[i, 0]
                fields.drag[i, j] = weight * fields.drag[i, 0]
                fields.d_drag[i, j] = weight * fields.d_drag[i, 0]
                continue
            gap = (
                film.clearance + fields.offset[0, j] * c + fields.offset[1, j] * s + film.wear_theta[i, j + 1]
            )
            lowest = min(lowest, gap) if gap == gap else -math.inf
            k, dk, wedge, d_wedge, drag, d_drag = theta_face(film, gap)
            fields.k_theta[i, j] = weight * shape * k
            fields.dk_theta[i, j] = weight * shape * dk
            fields.wedge[i, j] = weight * wedge
            fields.d_wedge[i, j] = weight * d_wedge
            fields.drag[i, j] = weight * drag
            fields.d_drag[i, j] = weight * d_drag
    return lowest


@kernel
def _z_faces(film: FilmData, fields: FilmFields, rows: int, half: bool, alike: bool) -> float:
    """Fill what lives on z faces and return the smallest gap there [m].

    The face above the middle of a symmetric film carries no flow.
    """
    n = film.cos_node.size
    d_zeta = film.length / (film.z_face.size * film.radius)
    shape = 2.0 * math.pi / (n * d_zeta)
    faces = rows if half else rows + 1
    lowest = math.inf
    for i in range(n):
        c, s = fields.cos_node[i], fields.sin_node[i]
        for j in range(faces):
            if alike and j > 0:
                fields.k_z[i, j] = fields.k_z[i, 0]
                fields.dk_z[i, j] = fields.dk_z[i, 0]
                fields.couette[i, j] = fields.couette[i, 0]
                fields.d_couette[i, j] = fields.d_couette[i, 0]
                continue
            gap = (
                film.clearance
                + fields.face_offset[0, j] * c
                + fields.face_offset[1, j] * s
                + film.wear_z[i, j]
            )
            lowest = min(lowest, gap) if gap == gap else -math.inf
            k, dk, couette, d_couette = z_face(film, gap)
            fields.k_z[i, j] = shape * k
            fields.dk_z[i, j] = shape * dk
            fields.couette[i, j] = couette
            fields.d_couette[i, j] = d_couette
        if half:
            fields.k_z[i, rows] = 0.0
            fields.dk_z[i, rows] = 0.0
            fields.couette[i, rows] = 0.0
            fields.d_couette[i, rows] = 0.0
    return lowest


@kernel
def _nodes(film: FilmData, fields: FilmFields, rows: int, alike: bool) -> float:
    """Fill the contact factor at the nodes and return the smallest gap there [m]."""
    lowest = math.inf
    for i in range(film.cos_node.size):
        c, s = fields.cos_node[i], fields.sin_node[i]
        for j in range(rows):
            if alike and j > 0:
                fields.contact[i, j] = fields.weight[j] * fields.contact[i, 0]
                fields.d_contact[i, j] = fields.weight[j] * fields.d_contact[i, 0]
                continue
            gap = (
                film.clearance + fields.offset[0, j] * c + fields.offset[1, j] * s + film.wear_node[i, j + 1]
            )
            lowest = min(lowest, gap) if gap == gap else -math.inf
            _, slope, bend = mean_gap(film.table, film.roughness, gap)
            fields.contact[i, j] = fields.weight[j] * slope
            fields.d_contact[i, j] = fields.weight[j] * bend
    return lowest


@kernel
def _sources(film: FilmData, fields: FilmFields, omega: float, rows: int) -> None:
    """Fill the source of every cell: wedge, shear and squeeze."""
    n = film.cos_node.size
    d_zeta = film.length / (film.z_face.size * film.radius)
    squeeze = 2.0 * (2.0 * math.pi / n) * d_zeta / film.clearance
    for i in range(n):
        before = i - 1 if i > 0 else n - 1
        c, s = fields.cos_node[i], fields.sin_node[i]
        for j in range(rows):
            rate = fields.offset[2, j] * c + fields.offset[3, j] * s
            flow = omega * d_zeta * (fields.wedge[i, j] - fields.wedge[before, j])
            fields.source[i, j] = -flow - squeeze * fields.contact[i, j] * rate
