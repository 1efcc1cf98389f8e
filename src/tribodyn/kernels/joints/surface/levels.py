"""Pressures of rings on elastic bodies: between two levels of compliance, see ``bulk``."""

from typing import Any, Final

from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_motion, groups_of, rings_from
from tribodyn.kernels.joints.surface.bulk import LEVEL, OVERRATED, SHARE, fill_bulk
from tribodyn.kernels.joints.surface.data import SurfaceData
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
from tribodyn.kernels.lanes import above, entries_at, load, rows_at, spread, store, zeros

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
    if surface.levels > 0.0:
        fill_bulk(data, surface, memory, station, r, 0.0 if purpose == WRENCH else 1.0)
        _fill_pressures(data, surface, memory, r, purpose)
    else:
        fill_pressures(data, surface, memory, end, purpose)


@inlined
def _at(x: Any, k: tuple[Any, Any, Any, Any, Any, Any, Any, Any]) -> tuple[Any, Any, Any]:
    """Return P, dP/dx and C of a row of a table."""
    p = k[0] + x * (k[1] + x * (k[2] + x * k[3]))
    return (
        p,
        k[1] + x * (spread(2.0) * k[2] + x * (spread(3.0) * k[3])),
        k[4] + x * (k[5] + x * (k[6] + x * k[7])),
    )


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


@kernel
def _fill_pressures(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, purpose: float
) -> None:
    """Do the work of ``ring.fill_pressures`` between two levels."""
    block, at, pitch, step = memory.block, BLOCK_GROUPS, surface.pitch, surface.inverse_step
    slope, least, most = (
        spread(step / surface.roughness),
        spread(least_pressure(surface)),
        spread(surface.hardness),
    )
    zero, width, half, over = zeros(), spread(1.0 / step), spread(-0.5 / step), spread(OVERRATED)
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
            sinks_a, sinks_b = a * a_1, b * b_1
            rigid = _blend(weights, a, sinks_a, b, sinks_b)
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
                widening = _blend(slopes, a, sinks_a, b, sinks_b)
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
