"""Elastic bodies under the asperities of a surface, and pressures of rings between two levels of compliance.

Under a pressure p the surface sinks by C p, as on a liner, but C belongs to the present size of the contact.
With the eccentricity e of a ring, its room c without wear, and the least gap x = c − e,

    r = √(x² + (2 D₀ σ)²),    D = (r − x)/2,    y = D/(c + D) = 1 − cos α:

D is the overlap of two circles, rounded by the asperities, and α half the angle on which they touch. Then

    C = R/(E √M),    M = 1/g(y)²,    g(y) = √(2 y) (a₀ + a₁ y + …).

g is that of a pin in an elastic bore, solved without the assumption of a foundation; with g → α/κ it is
Hertz's line contact. C follows the eccentricity of its own ring, so that forces have a potential, tilted or
not. A ball in a race touches on a circle. A ball in a bore is as long as its own curvature lets it, κ² R/2D
in M. Of a face C is constant.

Tables hold the law at levels q = 0, 1, … of C = (q/N)² C_soft. Between two of them the energy is a Hermite
polynomial of q, for ∂W/∂C = −P²/2 is known, and pressures are its exact derivatives. The energy that it loses
while C changes is a power of its own, see ``ring_report``.
"""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import NEARING, fill_motion, groups_of, rings_from
from tribodyn.kernels.joints.surface.data import ARM, LEAST, N_RADIAL, SurfaceData
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    DERIVATIVES,
    ENERGY,
    FOLLOWING,
    FRACTION,
    NUMBER,
    PRESSURE,
    RATIO,
    REPORT,
    RESISTANCE,
    RIGID,
    STIFFNESS,
    STRIDE,
    WRENCH,
    fill_groups,
    fill_pressures,
    least_pressure,
)
from tribodyn.kernels.lanes import (
    WIDTH,
    above,
    entries_at,
    floor,
    load,
    rows_at,
    spread,
    square_root,
    store,
    zeros,
)

RING: Final = 0.0
RACE: Final = 1.0
HOLE: Final = 2.0
#: Extents of a contact: an arc of its ring, a cap of a ball in a race, below a ball in a bore, constant.
FACE: Final = 3.0
#: κ: stiffness per area of Hertz's line contact, times its half width, over E.
KAPPA: Final = 3.0 * math.pi / 8.0
#: The same of Hertz's circle, (16/3π)/κ, squared.
CAP: Final = 2.0 * (64.0 / (9.0 * math.sqrt(2.0) * math.pi**2)) ** 2
ROUNDING: Final = 2.0  #: D₀: overlap of two rough circles that touch, over σ.
ARC: Final = (1.0 / KAPPA, 0.6883, -5.144, 9.262, -6.556)  #: a₀, a₁, …, fitted from 2° to 75°.
WIDEST: Final = 0.75  #: Largest y: the load of a pin has no bound near 0.83.
#: Share by which the largest pressure of a foundation exceeds that of elastic bodies under the same load.
OVERRATED: Final = 0.17

LEAST_SQUARE: Final = 1.0e-30  #: Square of an eccentricity [m²], in the place of zero.

LEVEL: Final = 18 * WIDTH
SHARE: Final = 19 * WIDTH  #: Of each ring of the block: the level below q, and the rest of q.
CHANGE: Final = 20 * WIDTH  #: dq/dt [1/s].
SLOPE: Final = 21 * WIDTH  #: Derivatives of q in d_x, d_y, d_z [1/m], φ_x and φ_y [1/rad].


@kernel
def fill_bulk(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, r: int, slopes: float
) -> None:
    """Fill ``LEVEL`` and ``SHARE`` of four rings from row ``r`` on, whose windows are filled.

    With ``slopes`` 1 ``CHANGE`` and ``SLOPE`` are filled, too.
    """
    rings, block, zero, one = data.rings, memory.block, zeros(), spread(1.0)
    if surface.extent == FACE:
        _put_level(surface, block, spread(surface.softness / math.sqrt(KAPPA)))
        if slopes > 0.0:
            _put_slopes(block, (zero, zero, zero, zero, zero), zero, station.v, memory.scratch.tilt.rate)
        return
    n_r, arm = load(rings[N_RADIAL], r), load(rings[ARM], r)
    opening = spread(station.opening)
    e_x, e_y = zero - load(block, NEARING + WIDTH), zero - load(block, NEARING + 2 * WIDTH)
    e_z, room = zero, opening + spread(surface.clearance)
    cap, short = one, zero
    if surface.extent == RING:
        room = opening + load(rings[LEAST], r)
    elif surface.extent == RACE:
        e_x, e_y, e_z = spread(station.d[0]), spread(station.d[1]), spread(station.d[2])
        n_r, arm, cap = one, zero, spread(CAP)
    else:
        short = spread(0.5 * KAPPA * KAPPA * surface.bore)
    off = square_root(e_x * e_x + e_y * e_y + e_z * e_z + spread(LEAST_SQUARE))
    x, rounding = room - off, 2.0 * ROUNDING * surface.roughness
    root = square_root(x * x + spread(rounding * rounding))
    overlap = spread(0.5) * (root - x)
    across = room + overlap
    fit, fit_slope, follows = _arc(overlap / across)
    # Of overlaps beyond ``WIDEST`` the arc stays as it is.
    reaching = above(follows, zero, overlap, spread(WIDEST) * across)
    wide, brief = cap * across / (spread(2.0) * reaching * fit * fit), short / overlap
    square = wide + brief
    q = spread(surface.softness) / square_root(square_root(square))
    _put_level(surface, block, q)
    if slopes == 0.0:
        return
    # Of M: in x at constant room, in the room, and in e over e.
    own, inverse = spread(-0.25) * q / square, one / across
    in_y = zero - follows * wide * (across / overlap + spread(2.0) * fit_slope / fit)
    in_x = (brief - in_y * room * overlap * inverse * inverse) / root
    in_room = zero - in_y * overlap * inverse * inverse
    in_e = zero - own * in_x / off
    in_e_x, in_e_y = in_e * e_x, in_e * e_y
    found = (n_r * in_e_x, n_r * in_e_y, in_e * e_z, zero - arm * in_e_y, arm * in_e_x)
    change = own * (in_x + in_room) * spread(station.v_opening)
    _put_slopes(block, found, change, station.v, memory.scratch.tilt.rate)


@inlined
def _put_level(surface: Record, block: FloatArray, q: Any) -> None:
    top = spread(surface.levels - 1.0)
    level = floor(above(top, q, q, top))  # this way round for NaN
    store(block, LEVEL, level)
    store(block, SHARE, q - level)


@inlined
def _arc(y: Any) -> tuple[Any, Any, Any]:
    """Return a₀ + a₁ y + … up to ``WIDEST``, its derivative, and whether y is below that, 1 or 0."""
    widest = spread(WIDEST)
    follows = above(widest, y, spread(1.0), zeros())
    y = above(widest, y, y, widest)
    a, b, c, d, e = spread(ARC[0]), spread(ARC[1]), spread(ARC[2]), spread(ARC[3]), spread(ARC[4])
    value = a + y * (b + y * (c + y * (d + y * e)))
    slope = b + y * (spread(2.0) * c + y * (spread(3.0) * d + y * (spread(4.0) * e)))
    return value, slope, follows


@inlined
def _put_slopes(
    block: FloatArray, slopes: tuple[Any, Any, Any, Any, Any], change: Any, v: FloatArray, rate: FloatArray
) -> None:
    """Fill ``SLOPE``, and ``CHANGE`` with ``change`` and what the motion adds."""
    a, b, c, d, e = slopes
    change = change + a * spread(v[0]) + b * spread(v[1]) + c * spread(v[2])
    store(block, CHANGE, change + d * spread(rate[0]) + e * spread(rate[1]))
    store(block, SLOPE, a)
    store(block, SLOPE + WIDTH, b)
    store(block, SLOPE + 2 * WIDTH, c)
    store(block, SLOPE + 3 * WIDTH, d)
    store(block, SLOPE + 4 * WIDTH, e)


#: ∂/∂q of the pressure [Pa], or in reports of the energy over σ, behind which the ratio is not needed.
WIDENING: Final = RATIO
#: Of reports: the pressure that an elastic body has where the foundation's is largest [Pa].
PEAK: Final = FRACTION


@kernel
def fill_block(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, r: int, purpose: float
) -> None:
    """Fill motion and pressures of the block that begins at row ``r``, whose windows are filled.

    Arguments as for ``ring.fill_groups``.
    """
    fill_motion(data, surface, memory, station, r)
    end = fill_groups(data, surface, memory, r, purpose)
    if surface.levels == 0.0:
        fill_pressures(data, surface, memory, end, purpose)
        return
    fill_bulk(data, surface, memory, station, r, 0.0 if purpose == WRENCH else 1.0)
    # A loop for each purpose: one for all runs out of registers.
    if purpose == WRENCH:
        _fill_pressures(data, surface, memory, r, WRENCH)
    elif purpose == REPORT:
        _fill_pressures(data, surface, memory, r, REPORT)
    else:
        _fill_pressures(data, surface, memory, r, DERIVATIVES)


@inlined
def _at(x: Any, k: tuple[Any, Any, Any, Any, Any, Any, Any, Any]) -> tuple[Any, Any, Any]:
    """Return P, dP/dx and C of a row of a table."""
    third = x * k[3]
    second = k[2] + third
    first = k[1] + x * second
    return k[0] + x * first, first + x * (second + third), k[4] + x * (k[5] + x * (k[6] + x * k[7]))


@inlined
def _bends(x: Any, k: tuple[Any, Any, Any, Any, Any, Any, Any, Any]) -> tuple[Any, Any]:
    """Return d²P/dx² and dC/dx."""
    return spread(2.0) * k[2] + x * (spread(6.0) * k[3]), k[5] + x * (
        spread(2.0) * k[6] + x * (spread(3.0) * k[7])
    )


@inlined
def _left(x: Any, k: tuple[Any, Any, Any, Any, Any, Any, Any, Any]) -> Any:
    """Return the integral of P from x to the end of the interval, as ``lookup.stored_energy`` has it."""
    k_1, k_2, k_3 = spread(0.5) * k[1], spread(1.0 / 3.0) * k[2], spread(0.25) * k[3]
    return k[0] + (k_1 + (k_2 + k_3)) - x * (k[0] + x * (k_1 + x * (k_2 + x * k_3)))


@inlined
def _blend(weights: tuple[Any, Any, Any, Any], a: Any, a_slope: Any, b: Any, b_slope: Any) -> Any:
    return (weights[0] * a + weights[1] * a_slope) + (weights[2] * b + weights[3] * b_slope)


@inlined
def _weights(t: float, low: float, high: float) -> tuple[Any, Any, Any, Any]:
    """Return the Hermite weights at ``t`` of values and, times ``low`` and ``high``, of slopes."""
    s = 1.0 - t
    value = t * t * (3.0 - 2.0 * t)
    return spread(1.0 - value), spread(low * t * s * s), spread(value), spread(-high * t * t * s)


@inlined
def _slopes(t: float, low: float, high: float) -> tuple[Any, Any, Any, Any]:
    """Return the derivatives of these weights in ``t``."""
    s = 1.0 - t
    value = 6.0 * t * s
    return (
        spread(-value),
        spread(low * s * (1.0 - 3.0 * t)),
        spread(value),
        spread(high * t * (3.0 * t - 2.0)),
    )


@inlined
def _fill_pressures(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, purpose: float
) -> None:
    """Do the work of ``ring.fill_pressures`` between two levels."""
    block, at, pitch, step = memory.block, BLOCK_GROUPS, surface.pitch, surface.inverse_step
    slope, least = spread(step / surface.roughness), spread(least_pressure(surface))
    zero, most, width = zeros(), spread(surface.hardness), spread(1.0 / step)
    half, over = spread(-0.5 / step), spread(OVERRATED)
    for k in range(rings_from(surface, r)):
        level, t, begin = block[LEVEL + k], block[SHARE + k], at
        at += STRIDE * groups_of(block, k)[1]
        first = surface.first_interval + int(level) * pitch
        cubics, energy = data.cubics[8 * first :], data.energy[first:]
        # dC/dq over σ and over an interval, as slopes of the pressure are.
        low, high = step * surface.growth * level, step * surface.growth * (level + 1.0)
        weights, slopes = _weights(t, low, high), _slopes(t, low, high)
        sinking = spread(0.5 * step * surface.growth * (level + t) * (level + t))
        above_it = cubics[8 * pitch :]
        for g in range(begin, at, STRIDE):
            x, ratio = load(block, g + FRACTION), load(block, g + RATIO)
            low_row, high_row = rows_at(cubics, block, g + NUMBER), rows_at(above_it, block, g + NUMBER)
            a, a_1, c_a = _at(x, low_row)
            b, b_1, c_b = _at(x, high_row)
            rigid = a * (weights[0] + weights[1] * a_1) + b * (weights[2] + weights[3] * b_1)
            damping = weights[0] * c_a + weights[2] * c_b
            whole = rigid + damping * ratio
            bounded = above(least, whole, least, above(whole, most, most, whole))  # this way round for NaN
            store(block, g + PRESSURE, bounded)
            if purpose == DERIVATIVES:
                a_2, ca_1 = _bends(x, low_row)
                b_2, cb_1 = _bends(x, high_row)
                free = above(least, whole, zero, above(whole, most, zero, spread(1.0)))
                stiffness = _blend(weights, a_1, a_1 * a_1 + a * a_2, b_1, b_1 * b_1 + b * b_2)
                stiffness = stiffness + ratio * (weights[0] * ca_1 + weights[2] * cb_1)
                widening = _blend(slopes, a, a * a_1, b, b * b_1)
                widening = widening + ratio * (slopes[0] * c_a + slopes[2] * c_b)
                store(block, g + STIFFNESS, free * slope * stiffness)
                store(block, g + RESISTANCE, free * damping * load(block, g + FOLLOWING))
                store(block, g + WIDENING, free * widening)
            if purpose == REPORT:
                stored_a = entries_at(energy, block, g + NUMBER) + width * _left(x, low_row)
                stored_b = entries_at(energy[pitch:], block, g + NUMBER) + width * _left(x, high_row)
                lost_a, lost_b = half * a * a, half * b * b
                sunk = sinking * (weights[0] * a_1 + weights[2] * b_1)
                store(block, g + RIGID, rigid)
                store(block, g + ENERGY, _blend(weights, stored_a, lost_a, stored_b, lost_b))
                store(block, g + WIDENING, _blend(slopes, stored_a, lost_a, stored_b, lost_b))
                store(block, g + PEAK, bounded / (spread(1.0) + over * sunk * sunk))
