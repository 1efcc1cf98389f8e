"""Wrench of a surface on the shaft: sums over the nodes within reach."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel, summing
from tribodyn.kernels.joints.pressure import reference_velocity, total_pressure
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.listed import (
    APPROACH,
    AREA,
    ENTRY,
    FRACTION,
    INTERVAL,
    MOMENT,
    NORMAL,
    PART,
    PITCH,
    POSITION,
)
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, rewind
from tribodyn.kernels.lookup import cubic, offset

LEAST_SQUARE: Final = 1.0e-300
"""What stands for a squared slip velocity of zero."""


@inlined
def slip_square(surface: Record) -> float:
    """Return u_s² [m²/s²]."""
    return max(surface.slip_velocity * surface.slip_velocity, LEAST_SQUARE)


@kernel
def wrench(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record) -> None:
    """Fill ``normal`` and ``friction`` of the scratch.

    Parameters
    ----------
    data
        All joints.
    surface
        One of their surfaces.
    memory
        Their memory, of which the scratch alone is changed; its tilt is that of the shaft.
    station
        Of the shaft, see ``station``.
    """
    normal, friction = memory.scratch.normal, memory.scratch.friction
    for k in range(6):
        normal[k] = friction[k] = 0.0
    cubics = table_of(data, surface).cubics
    rewind(surface, memory)
    n = gather(data, surface, memory, station, 0.0)
    while n > 0:
        _add_nodes(cubics, surface, memory.scratch.listed.work, station, n, normal, friction)
        n = gather(data, surface, memory, station, 0.0)


@summing
def _add_nodes(
    cubics: FloatArray,
    surface: Record,
    work: FloatArray,
    station: Record,
    n: int,
    normal: FloatArray,
    friction: FloatArray,
) -> None:
    """Add the wrench of the ``n`` nodes in the list."""
    v_min, clip, mu = surface.minimum_entry_velocity, surface.tensile_clip, surface.friction_coefficient
    square = slip_square(surface)
    v_x, v_y, v_z = station.slip[0], station.slip[1], station.slip[2]
    w_x, w_y, w_z = station.w[0], station.w[1], station.w[2]
    f_x = f_y = f_z = m_x = m_y = m_z = 0.0
    g_x = g_y = g_z = l_x = l_y = l_z = 0.0
    for k in range(min(n, PART)):
        first, place = offset(work[INTERVAL + k]), work[FRACTION + k]
        approach = work[APPROACH + k]
        x, y, z = work[POSITION + k], work[POSITION + PITCH + k], work[POSITION + 2 * PITCH + k]
        n_x, n_y, n_z = work[NORMAL + k], work[NORMAL + PITCH + k], work[NORMAL + 2 * PITCH + k]
        reference = reference_velocity(work[ENTRY + k], approach, v_min)
        rigid, damping = cubic(cubics, first, place), cubic(cubics, first + np.uint64(4), place)
        push = work[AREA + k] * total_pressure(rigid, damping, approach / reference, clip)
        s_x, s_y, s_z = v_x + w_y * z - w_z * y, v_y + w_z * x - w_x * z, v_z + w_x * y - w_y * x
        along = n_x * s_x + n_y * s_y + n_z * s_z
        s_x, s_y, s_z = s_x - along * n_x, s_y - along * n_y, s_z - along * n_z
        drag = -mu * push / math.sqrt(s_x * s_x + s_y * s_y + s_z * s_z + square)
        t_x, t_y, t_z = drag * s_x, drag * s_y, drag * s_z
        f_x -= push * n_x
        f_y -= push * n_y
        f_z -= push * n_z
        m_x -= push * work[MOMENT + k]
        m_y -= push * work[MOMENT + PITCH + k]
        m_z -= push * work[MOMENT + 2 * PITCH + k]
        g_x += t_x
        g_y += t_y
        g_z += t_z
        l_x += y * t_z - z * t_y
        l_y += z * t_x - x * t_z
        l_z += x * t_y - y * t_x
    normal[0] += f_x
    normal[1] += f_y
    normal[2] += f_z
    normal[3] += m_x
    normal[4] += m_y
    normal[5] += m_z
    friction[0] += g_x
    friction[1] += g_y
    friction[2] += g_z
    friction[3] += l_x
    friction[4] += l_y
    friction[5] += l_z
