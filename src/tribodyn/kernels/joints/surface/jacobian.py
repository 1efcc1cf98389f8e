"""Wrench of a surface with its derivatives in the same pass.

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

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.columns import AREA, PITCH, RESISTANCE, STIFFNESS, whole
from tribodyn.kernels.joints.pressures import fill_pressures, fill_slopes
from tribodyn.kernels.joints.surface.data import SurfaceData, is_ring, table_of
from tribodyn.kernels.joints.surface.lean import add_lean
from tribodyn.kernels.joints.surface.listed import FORCE, NORMAL, POSITION, SLIP, SLIP_SQUARE, TRACTION
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, rewind
from tribodyn.kernels.joints.surface.wrench import add_columns, fill_forces, slip_square
from tribodyn.kernels.lanes import WIDTH, load, total, zeros


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch; arguments as for ``wrench``."""
    scratch = memory.scratch
    work, cubics, mu = scratch.listed.work, table_of(data, surface).cubics, surface.friction_coefficient
    v_min, clip = surface.minimum_entry_velocity, surface.tensile_clip
    scale = surface.inverse_step / surface.roughness
    twists = 0.0 if is_ring(data, surface) else 1.0  # x × n has no part along Z on a ring
    clear_sums(scratch)
    rewind(surface, memory)
    n = gather(data, surface, memory, station, 0.0)
    while n > 0:
        fill_pressures(cubics, v_min, clip, work, n)
        fill_slopes(cubics, scale, v_min, clip, work, n)
        fill_forces(surface, work, station, n)
        turns = surface.torque_radius > 0.0
        if turns:
            _fill_torque(surface.torque_radius * station.direction, work, n)
        _fill_weights(0.0 if turns else mu, slip_square(surface), work, n)
        add_columns(work, FORCE, NORMAL, n, -1.0, scratch.normal)
        _add_square(work, STIFFNESS, NORMAL, n, 1.0, twists, scratch.normal_place)
        _add_square(work, RESISTANCE, NORMAL, n, -1.0, twists, scratch.normal_rate)
        if surface.lean != 0.0:
            add_lean(surface, scratch, n)
        if mu > 0.0:
            add_columns(work, FORCE, SLIP, n, -mu, scratch.friction)
            _add_outer(work, STIFFNESS, SLIP, NORMAL, n, mu, twists, scratch.friction_place)
            _add_outer(work, RESISTANCE, SLIP, NORMAL, n, -mu, twists, scratch.friction_rate)
            _add_square(work, TRACTION, NORMAL, n, 1.0, twists, scratch.friction_slip)
            _add_square(work, TRACTION, SLIP, n, 1.0, 1.0, scratch.friction_slip)
            _add_motion(work, n, surface.along, scratch.friction_slip)
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
def _fill_weights(mu: float, square: float, work: FloatArray, n: int) -> None:
    """Multiply slopes of the ``n`` nodes in the list by their areas and fill ``TRACTION``."""
    for k in range(whole(n)):
        area = work[AREA + k]
        work[STIFFNESS + k] *= area
        work[RESISTANCE + k] *= area
        work[TRACTION + k] = mu * work[FORCE + k] / math.sqrt(work[SLIP_SQUARE + k] + square)


@kernel
def _fill_torque(arm: float, work: FloatArray, n: int) -> None:
    """Replace Ŝ of the ``n`` nodes in the list by a torque about the axis of a given arm [m]."""
    for k in range(whole(n)):
        for column in range(5):
            work[SLIP + column * PITCH + k] = 0.0
        work[SLIP + 5 * PITCH + k] = arm


@kernel
def _add_outer(
    work: FloatArray,
    weight: int,
    left: int,
    right: int,
    n: int,
    factor: float,
    twists: float,
    out: FloatArray,
) -> None:
    """Add ``factor`` Σ w l rᵀ over six columns each from ``left`` and ``right`` on to ``out`` (6, 6).

    The last column from ``right`` on is left out where ``twists`` is 0.
    """
    for i in range(6):
        a, b, c, d, e = zeros(), zeros(), zeros(), zeros(), zeros()
        for k in range(0, n, WIDTH):
            w = load(work, weight + k) * load(work, left + i * PITCH + k)
            a += w * load(work, right + k)
            b += w * load(work, right + PITCH + k)
            c += w * load(work, right + 2 * PITCH + k)
            d += w * load(work, right + 3 * PITCH + k)
            e += w * load(work, right + 4 * PITCH + k)
        sums = (total(a), total(b), total(c), total(d), total(e))
        for k in range(5):
            out[i, k] += factor * sums[k]
    if twists > 0.0:
        last = _last_column(work, weight, left, right, n)
        for i in range(6):
            out[i, 5] += factor * last[i]


@kernel
def _add_square(
    work: FloatArray, weight: int, column: int, n: int, factor: float, twists: float, out: FloatArray
) -> None:
    """Add ``factor`` Σ w l lᵀ over six columns from ``column`` on, or five, as ``_add_outer`` does."""
    second, third, fourth, fifth = column + PITCH, column + 2 * PITCH, column + 3 * PITCH, column + 4 * PITCH
    a, b, c, d, e = zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        x = load(work, column + k)
        w = load(work, weight + k) * x
        a += w * x
        b += w * load(work, second + k)
        c += w * load(work, third + k)
        d += w * load(work, fourth + k)
        e += w * load(work, fifth + k)
    f, g, h, i, j = zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        w, x, last = load(work, weight + k), load(work, second + k), load(work, fifth + k)
        w_x = w * x
        f += w_x * x
        g += w_x * load(work, third + k)
        h += w_x * load(work, fourth + k)
        i += w_x * last
        j += (w * last) * last
    p, q, r, s, t = zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        w, x, y = load(work, weight + k), load(work, third + k), load(work, fourth + k)
        last = load(work, fifth + k)
        w_x, w_y = w * x, w * y
        p += w_x * x
        q += w_x * y
        r += w_x * last
        s += w_y * y
        t += w_y * last
    _add_row(factor, 0, (total(a), total(b), total(c), total(d), total(e)), out)
    _add_row(factor, 1, (total(f), total(g), total(h), total(i)), out)
    _add_row(factor, 2, (total(p), total(q), total(r)), out)
    _add_row(factor, 3, (total(s), total(t)), out)
    out[4, 4] += factor * total(j)
    if twists > 0.0:
        sums = _last_column(work, weight, column, column, n)
        for m in range(5):
            out[m, 5] += factor * sums[m]
            out[5, m] += factor * sums[m]
        out[5, 5] += factor * sums[5]


@inlined
def _add_row(factor: float, i: int, sums: tuple[float, ...], out: FloatArray) -> None:
    """Add the entries of row ``i`` from the diagonal on, and those of the column."""
    out[i, i] += factor * sums[0]
    for k in range(1, len(sums)):
        out[i, i + k] += factor * sums[k]
        out[i + k, i] += factor * sums[k]


@kernel
def _last_column(
    work: FloatArray, weight: int, left: int, right: int, n: int
) -> tuple[float, float, float, float, float, float]:
    """Return Σ w l r of six columns from ``left`` on and the sixth from ``right`` on."""
    a, b, c, d, e, f = zeros(), zeros(), zeros(), zeros(), zeros(), zeros()
    for k in range(0, n, WIDTH):
        w = load(work, weight + k) * load(work, right + 5 * PITCH + k)
        a += w * load(work, left + k)
        b += w * load(work, left + PITCH + k)
        c += w * load(work, left + 2 * PITCH + k)
        d += w * load(work, left + 3 * PITCH + k)
        e += w * load(work, left + 4 * PITCH + k)
        f += w * load(work, left + 5 * PITCH + k)
    return total(a), total(b), total(c), total(d), total(e), total(f)


@kernel
def _add_motion(work: FloatArray, n: int, along: float, out: FloatArray) -> None:
    """Subtract Σ w Xᵀ X = Σ w (1, −[x]×; [x]×, x² 1 − x xᵀ) with the weights ``TRACTION``.

    Without friction ``along`` a cylinder, the motion along its axis, (ẑ, x × ẑ)·(v, ω), is left out.
    """
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
    if along == 0.0:
        left_out = ((w, w_y, -w_x), (w_y, yy, -xy), (-w_x, -xy, xx))
        for i in range(3):
            for k in range(3):
                out[2 + i, 2 + k] += left_out[i][k]
