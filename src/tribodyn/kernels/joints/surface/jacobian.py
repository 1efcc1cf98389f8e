"""Wrench of a surface of patches: sums over nodes within reach, alone and with derivatives in the same pass.

With N = (n, x × n), Ŝ = (ŝ, x × ŝ), ŝ = s/q, q = √(s² + u_s²), and X = (1, −[x]×), so that x moves with X (v,
ω):

    ∂normal/∂(d, φ) = Σ A ∂P/∂h N Nᵀ,        ∂normal/∂(v, φ̇) = −Σ A ∂P/∂δ̇ N Nᵀ,
    ∂friction/∂(d, φ) = μ Σ A ∂P/∂h Ŝ Nᵀ,    ∂friction/∂(v, φ̇) = −μ Σ A ∂P/∂δ̇ Ŝ Nᵀ,
    ∂friction/∂(v, ω) = −Σ A (μ P/q) (Xᵀ X − N Nᵀ − Ŝ Ŝᵀ).
"""

import math
from typing import Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import clear, inlined, kernel
from tribodyn.kernels.joints.columns import AREA, PITCH, PRESSURE, RESISTANCE, STIFFNESS, whole
from tribodyn.kernels.joints.pressure import fill_pressures, fill_slopes
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.listed import (
    FORCE,
    NORMAL,
    POSITION,
    PRODUCT,
    SLIP,
    SLIP_SQUARE,
    TRACTION,
)
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


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch."""
    scratch = memory.scratch
    work, cubics, mu = scratch.listed.work, table_of(data, surface).cubics, surface.friction_coefficient
    v_min, clip, most = surface.minimum_entry_velocity, surface.tensile_clip, surface.hardness
    scale = surface.inverse_step / surface.roughness
    clear_sums(scratch)
    rewind(surface, memory)
    n = gather(data, surface, memory, station)
    while n > 0:
        fill_pressures(cubics, v_min, clip, most, work, n)
        fill_slopes(cubics, scale, v_min, clip, most, work, n)
        fill_forces(surface, work, station, n)
        _fill_weights(mu, slip_square(surface), work, n)
        add_columns(work, FORCE, NORMAL, n, -1.0, scratch.normal)
        _add_outer(work, STIFFNESS, NORMAL, NORMAL, n, 1.0, scratch.normal_place)
        _add_outer(work, RESISTANCE, NORMAL, NORMAL, n, -1.0, scratch.normal_rate)
        if mu > 0.0:
            add_columns(work, FORCE, SLIP, n, -mu, scratch.friction)
            _add_outer(work, STIFFNESS, SLIP, NORMAL, n, mu, scratch.friction_place)
            _add_outer(work, RESISTANCE, SLIP, NORMAL, n, -mu, scratch.friction_rate)
            _add_outer(work, TRACTION, NORMAL, NORMAL, n, 1.0, scratch.friction_slip)
            _add_outer(work, TRACTION, SLIP, SLIP, n, 1.0, scratch.friction_slip)
            _add_motion(work, n, scratch.friction_slip)
        n = gather(data, surface, memory, station)


@kernel
def clear_sums(scratch: Record) -> None:
    """Set the wrench and its derivatives to zero."""
    for k in range(6):
        scratch.normal[k] = scratch.friction[k] = 0.0
    clear(scratch.normal_place)
    clear(scratch.normal_rate)
    clear(scratch.friction_place)
    clear(scratch.friction_rate)
    clear(scratch.friction_slip)


@kernel
def _fill_weights(mu: float, square: float, work: FloatArray, n: int) -> None:
    """Multiply slopes of the ``n`` nodes in the list by their areas and fill ``TRACTION``."""
    for k in range(whole(n)):
        area = work[AREA + k]
        work[STIFFNESS + k] *= area
        work[RESISTANCE + k] *= area
        work[TRACTION + k] = mu * work[FORCE + k] / math.sqrt(work[SLIP_SQUARE + k] + square)


@kernel
def _add_outer(
    work: FloatArray, weight: int, left: int, right: int, n: int, factor: float, out: FloatArray
) -> None:
    """Add ``factor`` Σ w l rᵀ over six columns each from ``left`` and ``right`` on to ``out`` (6, 6)."""
    for i in range(6):
        for k in range(whole(n)):
            work[PRODUCT + k] = work[weight + k] * work[left + i * PITCH + k]
        add_columns(work, PRODUCT, right, n, factor, out[i])


@kernel
def _add_motion(work: FloatArray, n: int, out: FloatArray) -> None:
    """Subtract Σ w Xᵀ X = Σ w (1, −[x]×; [x]×, x² 1 − x xᵀ) with the weights ``TRACTION``."""
    sum_w, sum_x, sum_y, sum_z = zeros(), zeros(), zeros(), zeros()
    sum_xx, sum_yy, sum_zz, sum_xy, sum_xz, sum_yz = zeros(), zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        weight, x = load(work, TRACTION + k), load(work, POSITION + k)
        y, z = load(work, POSITION + PITCH + k), load(work, POSITION + 2 * PITCH + k)
        along_x, along_y, along_z = weight * x, weight * y, weight * z
        sum_w += weight
        sum_x += along_x
        sum_y += along_y
        sum_z += along_z
        sum_xx += along_x * x
        sum_yy += along_y * y
        sum_zz += along_z * z
        sum_xy += along_x * y
        sum_xz += along_x * z
        sum_yz += along_y * z
    w, w_x, w_y, w_z = total(sum_w), total(sum_x), total(sum_y), total(sum_z)
    xx, yy, zz = total(sum_xx), total(sum_yy), total(sum_zz)
    xy, xz, yz = total(sum_xy), total(sum_xz), total(sum_yz)
    arm = ((0.0, -w_z, w_y), (w_z, 0.0, -w_x), (-w_y, w_x, 0.0))
    inertia = ((yy + zz, -xy, -xz), (-xy, xx + zz, -yz), (-xz, -yz, xx + yy))
    for i in range(3):
        out[i, i] -= w
        for k in range(3):
            out[3 + i, k] -= arm[i][k]
            out[i, 3 + k] += arm[i][k]
            out[3 + i, 3 + k] -= inertia[i][k]
