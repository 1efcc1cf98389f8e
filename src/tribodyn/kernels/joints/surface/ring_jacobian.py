"""Wrench of a surface of revolution with its derivatives, see ``jacobian``: four rings at a time.

At a node of a ring, with the arm m of its pressure, see ``tilt``, and λ = R n_r + z n_z, the directions of
pressure and of both slips are

    N = (n_r c, n_r s, n_z, −m s, m c, 0),
    A = (−s, c, 0, −z c, −z s, R),    B = (−n_z c, −n_z s, n_r, λ s, −λ c, 0)

with c = cos θ, s = sin θ. In ``jacobian`` Ŝ is t A + b B, and Xᵀ X − N Nᵀ is A Aᵀ + B Bᵀ. So the derivatives
are sums Σ w (1, c, s, c², c s) times numbers of the ring.

With the second-order term of the tilt m is arm + β (φ_y c − φ_x s), β = ρ n_r². Then ∂P/∂h m gives way to
∂P/∂h m − ∂P/∂δ̇ β (φ̇_y c − φ̇_x s) where the pressure is differentiated in φ, and m itself moves with φ.

Derivatives are added up in lanes, one for each of four rings, until the last ring.
"""

from typing import Any, Final, NamedTuple

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_windows
from tribodyn.kernels.joints.surface.bulk import SLOPE, fill_block
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.ring import DERIVATIVES, does_bend
from tribodyn.kernels.joints.surface.ring_slopes import (
    FIVE,
    PULLED,
    PUSHES,
    RESISTING,
    SLIPS,
    STIFF,
    TRACTIONS,
    WIDENED,
    Five,
    Three,
    by_c,
    by_s,
    fill_sums,
    five_at,
    leaning,
    leaning_more,
    nine_at,
    plus,
    plus_more,
    product,
    sum_of,
    times,
)
from tribodyn.kernels.joints.surface.ring_wrench import (
    Forces,
    Ring,
    Tractions,
    four_rings,
    no_forces,
    no_pressure,
    no_traction,
    put_forces,
    with_pressures_of,
    with_ring,
    with_tractions_of,
)
from tribodyn.kernels.lanes import WIDTH, load, spread, store, totals, zeros

ROW: Final = 6 * WIDTH
MATRIX: Final = 6 * ROW
NORMAL_PLACE: Final = 0 * MATRIX
NORMAL_RATE: Final = 1 * MATRIX
FRICTION_PLACE: Final = 2 * MATRIX
FRICTION_RATE: Final = 3 * MATRIX
#: Begins of the derivatives, the last three over μ, the second and the last two with the opposite sign.
FRICTION_SLIP: Final = 4 * MATRIX


class Arms(NamedTuple):
    """Parts of the arms of rings: of a ring without the tilt, β, and the slopes of the axis and rates."""

    arm: Any
    bent: Any
    slope: tuple[Any, Any]
    slope_rate: tuple[Any, Any]


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch."""
    scratch, limit, forces = memory.scratch, surface.h_last * surface.roughness, no_forces()
    turns, bends = surface.torque_radius > 0.0, does_bend(surface)
    rubs = 1.0 if surface.friction_coefficient > 0.0 and not turns else 0.0
    for k in range(0, 5 * MATRIX, WIDTH):
        store(scratch.ring_slopes, k, zeros())
    for r in range(surface.first_row, surface.last_row, WIDTH):
        if fill_windows(data, surface, memory, station, r, limit, 0.0) > 0:
            fill_block(data, surface, memory, station, r, DERIVATIVES)
            fill_sums(data, surface, memory, r, rubs, bends)
            ring = four_rings(data.rings, r, spread(1.0))
            forces = _with_forces_of(forces, scratch, ring, surface.lean, rubs)
            _add_normal(scratch, ring, surface.lean, bends, surface.torque_radius * station.direction)
            if rubs > 0.0:
                _add_friction(scratch, ring, surface.lean, bends)
            if surface.levels > 0.0:
                _add_widening(memory.block, scratch, ring, surface.lean, rubs)
    put_forces(surface, station, forces, scratch)
    mu = surface.friction_coefficient
    _put_matrix(scratch.ring_slopes, NORMAL_PLACE, 1.0, scratch.normal_place)
    _put_matrix(scratch.ring_slopes, NORMAL_RATE, -1.0, scratch.normal_rate)
    _put_matrix(scratch.ring_slopes, FRICTION_PLACE, mu, scratch.friction_place)
    _put_matrix(scratch.ring_slopes, FRICTION_RATE, -mu, scratch.friction_rate)
    _put_matrix(scratch.ring_slopes, FRICTION_SLIP, -mu, scratch.friction_slip)


@inlined
def _with_forces_of(forces: Forces, scratch: Record, ring: Ring, lean: float, rubs: float) -> Forces:
    """Return the sums with those of the four rings."""
    sums, phi = scratch.ring_sums, scratch.tilt.phi
    tractions = _tractions(sums, TRACTIONS) if rubs > 0.0 else no_traction()
    return with_ring(forces, ring, lean, phi, five_at(sums, PUSHES), tractions)


@inlined
def _tractions(sums: FloatArray, at: int) -> Tractions:
    t, b = five_at(sums, at), five_at(sums, at + FIVE)
    return t[0], t[1], t[2], b[0], b[1], b[2]


@kernel
def _put_matrix(slopes: FloatArray, at: int, factor: float, out: FloatArray) -> None:
    """Fill ``out`` (6, 6) with derivatives times a factor."""
    entries, factors = out.reshape(36), spread(factor)
    for k in range(0, 36, WIDTH):
        first = at + WIDTH * k
        a, b = load(slopes, first), load(slopes, first + WIDTH)
        c, d = load(slopes, first + 2 * WIDTH), load(slopes, first + 3 * WIDTH)
        store(entries, k, factors * totals(a, b, c, d))


@inlined
def _add(slopes: FloatArray, at: int, value: Any) -> None:
    store(slopes, at, load(slopes, at) + value)


@inlined
def _add_row(slopes: FloatArray, at: int, ring: Ring, plain: Three, armed: Three) -> None:
    """Add a row whose pressure has the sums ``plain`` of 1, c, s, and ``armed`` times the arm of N."""
    _add(slopes, at, ring.n_r * plain[1])
    _add(slopes, at + WIDTH, ring.n_r * plain[2])
    _add(slopes, at + 2 * WIDTH, ring.n_z * plain[0])
    _add(slopes, at + 3 * WIDTH, zeros() - armed[2])
    _add(slopes, at + 4 * WIDTH, armed[1])


@inlined
def _arms(scratch: Record, ring: Ring, lean: float) -> Arms:
    phi, rate = scratch.tilt.phi, scratch.tilt.rate
    slope, slope_rate = (spread(phi[1]), spread(-phi[0])), (spread(rate[1]), spread(-rate[0]))
    return Arms(ring.arm, spread(lean) * ring.n_r * ring.n_r, slope, slope_rate)


@kernel
def _add_normal(scratch: Record, ring: Ring, lean: float, bends: float, torque: float) -> None:
    """Add the derivatives of the pressures of four rings; ``torque`` is the arm of a friction torque [m]."""
    sums, slopes, arms = scratch.ring_sums, scratch.ring_slopes, _arms(scratch, ring, lean)
    stiff, resisting, arm, bent = five_at(sums, STIFF), five_at(sums, RESISTING), ring.arm, arms.bent
    if bends > 0.0:
        k, d = nine_at(sums, STIFF), nine_at(sums, RESISTING)
        k_arm = plus_more(arm, k[:7], bent, leaning_more(k, arms.slope))
        d_arm = plus_more(arm, d[:7], bent, leaning_more(d, arms.slope))
        turning = plus_more(spread(1.0), k_arm, zeros() - bent, leaning_more(d, arms.slope_rate))
        both = plus(arm, turning[:5], bent, leaning(turning, arms.slope))
        both = plus(spread(1.0), both, zeros() - bent, five_at(sums, PUSHES))
        twice = plus(arm, d_arm[:5], bent, leaning(d_arm, arms.slope))
        _add_pushes(slopes, NORMAL_PLACE, ring, (stiff, turning[:5], k_arm[:5], both), torque)
        _add_pushes(slopes, NORMAL_RATE, ring, (resisting, d_arm[:5], d_arm[:5], twice), torque)
    else:
        once, again = times(arm, stiff), times(arm, resisting)
        _add_pushes(slopes, NORMAL_PLACE, ring, (stiff, once, once, times(arm, once)), torque)
        _add_pushes(slopes, NORMAL_RATE, ring, (resisting, again, again, times(arm, again)), torque)


@inlined
def _add_pushes(
    slopes: FloatArray, at: int, ring: Ring, weights: tuple[Five, Five, Five, Five], torque: float
) -> None:
    """Add N times the derivative of the pressure, and that of a friction torque.

    Weights are those of the derivative in d and in φ, then both times the arm of the pressure itself.
    """
    plain, armed, far, both = weights
    row, n_r, n_z, back = 6 * WIDTH, ring.n_r, ring.n_z, spread(-1.0)
    _add_row(slopes, at, ring, product(n_r, by_c(plain)), product(n_r, by_c(armed)))
    _add_row(slopes, at + row, ring, product(n_r, by_s(plain)), product(n_r, by_s(armed)))
    _add_row(slopes, at + 2 * row, ring, product(n_z, plain[:3]), product(n_z, armed[:3]))
    _add_row(slopes, at + 3 * row, ring, product(back, by_s(far)), product(back, by_s(both)))
    _add_row(slopes, at + 4 * row, ring, by_c(far), by_c(both))
    length, last = spread(torque), at + FRICTION_PLACE - NORMAL_PLACE + 5 * row
    _add_row(slopes, last, ring, product(length, plain[:3]), product(length, armed[:3]))


@kernel
def _add_friction(scratch: Record, ring: Ring, lean: float, bends: float) -> None:
    """Add the derivatives of the tractions of four rings."""
    sums, slopes, arms = scratch.ring_sums, scratch.ring_slopes, _arms(scratch, ring, lean)
    for at, out in ((STIFF, FRICTION_PLACE), (RESISTING, FRICTION_RATE)):
        first, second = at + PULLED, at + PULLED + FIVE
        plain = _pulled(ring, five_at(sums, first), five_at(sums, second))
        steady = 1.0 if at == RESISTING else 0.0
        armed = _pulled(
            ring, _armed(sums, first, arms, steady, bends), _armed(sums, second, arms, steady, bends)
        )
        row = 6 * WIDTH
        _add_row(slopes, out, ring, plain[0], armed[0])
        _add_row(slopes, out + row, ring, plain[1], armed[1])
        _add_row(slopes, out + 2 * row, ring, plain[2], armed[2])
        _add_row(slopes, out + 3 * row, ring, plain[3], armed[3])
        _add_row(slopes, out + 4 * row, ring, plain[4], armed[4])
        _add_row(slopes, out + 5 * row, ring, plain[5], armed[5])
    _add_slips(sums, slopes, ring)


@kernel
def _add_widening(block: FloatArray, scratch: Record, ring: Ring, lean: float, rubs: float) -> None:
    """Add the wrench of ∂P_c/∂q of four rings times the derivatives of q."""
    sums, slopes, at = scratch.ring_sums, scratch.ring_slopes, NORMAL_PLACE
    x, y, z, m_x, m_y = with_pressures_of(no_pressure(), ring, lean, scratch.tilt.phi, five_at(sums, WIDENED))
    _add_rows(block, slopes, at, zeros() - x, zeros() - y, zeros() - z)
    _add_rows(block, slopes, at + 3 * ROW, m_x, zeros() - m_y, zeros())
    if rubs > 0.0:
        f = with_tractions_of(no_traction(), ring, _tractions(sums, WIDENED + FIVE))
        _add_rows(block, slopes, FRICTION_PLACE, f[0], zeros() - f[1], zeros() - f[2])
        _add_rows(block, slopes, FRICTION_PLACE + 3 * ROW, zeros() - f[3], f[4], zeros() - f[5])


@inlined
def _add_rows(block: FloatArray, slopes: FloatArray, at: int, a: Any, b: Any, c: Any) -> None:
    """Add three rows: numbers times the derivatives of q."""
    for k in range(0, 5 * WIDTH, WIDTH):
        slope = load(block, SLOPE + k)
        _add(slopes, at + k, a * slope)
        _add(slopes, at + ROW + k, b * slope)
        _add(slopes, at + 2 * ROW + k, c * slope)


@inlined
def _armed(sums: FloatArray, at: int, arms: Arms, steady: float, bends: float) -> Five:
    """Return the sums of a weight times the arm; those at ``STIFF`` with the term of the rate."""
    q = times(arms.arm, five_at(sums, at))
    if bends > 0.0:
        q = plus(spread(1.0), q, arms.bent, leaning(nine_at(sums, at)[:7], arms.slope))
        if steady == 0.0:
            rate = nine_at(sums, at + RESISTING - STIFF)[:7]
            q = plus(spread(1.0), q, zeros() - arms.bent, leaning(rate, arms.slope_rate))
    return q


@inlined
def _pulled(ring: Ring, t: Five, b: Five) -> tuple[Three, Three, Three, Three, Three, Three]:
    """Return t A + b B row by row, times 1, c, s."""
    lever, one, z = ring.radius * ring.n_r + ring.z * ring.n_z, spread(1.0), zeros() - ring.z
    back, against = zeros() - one, zeros() - ring.n_z
    return (
        sum_of(back, by_s(t), against, by_c(b)),
        sum_of(one, by_c(t), against, by_s(b)),
        product(ring.n_r, b[:3]),
        sum_of(z, by_c(t), lever, by_s(b)),
        sum_of(z, by_s(t), zeros() - lever, by_c(b)),
        product(ring.radius, t[:3]),
    )


@inlined
def _add_slips(sums: FloatArray, slopes: FloatArray, ring: Ring) -> None:
    """Add the derivatives in the slip."""
    mixed, at, row = times(spread(-1.0), five_at(sums, SLIPS + FIVE)), FRICTION_SLIP, 6 * WIDTH
    t, b = _pulled(ring, five_at(sums, SLIPS), mixed), _pulled(ring, mixed, five_at(sums, SLIPS + 2 * FIVE))
    _add_pulled(slopes, at, ring, t[0], b[0])
    _add_pulled(slopes, at + row, ring, t[1], b[1])
    _add_pulled(slopes, at + 2 * row, ring, t[2], b[2])
    _add_pulled(slopes, at + 3 * row, ring, t[3], b[3])
    _add_pulled(slopes, at + 4 * row, ring, t[4], b[4])
    _add_pulled(slopes, at + 5 * row, ring, t[5], b[5])


@inlined
def _add_pulled(slopes: FloatArray, at: int, ring: Ring, t: Three, b: Three) -> None:
    """Add a row t A + b B."""
    lever, zero = ring.radius * ring.n_r + ring.z * ring.n_z, zeros()
    _add(slopes, at, zero - t[2] - ring.n_z * b[1])
    _add(slopes, at + WIDTH, t[1] - ring.n_z * b[2])
    _add(slopes, at + 2 * WIDTH, ring.n_r * b[0])
    _add(slopes, at + 3 * WIDTH, lever * b[2] - ring.z * t[1])
    _add(slopes, at + 4 * WIDTH, zero - ring.z * t[2] - lever * b[1])
    _add(slopes, at + 5 * WIDTH, ring.radius * t[0])
