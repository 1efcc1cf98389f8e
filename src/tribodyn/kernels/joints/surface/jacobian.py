"""Wrench of a surface of patches with its derivatives in the same pass.

With N = (n, x × n), Ŝ = (ŝ, x × ŝ), ŝ = s/q, q = √(s² + u_s²), and X = (1, −[x]×), so that x moves with X (v,
ω):

    ∂normal/∂(d, φ) = Σ A ∂P/∂h N Nᵀ,        ∂normal/∂(v, φ̇) = −Σ A ∂P/∂δ̇ N Nᵀ,
    ∂friction/∂(d, φ) = μ Σ A ∂P/∂h Ŝ Nᵀ,    ∂friction/∂(v, φ̇) = −μ Σ A ∂P/∂δ̇ Ŝ Nᵀ,
    ∂friction/∂(v, ω) = −Σ A (μ P/q) (Xᵀ X − N Nᵀ − Ŝ Ŝᵀ).

For a tilted cylinder N = (n, −∂h/∂φ), see ``tilt``. It exceeds (n, x × n) by e = ρ (n·l) c, c = (0, ẑ × n),
and depends on the tilt by ρ c cᵀ. This adds

    ∂normal/∂φ −= Σ A (P c + ∂P/∂δ̇ (n·l̇) N) ρ cᵀ,    ∂friction/∂φ −= μ Σ A ∂P/∂δ̇ (n·l̇) Ŝ ρ cᵀ,

and ∂friction/∂(v, ω) has N − e in the place of N.
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
from tribodyn.kernels.lanes import WIDTH, load, spread, total, zeros


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch; arguments as for ``wrench``."""
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
        if surface.lean != 0.0:
            add_lean(surface, scratch, n)
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


@kernel
def add_lean(surface: Record, scratch: Record, n: int) -> None:
    """Add the second-order terms of the ``n`` nodes in the list to the derivatives."""
    work, phi, rate = scratch.listed.work, scratch.tilt.phi, scratch.tilt.rate
    mu, radius = surface.friction_coefficient, surface.lean
    xx, xy, yy = _squares(work, FORCE, 1.0, 0.0, 0.0, n)
    _add_block(-radius, xx, xy, yy, scratch.normal_place)
    for i in range(6):
        _add_pair(work, RESISTANCE, NORMAL, i, rate, -radius, n, scratch.normal_place)
    if mu > 0.0:
        for i in range(6):
            _add_pair(work, RESISTANCE, SLIP, i, rate, -mu * radius, n, scratch.friction_place)
            x, y = _sums(work, TRACTION, NORMAL + i * PITCH, phi[0], phi[1], n)
            _add_both(-radius * x, i, 3, scratch.friction_slip)
            _add_both(-radius * y, i, 4, scratch.friction_slip)
        xx, xy, yy = _squares(work, TRACTION, 0.0, phi[0], phi[1], n)
        _add_block(radius * radius, xx, xy, yy, scratch.friction_slip)


@kernel
def _add_pair(
    work: FloatArray, weight: int, left: int, i: int, v: FloatArray, factor: float, n: int, out: FloatArray
) -> None:
    """Add ``factor`` Σ w l (n·v × ẑ) ẑ × n to the entries for tilts of a row of ``out`` (6, 6)."""
    x, y = _sums(work, weight, left + i * PITCH, v[0], v[1], n)
    out[i, 3] += factor * x
    out[i, 4] += factor * y


@kernel
def _add_both(value: float, i: int, k: int, out: FloatArray) -> None:
    """Add ``value`` to an entry of ``out`` and to the one across the diagonal."""
    out[i, k] += value
    out[k, i] += value


@kernel
def _add_block(factor: float, xx: float, xy: float, yy: float, out: FloatArray) -> None:
    """Add a symmetric matrix to the entries of ``out`` (6, 6) for moments and tilts."""
    out[3, 3] += factor * xx
    out[3, 4] += factor * xy
    out[4, 3] += factor * xy
    out[4, 4] += factor * yy


@kernel
def _sums(work: FloatArray, weight: int, left: int, v_x: float, v_y: float, n: int) -> tuple[float, float]:
    """Return Σ w l (n·v × ẑ) (−n_y, n_x) over a column ``left``."""
    x, y, along_x, along_y = zeros(), zeros(), spread(v_x), spread(v_y)
    for k in range(0, n, WIDTH):
        n_x, n_y = load(work, NORMAL + k), load(work, NORMAL + PITCH + k)
        w = load(work, weight + k) * load(work, left + k) * (n_x * along_y - n_y * along_x)
        x -= w * n_y
        y += w * n_x
    return total(x), total(y)


@kernel
def _squares(
    work: FloatArray, weight: int, steady: float, v_x: float, v_y: float, n: int
) -> tuple[float, float, float]:
    """Return Σ w (steady + n·v × ẑ)² (n_y², −n_x n_y, n_x²)."""
    xx, xy, yy = zeros(), zeros(), zeros()
    constant, along_x, along_y = spread(steady), spread(v_x), spread(v_y)
    for k in range(0, n, WIDTH):
        n_x, n_y = load(work, NORMAL + k), load(work, NORMAL + PITCH + k)
        leaning = constant + n_x * along_y - n_y * along_x
        w = load(work, weight + k) * leaning * leaning
        xx += w * n_y * n_y
        xy -= w * n_x * n_y
        yy += w * n_x * n_x
    return total(xx), total(xy), total(yy)
