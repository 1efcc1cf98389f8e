"""Wrench of a surface on the shaft: sums over the nodes within reach."""

import math
from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.columns import AREA, PITCH, PRESSURE, whole
from tribodyn.kernels.joints.pressure import fill_pressures
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.listed import FORCE, NORMAL, POSITION, SLIP, SLIP_SQUARE
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, rewind
from tribodyn.kernels.lanes import WIDTH, load, total, zeros

LEAST_SQUARE: Final = 1.0e-300  #: Least squared slip velocity, in the place of zero.


@inlined
def slip_square(surface: Record) -> float:
    """Return u_s² [m²/s²]."""
    return max(surface.slip_velocity * surface.slip_velocity, LEAST_SQUARE)


@kernel
def wrench(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record) -> None:
    """Fill ``normal`` and ``friction`` of the scratch, whose tilt is that of the shaft."""
    normal, friction = memory.scratch.normal, memory.scratch.friction
    for k in range(6):
        normal[k] = friction[k] = 0.0
    work, cubics = memory.scratch.listed.work, table_of(data, surface).cubics
    v_min, clip, mu = surface.minimum_entry_velocity, surface.tensile_clip, surface.friction_coefficient
    most = surface.hardness
    rewind(surface, memory)
    n = gather(data, surface, memory, station)
    while n > 0:
        fill_pressures(cubics, v_min, clip, most, work, n)
        fill_forces(surface, work, station, n)
        add_columns(work, FORCE, NORMAL, n, -1.0, normal)
        add_columns(work, FORCE, SLIP, n, -mu, friction)
        n = gather(data, surface, memory, station)


@kernel
def fill_forces(surface: Record, work: FloatArray, station: Record, n: int) -> None:
    """Fill forces and slips of the ``n`` nodes in the list, whose pressures are filled."""
    square = slip_square(surface)
    v_x, v_y, v_z = station.slip[0], station.slip[1], station.slip[2]
    w_x, w_y, w_z = station.w[0], station.w[1], station.w[2]
    for k in range(whole(n)):
        x, y, z = work[POSITION + k], work[POSITION + PITCH + k], work[POSITION + 2 * PITCH + k]
        n_x, n_y, n_z = work[NORMAL + k], work[NORMAL + PITCH + k], work[NORMAL + 2 * PITCH + k]
        s_x, s_y, s_z = v_x + w_y * z - w_z * y, v_y + w_z * x - w_x * z, v_z + w_x * y - w_y * x
        along = n_x * s_x + n_y * s_y + n_z * s_z
        s_x, s_y, s_z = s_x - along * n_x, s_y - along * n_y, s_z - along * n_z
        slip_2 = s_x * s_x + s_y * s_y + s_z * s_z
        per_speed = 1.0 / math.sqrt(slip_2 + square)
        s_x, s_y, s_z = per_speed * s_x, per_speed * s_y, per_speed * s_z
        work[SLIP + k] = s_x
        work[SLIP + PITCH + k] = s_y
        work[SLIP + 2 * PITCH + k] = s_z
        work[SLIP + 3 * PITCH + k] = y * s_z - z * s_y
        work[SLIP + 4 * PITCH + k] = z * s_x - x * s_z
        work[SLIP + 5 * PITCH + k] = x * s_y - y * s_x
        work[SLIP_SQUARE + k] = slip_2
        work[FORCE + k] = work[AREA + k] * work[PRESSURE + k]


@kernel
def add_columns(work: FloatArray, weight: int, first: int, n: int, factor: float, out: FloatArray) -> None:
    """Add ``factor`` Σ w c over six columns from ``first`` on to ``out`` (6,)."""
    a, b, c, d, e, f = zeros(), zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        w = load(work, weight + k)
        a += w * load(work, first + k)
        b += w * load(work, first + PITCH + k)
        c += w * load(work, first + 2 * PITCH + k)
        d += w * load(work, first + 3 * PITCH + k)
        e += w * load(work, first + 4 * PITCH + k)
        f += w * load(work, first + 5 * PITCH + k)
    sums = (total(a), total(b), total(c), total(d), total(e), total(f))
    for i in range(6):
        out[i] += factor * sums[i]
