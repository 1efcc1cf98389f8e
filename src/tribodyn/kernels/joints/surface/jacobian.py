"""Wrench of a surface of patches with its derivatives in the same pass.

With N = (n, x × n), Ŝ = (ŝ, x × ŝ), ŝ = s/q, q = √(s² + u_s²), and X = (1, −[x]×), so that x moves with X (v,
ω):

    ∂normal/∂(d, φ) = Σ A ∂P/∂h N Nᵀ,        ∂normal/∂(v, φ̇) = −Σ A ∂P/∂δ̇ N Nᵀ,
    ∂friction/∂(d, φ) = μ Σ A ∂P/∂h Ŝ Nᵀ,    ∂friction/∂(v, φ̇) = −μ Σ A ∂P/∂δ̇ Ŝ Nᵀ,
    ∂friction/∂(v, ω) = −Σ A (μ P/q) (Xᵀ X − N Nᵀ − Ŝ Ŝᵀ).
"""

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.columns import AREA, PITCH, RESISTANCE, STIFFNESS, whole
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
from tribodyn.kernels.joints.surface.wrench import add_columns, fill_forces, slip_square
from tribodyn.kernels.lanes import WIDTH, load, total, zeros


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
