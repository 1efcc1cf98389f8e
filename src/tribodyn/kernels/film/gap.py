"""Factors of rough surfaces at the mean gap, and conductances and sources of Eq. 52 with their derivatives.

Finite volumes around the nodes. With ζ = z/r, h̄ = h/c and π = p/(6 η r²/c²), Eq. 52 over one cell reads

    Σ_faces K (π − π_neighbour) = −ω [wedge]_θ Δζ − 2 φ_c (∂h̄/∂t) Δθ Δζ,

K = φ_θ h̄³ Δζ/Δθ or φ_z h̄³ Δθ/Δζ at the faces, wedge = (h_T + σ φ_s)/c, with the shaft as the moving
surface 1. φ_c ∂h/∂θ is written as ∂h_T/∂θ, which it is, so that what leaves one cell enters the next. Gaps
are taken where they are needed, at nodes and at faces, not averaged.
"""

import math

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.data import CONVERGED, OUT_OF_RANGE, FilmData, FilmFields, FlowTable
from tribodyn.kernels.film.report import groove_direction
from tribodyn.kernels.jit import inlined, kernel

LEAST_SEPARATION = 0.5  #: Flow factors and h³ see max(h, σ/2): contact reaches below h = 0.


@inlined
def cubic(c: FloatArray, x: float) -> float:
    """Return c_0 + c_1 x + c_2 x² + c_3 x³."""
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]))


@inlined
def cubic_slope(c: FloatArray, x: float) -> float:
    """Return the derivative of :func:`cubic`."""
    return c[1] + x * (2.0 * c[2] + 3.0 * x * c[3])


@kernel
def place(table: FlowTable, roughness: float, gap: float) -> tuple[int, float, float]:
    """Return the interval of the factors, the place in it and the derivative of place by gap [1/m].

    ``gap`` [m] is already bounded below; the derivative is that above the bound.
    """
    inverse = roughness / gap
    x = inverse * table.inverse_step
    k = min(int(x), table.factors.shape[0] - 1)
    return k, x - k, -x / gap


@kernel
def mean_gap(table: FlowTable, roughness: float, gap: float) -> tuple[float, float, float]:
    """Return the mean gap h_T [m], φ_c = ∂h_T/∂h and ∂φ_c/∂h [1/m] (Wu and Zheng).

    φ_c keeps its value at h = 0 below, and is 1 above the table.
    """
    if roughness == 0.0:
        return gap, 1.0, 0.0
    x = gap / (roughness * table.gap_step)
    n = table.mean_gap.shape[0]
    if x >= n:
        return gap, 1.0, 0.0
    scale = 1.0 / table.gap_step
    if x < 0.0:
        c = table.mean_gap[0]
        return roughness * (c[0] + c[1] * x), c[1] * scale, 0.0
    k = min(int(x), n - 1)
    c = table.mean_gap[k]
    x -= k
    slope = cubic_slope(c, x) * scale
    bend = (2.0 * c[2] + 6.0 * x * c[3]) * scale * scale / roughness
    return roughness * cubic(c, x), slope, bend


LEAST_RANGE = -4.0  #: h/σ below which there is no answer.


@kernel
def evaluate_gap(
    film: FilmData, fields: FilmFields, u: FloatArray, omega: float, rows: int, half: bool
) -> tuple[int, float]:
    """Fill ``fields`` for the chart ``u``; return a status and the smallest gap [m].

    ``rows`` rows of nodes are filled; with ``half`` the last of them is the middle of a symmetric film.
    """
    _turn_grid(film, fields, u)
    _lean(film, fields, u)
    _offsets(film, fields, u, rows, half)
    alike = film.constants.uniform == 1 and u[2] == 0.0 and u[3] == 0.0
    least = LEAST_RANGE * film.constants.roughness
    lowest = _theta_faces(film, fields, rows, alike)
    lowest = min(lowest, _z_faces(film, fields, rows, half, alike))
    lowest = min(lowest, _nodes(film, fields, rows, alike))
    if not lowest > least:  # also when something is not a number
        return OUT_OF_RANGE, lowest
    _sources(film, fields, omega, rows)
    return CONVERGED, lowest


@kernel
def _turn_grid(film: FilmData, fields: FilmFields, u: FloatArray) -> None:
    """Cosines and sines of the grid, whose first column lies on the groove if there is one."""
    c, s = 1.0, 0.0
    if film.constants.groove == 1:
        c, s = groove_direction(u)
    for i in range(film.columns.size):
        fields.columns[i].cos_node = film.columns[i].cos_node * c - film.columns[i].sin_node * s
        fields.columns[i].sin_node = film.columns[i].sin_node * c + film.columns[i].cos_node * s
        fields.columns[i].cos_face = film.columns[i].cos_face * c - film.columns[i].sin_face * s
        fields.columns[i].sin_face = film.columns[i].sin_face * c + film.columns[i].cos_face * s


@kernel
def _lean(film: FilmData, fields: FilmFields, u: FloatArray) -> None:
    """Fill the second-order lever arms r s, see ``report``."""
    r = film.constants.radius
    for i in range(film.columns.size):
        column = fields.columns[i]
        fields.columns[i].arm_node = r * (u[3] * column.cos_node + u[2] * column.sin_node)
        fields.columns[i].arm_face = r * (u[3] * column.cos_face + u[2] * column.sin_face)
        fields.columns[i].arm_rate = r * (u[7] * column.cos_node + u[6] * column.sin_node)


@kernel
def squeeze_rate(film: FilmData, fields: FilmFields, i: int, j: int) -> float:
    """Return ∂h/∂t at a node [m/s]."""
    column, row = fields.columns[i], fields.rows[j]
    leaning = column.arm_node * column.arm_rate / film.constants.radius
    return row.v_a * column.cos_node + row.v_b * column.sin_node - leaning


@kernel
def _offsets(film: FilmData, fields: FilmFields, u: FloatArray, rows: int, half: bool) -> None:
    """Offsets and velocities of the shaft axis at the rows and z faces, and the weights of the rows."""
    for j in range(rows):
        z = film.z_node[j + 1]
        fields.rows[j].a = u[0] - z * u[3]
        fields.rows[j].b = u[1] - z * u[2]
        fields.rows[j].v_a = u[4] - z * u[7]
        fields.rows[j].v_b = u[5] - z * u[6]
        fields.rows[j].weight = 1.0
    if half:
        fields.rows[rows - 1].weight = 0.5
    for j in range(rows + 1):
        z = film.z_face[j]
        fields.rows[j].face_a = u[0] - z * u[3]
        fields.rows[j].face_b = u[1] - z * u[2]


@kernel
def theta_face(film: FilmData, gap: float) -> tuple[float, float, float, float, float, float]:
    """Return φ_θ h³/c³ [1], (h_T + σ φ_s)/c [1] and h φ_fp [m], each followed by its derivative by h."""
    sigma, inverse = film.constants.roughness, 1.0 / film.constants.clearance
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
    sigma, inverse = film.constants.roughness, 1.0 / film.constants.clearance
    h = max(gap, LEAST_SEPARATION * sigma)
    cube, thinness, per_gap = (h * inverse) ** 3, film.constants.clearance / h, 1.0 / h
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
    """Fill the arrays on θ faces and return the smallest gap there [m]."""
    n = film.columns.size
    d_zeta = film.constants.length / (film.z_face.size * film.constants.radius)
    shape = d_zeta * n / (2.0 * math.pi)
    lowest = math.inf
    for i in range(n):
        c, s = fields.columns[i].cos_face, fields.columns[i].sin_face
        room, taken = film.constants.clearance, 0.5 * fields.columns[i].arm_face ** 2 / film.constants.radius
        for j in range(rows):
            weight = fields.rows[j].weight
            if alike and j > 0:
                cell, first = fields.cells[i, j], fields.cells[i, 0]
                cell.k_theta, cell.dk_theta = weight * first.k_theta, weight * first.dk_theta
                cell.wedge, cell.d_wedge = weight * first.wedge, weight * first.d_wedge
                cell.drag, cell.d_drag = weight * first.drag, weight * first.d_drag
                continue
            gap = room + fields.rows[j].a * c + fields.rows[j].b * s - taken + film.wear_theta[i, j + 1]
            lowest = min(lowest, gap) if gap == gap else -math.inf
            k, dk, wedge, d_wedge, drag, d_drag = theta_face(film, gap)
            cell = fields.cells[i, j]
            cell.k_theta, cell.dk_theta = weight * shape * k, weight * shape * dk
            cell.wedge, cell.d_wedge = weight * wedge, weight * d_wedge
            cell.drag, cell.d_drag = weight * drag, weight * d_drag
    return lowest


@kernel
def _z_faces(film: FilmData, fields: FilmFields, rows: int, half: bool, alike: bool) -> float:
    """Fill the arrays on z faces and return the smallest gap there [m].

    The face above the middle of a symmetric film carries no flow.
    """
    n = film.columns.size
    d_zeta = film.constants.length / (film.z_face.size * film.constants.radius)
    shape = 2.0 * math.pi / (n * d_zeta)
    faces = rows if half else rows + 1
    lowest = math.inf
    for i in range(n):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        room, taken = film.constants.clearance, 0.5 * fields.columns[i].arm_node ** 2 / film.constants.radius
        for j in range(faces):
            if alike and j > 0:
                fields.z_faces[i, j] = fields.z_faces[i, 0]
                continue
            gap = room + fields.rows[j].face_a * c + fields.rows[j].face_b * s - taken + film.wear_z[i, j]
            lowest = min(lowest, gap) if gap == gap else -math.inf
            k, dk, couette, d_couette = z_face(film, gap)
            face = fields.z_faces[i, j]
            face.k_z, face.dk_z, face.couette, face.d_couette = shape * k, shape * dk, couette, d_couette
        if half:
            face = fields.z_faces[i, rows]
            face.k_z = face.dk_z = face.couette = face.d_couette = 0.0
    return lowest


@kernel
def _nodes(film: FilmData, fields: FilmFields, rows: int, alike: bool) -> float:
    """Fill the contact factor at the nodes and return the smallest gap there [m]."""
    lowest = math.inf
    for i in range(film.columns.size):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        room, taken = film.constants.clearance, 0.5 * fields.columns[i].arm_node ** 2 / film.constants.radius
        for j in range(rows):
            if alike and j > 0:
                fields.cells[i, j].contact = fields.rows[j].weight * fields.cells[i, 0].contact
                fields.cells[i, j].d_contact = fields.rows[j].weight * fields.cells[i, 0].d_contact
                continue
            gap = room + fields.rows[j].a * c + fields.rows[j].b * s - taken + film.wear_node[i, j + 1]
            lowest = min(lowest, gap) if gap == gap else -math.inf
            _, slope, bend = mean_gap(film.table, film.constants.roughness, gap)
            fields.cells[i, j].contact = fields.rows[j].weight * slope
            fields.cells[i, j].d_contact = fields.rows[j].weight * bend
    return lowest


@kernel
def _sources(film: FilmData, fields: FilmFields, omega: float, rows: int) -> None:
    """Fill the source of every cell: wedge, shear and squeeze."""
    n = film.columns.size
    d_zeta = film.constants.length / (film.z_face.size * film.constants.radius)
    squeeze = 2.0 * (2.0 * math.pi / n) * d_zeta / film.constants.clearance
    for i in range(n):
        before = i - 1 if i > 0 else n - 1
        for j in range(rows):
            rate = squeeze_rate(film, fields, i, j)
            flow = omega * d_zeta * (fields.cells[i, j].wedge - fields.cells[before, j].wedge)
            fields.cells[i, j].source = -flow - squeeze * fields.cells[i, j].contact * rate
