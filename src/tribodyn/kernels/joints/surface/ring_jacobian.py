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

from __future__ import annotations

from typing import Any, Final, NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_motion, fill_windows
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.ring import DERIVATIVES, does_bend, fill_groups, fill_pressures
from tribodyn.kernels.joints.surface.ring_slopes import (
    FIVE,
    PULLED,
    PUSHES,
    RESISTING,
    SLIPS,
    SQUARED,
    STIFF,
    TRACTIONS,
    fill_sums,
)
from tribodyn.kernels.joints.surface.ring_sums import Ring, Tractions, four_rings, no_traction
from tribodyn.kernels.joints.surface.ring_wrench import Forces, no_forces, put_forces, with_ring
from tribodyn.kernels.lanes import WIDTH, load, spread, store, totals, zeros

Three = tuple[Any, Any, Any]
Five = tuple[Any, Any, Any, Any, Any]
Seven = tuple[Any, Any, Any, Any, Any, Any, Any]
Nine = tuple[Any, Any, Any, Any, Any, Any, Any, Any, Any]
"""Sums of a weight times 1, c, s; c², c s; c³, c² s; c⁴, c³ s."""

MATRIX: Final = 36 * WIDTH
NORMAL_PLACE: Final = 0 * MATRIX
NORMAL_RATE: Final = 1 * MATRIX
FRICTION_PLACE: Final = 2 * MATRIX
FRICTION_RATE: Final = 3 * MATRIX
FRICTION_SLIP: Final = 4 * MATRIX
"""Where the derivatives begin, the last three over μ, the second and the last two with the opposite sign."""


class Arms(NamedTuple):
    """What arms of rings are made of: of a ring without the tilt, β, and the slopes of the axis and rates."""

    arm: Any
    bent: Any
    slope: tuple[Any, Any]
    slope_rate: tuple[Any, Any]


@kernel
def wrench_and_derivatives(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record
) -> None:
    """Fill ``normal``, ``friction`` and their derivatives in the scratch; arguments as for ``wrench``."""
    scratch, limit, forces = memory.scratch, surface.h_last * surface.roughness, no_forces()
    turns, bends = surface.torque_radius > 0.0, does_bend(surface)
    rubs = 1.0 if surface.friction_coefficient > 0.0 and not turns else 0.0
    for k in range(0, 5 * MATRIX, WIDTH):
        store(scratch.ring_slopes, k, zeros())
    for r in range(surface.first_row, surface.last_row, WIDTH):
        if fill_windows(data, surface, memory, station, r, limit, 0.0) > 0:
            fill_motion(data, surface, memory, station, r)
            end = fill_groups(data, surface, memory, r, DERIVATIVES)
            fill_pressures(data, surface, memory, end, DERIVATIVES)
            fill_sums(data, surface, memory, r, rubs, bends)
            ring = four_rings(data.rings, r, spread(1.0))
            forces = _with_forces_of(forces, scratch, ring, surface.lean, rubs)
            _add_normal(scratch, ring, surface.lean, bends, surface.torque_radius * station.direction)
            if rubs > 0.0:
                _add_friction(scratch, ring, surface.lean, bends)
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
    tractions = _tractions(sums) if rubs > 0.0 else no_traction()
    return with_ring(forces, ring, lean, phi, _five(sums, PUSHES), tractions)


@inlined
def _tractions(sums: FloatArray) -> Tractions:
    t, b = _five(sums, TRACTIONS), _five(sums, TRACTIONS + FIVE)
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
def _five(sums: FloatArray, at: int) -> Five:
    return (
        load(sums, at),
        load(sums, at + WIDTH),
        load(sums, at + 2 * WIDTH),
        load(sums, at + 3 * WIDTH),
        load(sums, at + 4 * WIDTH),
    )


@inlined
def _nine(sums: FloatArray, at: int) -> Nine:
    """Return the sums of a weight that has those times c², too."""
    return (*_five(sums, at), *_five(sums, at + SQUARED)[1:])


@inlined
def _leaning(q: Seven, slope: tuple[Any, Any]) -> Five:
    """Return the sums of a weight times x c + y s."""
    x, y = slope
    return (
        x * q[1] + y * q[2],
        x * q[3] + y * q[4],
        x * q[4] + y * (q[0] - q[3]),
        x * q[5] + y * q[6],
        x * q[6] + y * (q[1] - q[5]),
    )


@inlined
def _leaning_more(q: Nine, slope: tuple[Any, Any]) -> Seven:
    """Return the same with two more sums."""
    x, y = slope
    return (*_leaning(q[:7], slope), x * q[7] + y * q[8], x * q[8] + y * (q[3] - q[7]))


@inlined
def _times(a: Any, p: Five) -> Five:
    return a * p[0], a * p[1], a * p[2], a * p[3], a * p[4]


@inlined
def _plus(a: Any, p: Five, b: Any, q: Five) -> Five:
    """Return a p + b q."""
    return (
        a * p[0] + b * q[0],
        a * p[1] + b * q[1],
        a * p[2] + b * q[2],
        a * p[3] + b * q[3],
        a * p[4] + b * q[4],
    )


@inlined
def _plus_more(a: Any, p: Seven, b: Any, q: Seven) -> Seven:
    """Return a p + b q."""
    return (*_plus(a, p[:5], b, q[:5]), a * p[5] + b * q[5], a * p[6] + b * q[6])


@inlined
def _by_c(q: Five) -> Three:
    return q[1], q[3], q[4]


@inlined
def _by_s(q: Five) -> Three:
    return q[2], q[4], q[0] - q[3]


@inlined
def _sum(a: Any, p: Three, b: Any, q: Three) -> Three:
    """Return a p + b q."""
    return a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]


@inlined
def _product(a: Any, p: Three) -> Three:
    return a * p[0], a * p[1], a * p[2]


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
    stiff, resisting, arm, bent = _five(sums, STIFF), _five(sums, RESISTING), ring.arm, arms.bent
    if bends > 0.0:
        k, d = _nine(sums, STIFF), _nine(sums, RESISTING)
        k_arm = _plus_more(arm, k[:7], bent, _leaning_more(k, arms.slope))
        d_arm = _plus_more(arm, d[:7], bent, _leaning_more(d, arms.slope))
        turning = _plus_more(spread(1.0), k_arm, zeros() - bent, _leaning_more(d, arms.slope_rate))
        both = _plus(arm, turning[:5], bent, _leaning(turning, arms.slope))
        both = _plus(spread(1.0), both, zeros() - bent, _five(sums, PUSHES))
        twice = _plus(arm, d_arm[:5], bent, _leaning(d_arm, arms.slope))
        _add_pushes(slopes, NORMAL_PLACE, ring, (stiff, turning[:5], k_arm[:5], both), torque)
        _add_pushes(slopes, NORMAL_RATE, ring, (resisting, d_arm[:5], d_arm[:5], twice), torque)
    else:
        once, again = _times(arm, stiff), _times(arm, resisting)
        _add_pushes(slopes, NORMAL_PLACE, ring, (stiff, once, once, _times(arm, once)), torque)
        _add_pushes(slopes, NORMAL_RATE, ring, (resisting, again, again, _times(arm, again)), torque)


@inlined
def _add_pushes(
    slopes: FloatArray, at: int, ring: Ring, weights: tuple[Five, Five, Five, Five], torque: float
) -> None:
    """Add N times the derivative of the pressure, and that of a friction torque.

    Weights are those of the derivative in d and in φ, then both times the arm of the pressure itself.
    """
    plain, armed, far, both = weights
    row, n_r, n_z, back = 6 * WIDTH, ring.n_r, ring.n_z, spread(-1.0)
    _add_row(slopes, at, ring, _product(n_r, _by_c(plain)), _product(n_r, _by_c(armed)))
    _add_row(slopes, at + row, ring, _product(n_r, _by_s(plain)), _product(n_r, _by_s(armed)))
    _add_row(slopes, at + 2 * row, ring, _product(n_z, plain[:3]), _product(n_z, armed[:3]))
    _add_row(slopes, at + 3 * row, ring, _product(back, _by_s(far)), _product(back, _by_s(both)))
    _add_row(slopes, at + 4 * row, ring, _by_c(far), _by_c(both))
    length, last = spread(torque), at + FRICTION_PLACE - NORMAL_PLACE + 5 * row
    _add_row(slopes, last, ring, _product(length, plain[:3]), _product(length, armed[:3]))


@kernel
def _add_friction(scratch: Record, ring: Ring, lean: float, bends: float) -> None:
    """Add the derivatives of the tractions of four rings."""
    sums, slopes, arms = scratch.ring_sums, scratch.ring_slopes, _arms(scratch, ring, lean)
    for at, out in ((STIFF, FRICTION_PLACE), (RESISTING, FRICTION_RATE)):
        first, second = at + PULLED, at + PULLED + FIVE
        plain = _pulled(ring, _five(sums, first), _five(sums, second))
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


@inlined
def _armed(sums: FloatArray, at: int, arms: Arms, steady: float, bends: float) -> Five:
    """Return the sums of a weight times the arm; those at ``STIFF`` with the term of the rate."""
    q = _times(arms.arm, _five(sums, at))
    if bends > 0.0:
        q = _plus(spread(1.0), q, arms.bent, _leaning(_nine(sums, at)[:7], arms.slope))
        if steady == 0.0:
            rate = _nine(sums, at + RESISTING - STIFF)[:7]
            q = _plus(spread(1.0), q, zeros() - arms.bent, _leaning(rate, arms.slope_rate))
    return q


@inlined
def _pulled(ring: Ring, t: Five, b: Five) -> tuple[Three, Three, Three, Three, Three, Three]:
    """Return t A + b B row by row, times 1, c, s."""
    lever, one, z = ring.radius * ring.n_r + ring.z * ring.n_z, spread(1.0), zeros() - ring.z
    back, against = zeros() - one, zeros() - ring.n_z
    return (
        _sum(back, _by_s(t), against, _by_c(b)),
        _sum(one, _by_c(t), against, _by_s(b)),
        _product(ring.n_r, b[:3]),
        _sum(z, _by_c(t), lever, _by_s(b)),
        _sum(z, _by_s(t), zeros() - lever, _by_c(b)),
        _product(ring.radius, t[:3]),
    )


@inlined
def _add_slips(sums: FloatArray, slopes: FloatArray, ring: Ring) -> None:
    """Add the derivatives in the slip."""
    mixed, at, row = _times(spread(-1.0), _five(sums, SLIPS + FIVE)), FRICTION_SLIP, 6 * WIDTH
    t, b = _pulled(ring, _five(sums, SLIPS), mixed), _pulled(ring, mixed, _five(sums, SLIPS + 2 * FIVE))
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
