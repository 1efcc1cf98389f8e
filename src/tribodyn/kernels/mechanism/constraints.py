"""Constraint rows of a coupling: what is to vanish, over the motion of its shaft in its socket.

Two primitives make every joint. A *point* row is a coordinate of the shaft's origin, less what it follows,

    Φ = d_i − s(t),   Φ̈ = ẍ_i − s̈;

a *direction* row is the product of a direction W of the socket with an axis f of the shaft,

    Φ = W·f,   Φ̇ = (f × W)·ω + Ẇ·f,   Φ̈ = (f × W)·ω̇ + W·(ω × (ω × f)) + 2 Ẇ·(ω × f) + Ẅ·f.

W is an axis of the socket, or, where the angle s(t) of the shaft is given, the direction at right angles to
where its x axis is to be, W = (−sin s, cos s, 0).

A *coordinate* row is the equation of an element, such as a gear pair: over its legs,

    Φ = Σ (b·d + a θ) − c,   Φ̇ = Σ (b·v + a g·ω),   Φ̈ = Σ (b·v̇ + a (g·ω̇ + ġ·ω)),

with the angle θ of the shaft and its gradient g; see ``kernels/mechanism/relative.py``. A *distance* row
counts the distance between the two origins from a length L, and a *path* row the length of the path of the
origin, of which only the rate matters: with e = d/|d|, or v/|v|,

    Φ = |d| − L,   Φ̇ = e·v,   Φ̈ = e·v̇ + (v² − (e·v)²)/|d|,   or   Φ̇ = |v|.

Of an element with a force law F the equation is λ = F(Φ, Φ̇) instead.
"""

import math

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import cos, sin
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import Signals, evaluate
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.data import ANGLE, COORDINATE, DISTANCE, NONE, PATH, POINT, POSITION
from tribodyn.kernels.mechanism.relative import angle_gradient, angle_hessian, angle_rate, whole_angle
from tribodyn.kernels.mechanism.vectors import cross, multiply


@kernel
def prescribe(coupling: Record, now: Record, signals: Signals, t: float, within: float) -> None:
    """Fill the prescribed values of the rows at a time."""
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
    w[0], w[1] = -sin(angle), cos(angle)
    rate[0], rate[1] = -speed * w[1], speed * w[0]
    second[0], second[1] = (
        -acceleration * w[1] - speed * speed * w[0],
        acceleration * w[0] - speed * speed * w[1],
    )


@kernel
def fill_rows(coupling: Record, now: Record) -> None:
    """Fill residual, N and G of all rows but paths, and their rates at rest; of a leg, its terms of them.

    Entries of N that are zero for a kind of row are never written.
    """
    work = now.work
    w, w_rate, w_second, f, arm = work[0, :3], work[1, :3], work[2, :3], work[3, :3], work[0, 3:6]
    for m in range(coupling.n_terms):
        kind, i = coupling.row_kind[m], coupling.row_axis[m]
        now.at_rest[m] = 0.0
        if kind in (POINT, POSITION):
            now.N[m, i] = 1.0
            now.residual[m] = now.pose.d[i] - now.prescribed[m, 0]
            now.at_rest[m] = -now.prescribed[m, 1]
            for j in range(12):
                now.G[m, j] = 0.0 + now.H[i, j]
            continue
        if kind in (COORDINATE, DISTANCE, PATH):
            _fill_term(coupling, now)
            continue
        _direction(coupling, now, m, w, w_rate, w_second)
        for k in range(3):
            f[k] = now.pose.rotation[k, coupling.row_other[m]]
        cross(f, w, arm)
        now.residual[m] = w[0] * f[0] + w[1] * f[1] + w[2] * f[2]
        now.at_rest[m] = w_rate[0] * f[0] + w_rate[1] * f[1] + w_rate[2] * f[2]
        for k in range(3):
            now.N[m, 3 + k] = arm[k]
        for j in range(12):
            now.G[m, j] = 0.0 + arm[0] * now.H[3, j] + arm[1] * now.H[4, j] + arm[2] * now.H[5, j]


@kernel
def _fill_term(coupling: Record, now: Record) -> None:
    """Fill residual, N and G of the term of a leg; a path has none without a velocity."""
    kind, row = coupling.row_kind[0], now.N[0]
    if kind == PATH:
        now.residual[0] = 0.0
        return
    if kind == DISTANCE:
        now.residual[0] = _fill_along(now.pose.d, row) - coupling.length
    else:
        angle_gradient(now.pose.rotation[:, 0], row[3:6])
        now.residual[0] = coupling.about * whole_angle(now) - now.offset
        for i in range(3):
            row[i] = coupling.along[i]
            row[3 + i] *= coupling.about
            now.residual[0] += row[i] * now.pose.d[i]
    multiply(now.N[:1], now.H, now.G[:1])


@kernel
def _fill_along(vector: FloatArray, row: FloatArray) -> float:
    """Fill three entries with the direction of a vector; return its length. A point at rest has none."""
    size = _length(vector)
    for i in range(3):
        row[i] = vector[i] / size if size > 0.0 else 0.0
    return size


@kernel
def fill_rates(coupling: Record, now: Record) -> None:
    """Fill rate and wanted acceleration of all rows where positions are filled, and all of a path."""
    work, w_now = now.work, now.pose.w
    w, w_rate, w_second = work[0, :3], work[1, :3], work[2, :3]
    f, swing, twice = work[3, :3], work[4, :3], work[5, :3]
    for m in range(coupling.n_terms):
        kind, i = coupling.row_kind[m], coupling.row_axis[m]
        if kind in (POINT, POSITION):
            now.rate[m] = now.twist[i] + now.at_rest[m]
            now.gamma[m] = now.prescribed[m, 2] - now.bias[i]
            continue
        if kind in (COORDINATE, DISTANCE, PATH):
            _fill_term_rate(coupling, now)
            continue
        _direction(coupling, now, m, w, w_rate, w_second)
        for k in range(3):
            f[k] = now.pose.rotation[k, coupling.row_other[m]]
        cross(w_now, f, swing)
        cross(w_now, swing, twice)
        rate, acceleration = now.at_rest[m], 0.0
        for k in range(3):
            rate += now.N[m, 3 + k] * w_now[k]
            acceleration += now.N[m, 3 + k] * now.bias[3 + k] + w[k] * twice[k]
            acceleration += 2.0 * w_rate[k] * swing[k] + w_second[k] * f[k]
        now.rate[m], now.gamma[m] = rate, -acceleration


@kernel
def _fill_term_rate(coupling: Record, now: Record) -> None:
    """Fill rate and wanted acceleration of the term of a leg."""
    kind, row, v = coupling.row_kind[0], now.N[0], now.pose.v
    if kind == PATH:
        _fill_along(v, row)
        multiply(now.N[:1], now.H, now.G[:1])
    rate = acceleration = 0.0
    for i in range(6):
        rate += row[i] * now.twist[i]
        acceleration += row[i] * now.bias[i]
    if kind == COORDINATE:
        acceleration += coupling.about * angle_rate(now.pose.rotation[:, 0], now.pose.w)
    elif kind == DISTANCE:
        square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
        acceleration += (square - rate * rate) / _length(now.pose.d)
    now.rate[0], now.gamma[0] = rate, -acceleration if kind != PATH else 0.0


@kernel
def _length(vector: FloatArray) -> float:
    return math.sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2])


@kernel
def _across(direction: FloatArray, size: float, matrix: FloatArray) -> None:
    """Fill ``matrix`` (3, 3) with (1 − e eᵀ)/size: how a direction e turns with its vector."""
    for i in range(3):
        for j in range(3):
            unit = 1.0 if i == j else 0.0
            matrix[i, j] = (unit - direction[i] * direction[j]) / size if size > 0.0 else 0.0


@kernel
def _bend(coupling: Record, now: Record, rate: FloatArray, bent: FloatArray, swung: FloatArray) -> None:
    """Fill the rate of a term's direction, and, but for paths, the change of its second rate.

    ``now.small`` (3, 3) takes the derivative of the direction; ``bent`` and ``swung`` (3,) take those of the
    second rate in angle or displacement, and in angular or linear velocity.
    """
    kind, v, turning = coupling.row_kind[0], now.pose.v, now.small
    if kind == COORDINATE:
        angle_hessian(now.pose.rotation[:, 0], now.pose.w, rate[3:6], bent, swung, turning)
        return
    n = now.N[0, :3]
    if kind == PATH:
        _across(n, _length(v), turning)
        return
    size, speed, square = _length(now.pose.d), 0.0, 0.0
    _across(n, size, turning)
    for i in range(3):
        speed += n[i] * v[i]
        square += v[i] * v[i]
    for i in range(3):
        bent[i], swung[i] = -(square - speed * speed) / (size * size) * n[i], 0.0
        for j in range(3):
            bent[i] += turning[i, j] * (rate[j] - 2.0 * speed / size * v[j])
            swung[i] += 2.0 * turning[i, j] * v[j]


@kernel
def _term_gradient(coupling: Record, now: Record, rate: FloatArray, law: Record) -> None:
    """Add the effect of motion on the term of a leg, and on the force along it."""
    bent, swung = now.work[0, :3], now.work[1, :3]
    _bend(coupling, now, rate, bent, swung)
    turns = coupling.row_kind[0] == COORDINATE
    scale, first = (coupling.about, 3) if turns else (1.0, 0)
    column = 6 if coupling.row_kind[0] == PATH else first
    for k in range(3):
        for j in range(3):
            now.slope[first + k, column + j] += now.multiplier[0] * scale * now.small[k, j]
    if coupling.law != 0:
        _law_gradient(now, law, scale, first, column)
        return
    for k in range(3):
        for j in range(12):
            way, spin = scale * now.H[first + k, j], scale * swung[k]
            now.Gq[0, j] += bent[k] * way + spin * now.Vq[first + k, j]
            now.Gv[0, j] += swung[k] * way


@kernel
def _law_gradient(now: Record, law: Record, scale: float, first: int, column: int) -> None:
    """Fill the effect of motion on the equation λ − F = 0 by one leg."""
    for j in range(12):
        rate = 0.0
        for i in range(6):
            rate += now.N[0, i] * now.Vq[i, j]
        # The speed along a path does not change with its direction.
        if column < 6:
            for i in range(3):
                for k in range(3):
                    rate += now.twist[first + i] * scale * now.small[i, k] * now.H[column + k, j]
        now.Gq[0, j] = -law.in_position * now.G[0, j] - law.in_rate * rate
        now.Gv[0, j] = -law.in_rate * now.G[0, j]


@kernel
def row_gradient(coupling: Record, now: Record, rate: FloatArray, law: Record) -> None:
    """Fill Gq and Gv, and add what turning does to the constraint moments to ``now.slope``.

    ``rate`` (6,) is the rate of the twist with the accelerations of the bodies, ``law`` the force law of the
    element whose leg the coupling is.
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
        if coupling.row_kind[m] in (COORDINATE, DISTANCE, PATH):
            _term_gradient(coupling, now, rate, law)
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
