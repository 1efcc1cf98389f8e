"""Wrench of a surface with its derivatives in the same pass.

With N = (n, x × n), Ŝ = (ŝ, x × ŝ), ŝ = s/q, q = √(s² + u_s²), and X = (1, −[x]×), so that x moves with X (v,
ω):

    ∂normal/∂(d, φ) = Σ A ∂P/∂h N Nᵀ,        ∂normal/∂(v, φ̇) = −Σ A ∂P/∂δ̇ N Nᵀ,
    ∂friction/∂(d, φ) = μ Σ A ∂P/∂h Ŝ Nᵀ,    ∂friction/∂(v, φ̇) = −μ Σ A ∂P/∂δ̇ Ŝ Nᵀ,
    ∂friction/∂(v, ω) = −Σ A (μ P/q) (Xᵀ X − N Nᵀ − Ŝ Ŝᵀ).
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import kernel, summing
from tribodyn.kernels.joints.pressure import reference_velocity, total_pressure
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.listed import (
    APPROACH,
    AREA,
    DAMPING,
    DAMPING_SLOPE,
    ENTRY,
    NORMAL,
    PART,
    PITCH,
    POSITION,
    RESISTANCE,
    RIGID,
    RIGID_SLOPE,
    SLIP,
    STIFFNESS,
    TRACTION,
)
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, look_up, look_up_slopes, rewind
from tribodyn.kernels.joints.surface.wrench import slip_square


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch; arguments as for ``wrench``."""
    scratch = memory.scratch
    work, cubics, mu = scratch.listed.work, table_of(data, surface).cubics, surface.friction_coefficient
    clear_sums(scratch)
    rewind(surface, memory)
    n = gather(data, surface, memory, station, 0.0)
    while n > 0:
        look_up(cubics, work, n)
        look_up_slopes(cubics, work, n)
        _fill_columns(surface, work, station, n)
        _add_columns(work, NORMAL, n, -1.0, scratch.normal)
        _add_outer(work, STIFFNESS, NORMAL, NORMAL, n, 1.0, scratch.normal_place)
        _add_outer(work, RESISTANCE, NORMAL, NORMAL, n, -1.0, scratch.normal_rate)
        if mu > 0.0:
            _add_columns(work, SLIP, n, -mu, scratch.friction)
            _add_outer(work, STIFFNESS, SLIP, NORMAL, n, mu, scratch.friction_place)
            _add_outer(work, RESISTANCE, SLIP, NORMAL, n, -mu, scratch.friction_rate)
            _add_outer(work, TRACTION, NORMAL, NORMAL, n, 1.0, scratch.friction_slip)
            _add_outer(work, TRACTION, SLIP, SLIP, n, 1.0, scratch.friction_slip)
            _add_motion(work, n, scratch.friction_slip)
        n = gather(data, surface, memory, station, 0.0)


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
def _fill_columns(surface: Record, work: FloatArray, station: Record, n: int) -> None:
    """Fill slips and weights of the ``n`` nodes in the list; ``AREA`` becomes the force A P."""
    v_min, clip, mu = surface.minimum_entry_velocity, surface.tensile_clip, surface.friction_coefficient
    square, slope = slip_square(surface), surface.inverse_step / surface.roughness
    v_x, v_y, v_z = station.slip[0], station.slip[1], station.slip[2]
    w_x, w_y, w_z = station.w[0], station.w[1], station.w[2]
    for k in range(min(n, PART)):
        approach, entry = work[APPROACH + k], work[ENTRY + k]
        reference = reference_velocity(entry, approach, v_min)
        ratio, damping = approach / reference, work[DAMPING + k]
        p = total_pressure(work[RIGID + k], damping, ratio, clip)
        whole = 0.0 if clip > 0.0 and p == 0.0 else work[AREA + k]
        # Without memory and faster than the least velocity, the ratio is ±1 whatever the speed.
        follows = 1.0 if entry > 0.0 or abs(approach) < v_min else 0.0
        d_gap = slope * (work[RIGID_SLOPE + k] + ratio * work[DAMPING_SLOPE + k])
        x, y, z = work[POSITION + k], work[POSITION + PITCH + k], work[POSITION + 2 * PITCH + k]
        n_x, n_y, n_z = work[NORMAL + k], work[NORMAL + PITCH + k], work[NORMAL + 2 * PITCH + k]
        s_x, s_y, s_z = v_x + w_y * z - w_z * y, v_y + w_z * x - w_x * z, v_z + w_x * y - w_y * x
        along = n_x * s_x + n_y * s_y + n_z * s_z
        s_x, s_y, s_z = s_x - along * n_x, s_y - along * n_y, s_z - along * n_z
        per_speed = 1.0 / math.sqrt(s_x * s_x + s_y * s_y + s_z * s_z + square)
        s_x, s_y, s_z = per_speed * s_x, per_speed * s_y, per_speed * s_z
        work[SLIP + k] = s_x
        work[SLIP + PITCH + k] = s_y
        work[SLIP + 2 * PITCH + k] = s_z
        work[SLIP + 3 * PITCH + k] = y * s_z - z * s_y
        work[SLIP + 4 * PITCH + k] = z * s_x - x * s_z
        work[SLIP + 5 * PITCH + k] = x * s_y - y * s_x
        work[STIFFNESS + k] = whole * d_gap
        work[RESISTANCE + k] = whole * follows * damping / reference
        work[TRACTION + k] = mu * work[AREA + k] * p * per_speed
        work[AREA + k] *= p


@summing
def _add_columns(work: FloatArray, first: int, n: int, factor: float, out: FloatArray) -> None:
    """Add ``factor`` Σ A P c over six columns from ``first`` on to ``out`` (6,)."""
    for i in range(6):
        total, column = 0.0, first + i * PITCH
        for k in range(min(n, PART)):
            total += work[AREA + k] * work[column + k]
        out[i] += factor * total


@summing
def _add_outer(
    work: FloatArray, weight: int, left: int, right: int, n: int, factor: float, out: FloatArray
) -> None:
    """Add ``factor`` Σ w l rᵀ over six columns each from ``left`` and ``right`` on to ``out`` (6, 6)."""
    for i in range(6):
        column = left + i * PITCH
        a = b = c = d = e = f = 0.0
        for k in range(min(n, PART)):
            w = work[weight + k] * work[column + k]
            a += w * work[right + k]
            b += w * work[right + PITCH + k]
            c += w * work[right + 2 * PITCH + k]
            d += w * work[right + 3 * PITCH + k]
            e += w * work[right + 4 * PITCH + k]
            f += w * work[right + 5 * PITCH + k]
        out[i, 0] += factor * a
        out[i, 1] += factor * b
        out[i, 2] += factor * c
        out[i, 3] += factor * d
        out[i, 4] += factor * e
        out[i, 5] += factor * f


@summing
def _add_motion(work: FloatArray, n: int, out: FloatArray) -> None:
    """Subtract Σ w Xᵀ X = Σ w (1, −[x]×; [x]×, x² 1 − x xᵀ) with the weights ``TRACTION``."""
    w = w_x = w_y = w_z = xx = yy = zz = xy = xz = yz = 0.0
    for k in range(min(n, PART)):
        weight = work[TRACTION + k]
        x, y, z = work[POSITION + k], work[POSITION + PITCH + k], work[POSITION + 2 * PITCH + k]
        along_x, along_y, along_z = weight * x, weight * y, weight * z
        w += weight
        w_x += along_x
        w_y += along_y
        w_z += along_z
        xx += along_x * x
        yy += along_y * y
        zz += along_z * z
        xy += along_x * y
        xz += along_x * z
        yz += along_y * z
    arm = ((0.0, -w_z, w_y), (w_z, 0.0, -w_x), (-w_y, w_x, 0.0))
    inertia = ((yy + zz, -xy, -xz), (-xy, xx + zz, -yz), (-xz, -yz, xx + yy))
    for i in range(3):
        out[i, i] -= w
        for k in range(3):
            out[3 + i, k] -= arm[i][k]
            out[i, 3 + k] += arm[i][k]
            out[3 + i, 3 + k] -= inertia[i][k]
