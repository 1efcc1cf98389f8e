"""Derivatives of the wrench by implicit differentiation at the cavitated set that was found.

The wrench is W_k = g_k·π (and the Couette friction), with A π = b on the nodes with a full film. With
A λ_k = g_k on the same nodes, dW_k = λ_k·(db − dA π) + dg_k·π: five solves with the factors at hand, and sums
over faces.
Where a node is about to cavitate the derivative has a kink, of the size of that node's share.
"""

import math

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.band import assemble, factorise, number_unknowns, solve
from tribodyn.kernels.film.data import HALF_SOMMERFELD, JFO, FilmData, FilmMemory
from tribodyn.kernels.film.gap import squeeze_rate
from tribodyn.kernels.film.jfo import couette_by_fill, filled_column, transport_adjoint
from tribodyn.kernels.jit import clear, kernel


@kernel
def friction_load(memory: FilmMemory, i: int, j: int) -> float:
    """Return ∂M_z/∂π of a node [m], in units of the force scale: the pressure part of the fluid friction.

    −½ ∫ h φ_fp ∂p/∂θ dA, summed by parts.
    """
    n = memory.pressure.shape[0]
    cells = memory.fields.cells
    before = i - 1 if i > 0 else n - 1
    return (cells[i, j].drag - cells[before, j].drag) * n / (4.0 * math.pi)


@kernel
def solve_adjoints(film: FilmData, memory: FilmMemory, omega: float, rows: int, half: bool) -> None:
    """Fill ``memory.adjoint``; the factors of the film must be in ``memory.system``.

    A symmetric film answers tilts with odd fields, which vanish in the middle row: a system of its own.
    """
    if film.constants.cavitation == JFO:
        _solve_transport(film, memory, omega)
        return
    if not half:
        _solve_for(film, memory, rows, rows, 0, 5)
        return
    _solve_for(film, memory, rows, rows, 0, 3)
    system = memory.system
    number_unknowns(system, memory.active, rows - 1)
    assemble(system, memory.fields, rows - 1)
    factorise(system)
    _solve_for(film, memory, rows, rows - 1, 3, 2)


@kernel
def _solve_for(film: FilmData, memory: FilmMemory, rows: int, solved: int, first: int, count: int) -> None:
    """Solve for ``count`` members in the order F_x, F_y, M_z, M_x, M_y, over the first ``solved`` rows."""
    fields, system, active = memory.fields, memory.system, memory.active
    positive_only = film.constants.cavitation == HALF_SOMMERFELD
    for i in range(active.shape[0]):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        for j in range(solved):
            if active[i, j] == 0:
                continue
            k = system.number[i, j]
            weight = fields.rows[j].weight
            z = film.z_node[j + 1] + fields.columns[i].arm_node
            share = 0.0 if positive_only and memory.pressure[i, j] <= 0.0 else 1.0
            loads = (c, s, friction_load(memory, i, j) / weight, -z * s, -z * c)
            for m in range(5):
                if first <= m < first + count:
                    system.right[k, m - first] = share * weight * loads[m]
    solve(system)
    for i in range(active.shape[0]):
        for j in range(rows):
            k = system.number[i, j] if j < solved and active[i, j] == 1 else -1
            for m in range(count):
                memory.adjoint[first + m, i, j] = system.right[k, m] if k >= 0 else 0.0


@kernel
def _solve_transport(film: FilmData, memory: FilmMemory, omega: float) -> None:
    """Solve for all members with ``jfo``: cavitated nodes count by the friction of their oil."""
    fields, active = memory.fields, memory.active
    n, rows = active.shape
    friction = couette_scale(film) * omega / force_scale(film)
    for m in range(5):
        for i in range(1, n):
            c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
            for j in range(rows):
                k = (i - 1) * rows + j
                z = film.z_node[j + 1] + fields.columns[i].arm_node
                if active[i, j] == 1:
                    memory.amount[k] = (c, s, friction_load(memory, i, j), -z * s, -z * c)[m]
                else:
                    memory.amount[k] = friction * couette_by_fill(fields, i, j) if m == 2 else 0.0
        transport_adjoint(memory, m)


@kernel
def fill_chart(film: FilmData, memory: FilmMemory, omega: float, rows: int, half: bool) -> None:
    """Fill ``memory.work.chart`` from the adjoints: rows F_x, F_y, M_x, M_y, M_z; columns the chart and ω."""
    chart, lean = memory.work.chart, memory.work.lean
    clear(chart)
    step = film.constants.length / film.z_face.size
    scale = force_scale(film)
    couette = couette_scale(film)
    order = (0, 1, 4, 2, 3)
    for m in range(5):
        k = order[m]
        gradient = memory.gradient[m]
        clear(gradient)
        for i in range(4):
            lean[i] = 0.0
        explicit = 1.0 if m == 2 else 0.0
        speed = _theta_sums(film, memory, omega, m, explicit, rows, step / film.constants.radius)
        _z_sums(memory, m, rows, half)
        if m == 2:
            speed += _couette_sums(memory, omega, couette / scale, rows, half)
        if k == 2 or k == 3:
            _add_turning_arms(film, memory, k, rows)
        chart[k, 8] = scale * speed
        for i in range(2):
            chart[k, 2 + i] = scale * lean[i]
            chart[k, 6 + i] = scale * lean[2 + i]
        for j in range(rows):
            z = film.z_node[j + 1]
            _add(chart[k], 0, scale, z, gradient[0, j], gradient[1, j])
            _add(chart[k], 4, scale, z, gradient[2, j], gradient[3, j])
        for j in range(rows + 1):
            _add(chart[k], 0, scale, film.z_face[j], gradient[4, j], gradient[5, j])
    if half:
        _mirror(chart)


@kernel
def _add_lean(lean: FloatArray, first: int, factor: float, c: float, s: float) -> None:
    """Add ``factor`` times (sin θ, cos θ), the derivative of s in t, from place ``first`` on."""
    lean[first] += factor * s
    lean[first + 1] += factor * c


@kernel
def _add_turning_arms(film: FilmData, memory: FilmMemory, k: int, rows: int) -> None:
    """Add the change of the lever arms with the tilt to the derivatives of M_x (2) or M_y (3)."""
    fields, positive_only = memory.fields, film.constants.cavitation == HALF_SOMMERFELD
    for i in range(memory.pressure.shape[0]):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        for j in range(rows):
            p = max(memory.pressure[i, j], 0.0) if positive_only else memory.pressure[i, j]
            load = fields.rows[j].weight * p * film.constants.radius
            _add_lean(memory.work.lean, 0, -load * (s if k == 2 else c), c, s)


@kernel
def _cell_area(film: FilmData) -> float:
    """Return r dθ dz of a cell [m²]."""
    constants = film.constants
    return 2.0 * math.pi * constants.radius / film.columns.size * constants.length / film.z_face.size


@kernel
def force_scale(film: FilmData) -> float:
    """Return p r dθ dz of a node with π = 1/s [N s]."""
    constants = film.constants
    slender = constants.radius / constants.clearance
    return 6.0 * constants.viscosity * slender * slender * _cell_area(film)


@kernel
def couette_scale(film: FilmData) -> float:
    """Return the torque per ω of a cell with c φ_f/h = 1 [N m s]; it opposes ω."""
    constants = film.constants
    return -constants.viscosity * constants.radius**2 * _cell_area(film) / constants.clearance


@kernel
def _add(row: FloatArray, first: int, scale: float, z: float, d_a: float, d_b: float) -> None:
    """Carry derivatives by the offset (or velocity) of the axis at height ``z`` to the chart."""
    row[first] += scale * d_a
    row[first + 1] += scale * d_b
    row[first + 2] -= scale * z * d_b
    row[first + 3] -= scale * z * d_a


@kernel
def _mirror(chart: FloatArray) -> None:
    """Complete sums over half a symmetric film: even answers to even motions, odd answers to tilts."""
    for k in range(5):
        odd = k == 2 or k == 3
        for i in range(9):
            tilt = i == 2 or i == 3 or i == 6 or i == 7
            chart[k, i] = 2.0 * chart[k, i] if odd == tilt else 0.0


@kernel
def _theta_sums(
    film: FilmData, memory: FilmMemory, omega: float, m: int, explicit: float, rows: int, d_zeta: float
) -> float:
    """Add the derivatives of θ faces and nodes by offset and velocity; return that by ω."""
    fields, sums, adjoint, pressure = memory.fields, memory.gradient[m], memory.adjoint[m], memory.pressure
    lean = memory.work.lean
    n = pressure.shape[0]
    squeeze = 2.0 * (2.0 * math.pi / n) * d_zeta / film.constants.clearance
    if film.constants.cavitation == JFO:
        squeeze = 0.0
    friction = explicit * n / (4.0 * math.pi)
    positive_only = film.constants.cavitation == HALF_SOMMERFELD
    speed = 0.0
    for i in range(n):
        after = i + 1 if i < n - 1 else 0
        c_f, s_f = fields.columns[i].cos_face, fields.columns[i].sin_face
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        arm_face, arm, arm_rate = (
            fields.columns[i].arm_face,
            fields.columns[i].arm_node,
            fields.columns[i].arm_rate,
        )
        for j in range(rows):
            rise = adjoint[i, j] - adjoint[after, j]
            filled = memory.fill[i, j] if omega > 0.0 else memory.fill[after, j]
            flow = d_zeta * filled * rise
            here, there = pressure[i, j], pressure[after, j]
            cell = fields.cells[i, j]
            face = -rise * cell.dk_theta * (here - there) - omega * flow * cell.d_wedge
            if positive_only:
                here, there = max(here, 0.0), max(there, 0.0)
            face += friction * cell.d_drag * (here - there)
            speed -= flow * cell.wedge
            rate = squeeze_rate(film, fields, i, j)
            node = -squeeze * adjoint[i, j]
            bend = node * cell.d_contact * rate
            node *= cell.contact
            sums[0, j] += face * c_f + bend * c
            sums[1, j] += face * s_f + bend * s
            sums[2, j] += node * c
            sums[3, j] += node * s
            _add_lean(lean, 0, -face * arm_face, c_f, s_f)
            _add_lean(lean, 0, -bend * arm - node * arm_rate, c, s)
            _add_lean(lean, 2, -node * arm, c, s)
    return speed


@kernel
def _z_sums(memory: FilmMemory, m: int, rows: int, half: bool) -> None:
    """Add the derivatives of z faces by offset."""
    fields, sums, adjoint, pressure = memory.fields, memory.gradient[m], memory.adjoint[m], memory.pressure
    for i in range(pressure.shape[0]):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        face = -fields.z_faces[i, 0].dk_z * adjoint[i, 0] * pressure[i, 0]
        sums[4, 0] += face * c
        sums[5, 0] += face * s
        total = face
        for j in range(1, rows):
            face = (
                -fields.z_faces[i, j].dk_z
                * (adjoint[i, j] - adjoint[i, j - 1])
                * (pressure[i, j] - pressure[i, j - 1])
            )
            sums[4, j] += face * c
            sums[5, j] += face * s
            total += face
        if not half:
            face = -fields.z_faces[i, rows].dk_z * adjoint[i, rows - 1] * pressure[i, rows - 1]
            sums[4, rows] += face * c
            sums[5, rows] += face * s
            total += face
        _add_lean(memory.work.lean, 0, -total * fields.columns[i].arm_node, c, s)


@kernel
def _couette_sums(memory: FilmMemory, omega: float, share: float, rows: int, half: bool) -> float:
    """Add the Couette friction to the sums of M_z; return its derivative by ω."""
    fields, sums = memory.fields, memory.gradient[2]
    faces = rows if half else rows + 1
    total = 0.0
    for i in range(memory.pressure.shape[0]):
        c, s = fields.columns[i].cos_node, fields.columns[i].sin_node
        for j in range(faces):
            filled = share * filled_column(memory.fill, i, j)
            slope = omega * filled * fields.z_faces[i, j].d_couette
            sums[4, j] += slope * c
            sums[5, j] += slope * s
            _add_lean(memory.work.lean, 0, -slope * fields.columns[i].arm_node, c, s)
            total += filled * fields.z_faces[i, j].couette
    return total
