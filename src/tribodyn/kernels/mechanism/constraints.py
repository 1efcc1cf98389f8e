"""Constraint rows of a coupling: what is to vanish, over the motion of its shaft in its socket.

Two primitives make every joint. A *point* row is a coordinate of the shaft's origin, less what it follows,

    Φ = d_i − s(t),   Φ̈ = ẍ_i − s̈;

a *direction* row is the product of a direction W of the socket with an axis f of the shaft,

    Φ = W·f,   Φ̇ = (f × W)·ω + Ẇ·f,   Φ̈ = (f × W)·ω̇ + W·(ω × (ω × f)) + 2 Ẇ·(ω × f) + Ẅ·f.

W is an axis of the socket, or, where the angle s(t) of the shaft is given, the direction at right angles to
where its x axis is to be, W = (−sin s, cos s, 0).

A *coordinate* row is the equation of an element, such as a gear pair: over its legs,

    Φ = Σ (b·d + a θ) − c,   Φ̇ = Σ (b·v + a g·ω),   Φ̈ = Σ (b·v̇ + a (g·ω̇ + ġ·ω)),

with the angle θ of the shaft and its gradient g; see ``kernels/mechanism/angle.py``.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.angle import angle_gradient, angle_hessian, angle_rate
from tribodyn.kernels.mechanism.data import ANGLE, COORDINATE, NONE, POINT, POSITION
from tribodyn.kernels.mechanism.vectors import cross, multiply
from tribodyn.kernels.signals import Signals, evaluate


@kernel
def prescribe(coupling: Record, now: Record, signals: Signals, t: float, within: float) -> None:
    """Fill what the rows follow at a time."""
    for m in range(coupling.n_terms):
        number = coupling.row_signal[m]
        value, rate, second = 0.0, 0.0, 0.0
        if number != NONE:
            value, rate, second = evaluate(signals, number, t, within)
        now.prescribed[m, 0], now.prescribed[m, 1], now.prescribed[m, 2] = value, rate, second


@kernel
def _direction(
    coupling: Record, now: Record, m: int, w: FloatArray, rate: FloatArray, second: FloatArray
) -> None:
    """Fill W and its two derivatives in time."""
    for i in range(3):
        w[i] = rate[i] = second[i] = 0.0
    if coupling.row_kind[m] != ANGLE:
        w[coupling.row_axis[m]] = 1.0
        return
    angle, speed, acceleration = now.prescribed[m, 0], now.prescribed[m, 1], now.prescribed[m, 2]
    w[0], w[1] = -math.sin(angle), math.cos(angle)
    rate[0], rate[1] = -speed * w[1], speed * w[0]
    second[0], second[1] = (
        -acceleration * w[1] - speed * speed * w[0],
        acceleration * w[0] - speed * speed * w[1],
    )


@kernel
def fill_rows(coupling: Record, now: Record) -> None:
    """Fill residual, rate and wanted acceleration of all rows, N and G; of a leg, its terms of them."""
    work, twist = now.work, now.twist
    w, w_rate, w_second = work[0, :3], work[1, :3], work[2, :3]
    f, swing, twice, arm = work[3, :3], work[4, :3], work[5, :3], work[0, 3:6]
    for m in range(6):
        for i in range(6):
            now.N[m, i] = 0.0
    for m in range(coupling.n_terms):
        kind, i = coupling.row_kind[m], coupling.row_axis[m]
        if kind in (POINT, POSITION):
            now.N[m, i] = 1.0
            now.residual[m] = now.pose.d[i] - now.prescribed[m, 0]
            now.rate[m] = twist[i] - now.prescribed[m, 1]
            now.gamma[m] = now.prescribed[m, 2] - now.bias[i]
            continue
        if kind == COORDINATE:
            _fill_term(coupling, now)
            continue
        _direction(coupling, now, m, w, w_rate, w_second)
        for k in range(3):
            f[k] = now.pose.rotation[k, coupling.row_other[m]]
        cross(f, w, arm)
        cross(now.pose.w, f, swing)
        cross(now.pose.w, swing, twice)
        residual = rate = acceleration = 0.0
        for k in range(3):
            now.N[m, 3 + k] = arm[k]
            residual += w[k] * f[k]
            rate += arm[k] * now.pose.w[k] + w_rate[k] * f[k]
            acceleration += arm[k] * now.bias[3 + k] + w[k] * twice[k]
            acceleration += 2.0 * w_rate[k] * swing[k] + w_second[k] * f[k]
        now.residual[m], now.rate[m], now.gamma[m] = residual, rate, -acceleration
    multiply(now.N, now.H, now.G)


@kernel
def _fill_term(coupling: Record, now: Record) -> None:
    """Fill what a leg adds to the equation of its element."""
    q, w, row = now.pose.rotation[:, 0], now.pose.w, now.N[0]
    angle_gradient(q, row[3:6])
    residual, rate = coupling.about * now.angle - now.offset, 0.0
    acceleration = coupling.about * angle_rate(q, w)
    for i in range(3):
        row[i] = coupling.along[i]
        row[3 + i] *= coupling.about
        residual += row[i] * now.pose.d[i]
    for i in range(6):
        rate += row[i] * now.twist[i]
        acceleration += row[i] * now.bias[i]
    now.residual[0], now.rate[0], now.gamma[0] = residual, rate, -acceleration


@kernel
def _term_gradient(coupling: Record, now: Record, rate: FloatArray) -> None:
    """Add what turning does to the term of a leg, and to its moment."""
    q, turned, turning, of_gradient = now.pose.rotation[:, 0], now.work[0, :3], now.work[1, :3], now.small
    angle_hessian(q, now.pose.w, rate[3:6], turned, turning, of_gradient)
    for k in range(3):
        for j in range(12):
            way, spin = coupling.about * now.H[3 + k, j], coupling.about * turning[k]
            now.Gq[0, j] += turned[k] * way + spin * now.Vq[3 + k, j]
            now.Gv[0, j] += turning[k] * way
        for j in range(3):
            now.slope[3 + k, 3 + j] += now.multiplier[0] * coupling.about * of_gradient[k, j]


@kernel
def row_gradient(coupling: Record, now: Record, rate: FloatArray) -> None:
    """Fill Gq and Gv, and add what turning does to the constraint moments to ``now.slope``.

    ``rate`` (6,) is the rate of the twist with the accelerations of the bodies.
    """
    multiply(now.N, now.Aq, now.Gq)
    multiply(now.N, now.Av, now.Gv)
    work = now.work
    w, w_rate, w_second = work[0, :3], work[1, :3], work[2, :3]
    f, a, b, c = work[3, :3], work[4, :3], work[5, :3], work[0, 3:6]
    turned, turning = work[1, 3:6], work[2, 3:6]
    for m in range(coupling.n_terms):
        if coupling.row_kind[m] in (POINT, POSITION):
            continue
        if coupling.row_kind[m] == COORDINATE:
            _term_gradient(coupling, now, rate)
            continue
        _direction(coupling, now, m, w, w_rate, w_second)
        for k in range(3):
            f[k] = now.pose.rotation[k, coupling.row_other[m]]
        # In f: W × ω̇ + ω × (ω × W) + 2 Ẇ × ω + Ẅ, and δf = ϑ × f.
        cross(now.pose.w, w, a)
        cross(now.pose.w, a, b)
        cross(w_rate, now.pose.w, a)
        for k in range(3):
            b[k] += 2.0 * a[k] + w_second[k]
        cross(w, rate[3:6], a)
        for k in range(3):
            b[k] += a[k]
        cross(f, b, turned)
        # In ω: (ω × f) × W + f × (W × ω) + 2 f × Ẇ.
        cross(now.pose.w, f, a)
        cross(a, w, turning)
        cross(w, now.pose.w, a)
        cross(f, a, b)
        cross(f, w_rate, c)
        for k in range(3):
            turning[k] += b[k] + 2.0 * c[k]
        for j in range(12):
            for k in range(3):
                now.Gq[m, j] += turned[k] * now.H[3 + k, j] + turning[k] * now.Vq[3 + k, j]
                now.Gv[m, j] += turning[k] * now.H[3 + k, j]
        # λ (f × W) with δf = ϑ × f.
        product = w[0] * f[0] + w[1] * f[1] + w[2] * f[2]
        for i in range(3):
            for j in range(3):
                now.slope[3 + i, 3 + j] += now.multiplier[m] * f[i] * w[j]
            now.slope[3 + i, 3 + i] -= now.multiplier[m] * product
