"""Wrench of the film on the shaft, with its derivatives, Eqs. 52 and 53.

See ``kernels.film`` for the arguments. A film without tilt, whose wear is the same at z and −z, is
solved on half its length.
"""

import math

from mebdf.arrays import FloatArray, FloatMatrix
from tribodyn.kernels.film.adjoint import (
    couette_scale,
    fill_chart,
    force_scale,
    friction_load,
    solve_adjoints,
)
from tribodyn.kernels.film.cavitation import solve_pressure
from tribodyn.kernels.film.data import CONVERGED, HALF_SOMMERFELD, JFO, FilmData, FilmMemory
from tribodyn.kernels.film.gap import evaluate_gap
from tribodyn.kernels.film.jfo import filled_column, solve_transport
from tribodyn.kernels.film.report import chart_of, from_chart, turn_with_groove
from tribodyn.kernels.jit import entry, kernel


@entry
def film_wrench(film: FilmData, memory: FilmMemory, y: FloatArray, omega: float, out: FloatArray) -> int:
    """Fill ``out`` (5,) with (F_x, F_y, M_x, M_y, M_z) [N, N m] and return a status."""
    chart_of(y, memory.work.state)
    return wrench_in_chart(film, memory, omega, out)


@entry
def film_wrench_and_jacobian(
    film: FilmData, memory: FilmMemory, y: FloatArray, omega: float, out: FloatArray, jacobian: FloatMatrix
) -> int:
    """Fill ``out`` as :func:`film_wrench` and ``jacobian`` (5, 9) with its derivatives; return a status."""
    u = memory.work.state
    chart_of(y, u)
    status = wrench_in_chart(film, memory, omega, out)
    if status == CONVERGED:
        derivatives_in_chart(film, memory, omega, out)
        from_chart(u, y, memory.work.chart, jacobian)
    return status


@kernel
def derivatives_in_chart(film: FilmData, memory: FilmMemory, omega: float, out: FloatArray) -> None:
    """Fill ``memory.work.chart`` with the derivatives of the wrench ``out`` that was found last."""
    rows = memory.work.effort[1]
    half = rows < memory.pressure.shape[1]
    solve_adjoints(film, memory, omega, rows, half)
    fill_chart(film, memory, omega, rows, half)
    if film.constants.groove == 1:
        turn_with_groove(memory.work.state, out, memory.work.chart)


@kernel
def wrench_in_chart(film: FilmData, memory: FilmMemory, omega: float, out: FloatArray) -> int:
    """Solve for the pressure at ``memory.work.state``, fill ``out`` (5,) and return a status."""
    u = memory.work.state
    n_z = film.z_face.size
    half = (
        film.constants.mirror == 1
        and film.constants.cavitation != JFO
        and u[2] == 0.0
        and u[3] == 0.0
        and u[6] == 0.0
        and u[7] == 0.0
    )
    rows = n_z // 2 if half else n_z - 1
    memory.work.effort[1] = rows
    status, memory.work.least = evaluate_gap(film, memory.fields, u, omega, rows, half)
    if status == CONVERGED:
        if film.constants.cavitation == JFO:
            status = solve_transport(film, memory, omega)
        else:
            status = solve_pressure(film, memory, rows)
    if status != CONVERGED:
        for k in range(5):
            out[k] = math.nan
        return status
    if half:
        _mirror_fields(memory, rows)
    _integrate(film, memory, omega, rows, half, out)
    return CONVERGED


@kernel
def _mirror_fields(memory: FilmMemory, rows: int) -> None:
    """Copy the lower half of the film to the upper one."""
    n, m = memory.pressure.shape
    for i in range(n):
        for j in range(rows, m):
            memory.pressure[i, j] = memory.pressure[i, m - 1 - j]
            memory.active[i, j] = memory.active[i, m - 1 - j]


@kernel
def _integrate(
    film: FilmData, memory: FilmMemory, omega: float, rows: int, half: bool, out: FloatArray
) -> None:
    """Integrate pressure and friction over the shaft."""
    fields = memory.fields
    f_x = f_y = m_x = m_y = torque = 0.0
    for i in range(memory.pressure.shape[0]):
        c, s, arm = fields.columns[i].cos_node, fields.columns[i].sin_node, fields.columns[i].arm_node
        for j in range(rows):
            p = memory.pressure[i, j]
            if film.constants.cavitation == HALF_SOMMERFELD:
                p = max(p, 0.0)
            load = fields.rows[j].weight * p
            f_x += load * c
            f_y += load * s
            m_x -= (film.z_node[j + 1] + arm) * load * s
            m_y -= (film.z_node[j + 1] + arm) * load * c
            torque += p * friction_load(memory, i, j)
    faces = rows if half else rows + 1
    couette = 0.0
    for i in range(memory.pressure.shape[0]):
        for j in range(faces):
            couette += fields.z_faces[i, j].couette * filled_column(memory.fill, i, j)
    scale = force_scale(film)
    both = 2.0 if half else 1.0
    out[0] = both * scale * f_x
    out[1] = both * scale * f_y
    out[2] = 0.0 if half else scale * m_x
    out[3] = 0.0 if half else scale * m_y
    out[4] = both * (scale * torque + couette_scale(film) * omega * couette)
