"""Sums over the nodes of four rings, of which the derivatives of their wrench are made.

Each is five sums Σ w (1, cos θ, sin θ, cos² θ, cos θ sin θ) of a weight w. The second-order term of the tilt,
see ``tilt``, needs the same five of w cos² θ. Sums of a ring in four lanes become sums of four rings, one in
each lane.

A weight w has Σ w (1, c, s, c², c s), c = cos θ and s = sin θ, and with a second-order term of the tilt also
Σ w (c³, c² s, c⁴, c³ s). The sums of w c, w s, and w (x c + y s) are made from these with s² = 1 − c².
"""

from typing import Any, Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import groups_of, rings_from
from tribodyn.kernels.joints.surface.data import NODE_AREA, SurfaceData
from tribodyn.kernels.joints.surface.jacobian import slip_square
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, N_SUMS, SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    ALONG_UNIT,
    AROUND_UNIT,
    COSINE,
    PER_SPEED,
    PRESSURE,
    RATIO,
    RESISTANCE,
    SINE,
    STIFFNESS,
    STRIDE,
)
from tribodyn.kernels.joints.surface.ring_wrench import Pressures, no_pressure, with_pressure
from tribodyn.kernels.lanes import WIDTH, load, spread, store, totals

FIVE: Final = 5 * WIDTH
PUSHES: Final = 0 * FIVE
STIFF: Final = 1 * FIVE
RESISTING: Final = 4 * FIVE  #: Of the weights P_c, ∂P_c/∂h, and ∂P_c/∂δ̇.
#: Distance to the sums of the same weight times slip around over q = √(s² + u_s²); then times slip along.
PULLED: Final = FIVE
TRACTIONS: Final = 7 * FIVE  #: Of P_c times these slips.
SLIPS: Final = 9 * FIVE  #: Of P_c/q times 1 − t², t b and 1 − b², where t and b are these slips.
WIDENED: Final = 18 * FIVE  #: Of ∂P_c/∂q, see ``bulk``, and of it times these slips.
SQUARED: Final = 11 * FIVE  #: Distance to the sums of the same weight times cos² θ, of ∂P_c/∂h and ∂P_c/∂δ̇.


@kernel
def fill_sums(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, rubs: float, bends: float
) -> None:
    """Fill the sums of the block of rings that begins at row ``r``, times the area of a node.

    ``rubs`` is 1 if there is friction in the directions of slip, ``bends`` if the tilt has a second-order
    term.
    """
    block, each, at = memory.block, memory.scratch.ring_sums, BLOCK_GROUPS
    for k in range(WIDTH):
        begin, to = at, WIDTH * N_SUMS * k
        if k < rings_from(surface, r):
            at += STRIDE * groups_of(block, k)[1]
        _sum_slopes(block, begin, at, 0.0, each, to)
        if bends > 0.0:
            _sum_slopes(block, begin, at, 1.0, each, to + SQUARED)
        if rubs > 0.0:
            _sum_slips(block, begin, at, slip_square(surface), surface.along, each, to)
            _sum_pulled(block, begin, at, 0.0, each, to + PULLED)
            if bends > 0.0:
                _sum_pulled(block, begin, at, 1.0, each, to + PULLED + SQUARED)
        if surface.levels > 0.0:
            _sum_widened(block, begin, at, each, to + WIDENED)
    area = load(data.rings[NODE_AREA], r)
    _total(each, area, 0, WIDENED if bends > 0.0 else SQUARED + FIVE)
    if surface.levels > 0.0:
        _total(each, area, WIDENED, WIDTH * N_SUMS)


@inlined
def _total(each: FloatArray, area: Any, first: int, end: int) -> None:
    """Make the sums of each ring in four lanes those of four rings, times the area of their nodes."""
    other = WIDTH * N_SUMS
    for at in range(first, end, WIDTH):
        a, b, c = load(each, at), load(each, other + at), load(each, 2 * other + at)
        store(each, at, area * totals(a, b, c, load(each, 3 * other + at)))


@kernel
def _sum_widened(block: FloatArray, begin: int, end: int, each: FloatArray, to: int) -> None:
    """Fill the sums of the derivative in q; ``levels`` has put it in the place of the ratio."""
    pushes, around, along = no_pressure(), no_pressure(), no_pressure()
    for group in range(begin, end, STRIDE):
        c, s, p = load(block, group + COSINE), load(block, group + SINE), load(block, group + RATIO)
        t, b = load(block, group + AROUND_UNIT), load(block, group + ALONG_UNIT)
        pushes = with_pressure(pushes, p, 1.0, c, s)
        around, along = with_pressure(around, p * t, 1.0, c, s), with_pressure(along, p * b, 1.0, c, s)
    _put(pushes, each, to)
    _put(around, each, to + FIVE)
    _put(along, each, to + 2 * FIVE)


@inlined
def _put(sums: Pressures, each: FloatArray, at: int) -> None:
    store(each, at, sums[0])
    store(each, at + WIDTH, sums[1])
    store(each, at + 2 * WIDTH, sums[2])
    store(each, at + 3 * WIDTH, sums[3])
    store(each, at + 4 * WIDTH, sums[4])


@kernel
def _sum_slopes(block: FloatArray, begin: int, end: int, squared: float, each: FloatArray, to: int) -> None:
    """Fill the sums of pressures, stiffnesses and resistances, or of the last two times cos² θ."""
    pushes, stiff, resisting = no_pressure(), no_pressure(), no_pressure()
    for group in range(begin, end, STRIDE):
        c, s = load(block, group + COSINE), load(block, group + SINE)
        stiffness, resistance = load(block, group + STIFFNESS), load(block, group + RESISTANCE)
        if squared > 0.0:
            square = c * c
            stiffness, resistance = square * stiffness, square * resistance
        else:
            pushes = with_pressure(pushes, load(block, group + PRESSURE), 1.0, c, s)
        stiff, resisting = (
            with_pressure(stiff, stiffness, 1.0, c, s),
            with_pressure(resisting, resistance, 1.0, c, s),
        )
    if squared == 0.0:
        _put(pushes, each, to + PUSHES)
    _put(stiff, each, to + STIFF)
    _put(resisting, each, to + RESISTING)


@kernel
def _sum_pulled(block: FloatArray, begin: int, end: int, squared: float, each: FloatArray, to: int) -> None:
    """Fill the sums of stiffnesses and resistances times slips, or of these times cos² θ."""
    stiff, stiff_along, resisting, resisting_along = (
        no_pressure(),
        no_pressure(),
        no_pressure(),
        no_pressure(),
    )
    for group in range(begin, end, STRIDE):
        c, s = load(block, group + COSINE), load(block, group + SINE)
        t, b = load(block, group + AROUND_UNIT), load(block, group + ALONG_UNIT)
        stiffness, resistance = load(block, group + STIFFNESS), load(block, group + RESISTANCE)
        if squared > 0.0:
            square = c * c
            t, b = square * t, square * b
        stiff = with_pressure(stiff, stiffness * t, 1.0, c, s)
        stiff_along = with_pressure(stiff_along, stiffness * b, 1.0, c, s)
        resisting = with_pressure(resisting, resistance * t, 1.0, c, s)
        resisting_along = with_pressure(resisting_along, resistance * b, 1.0, c, s)
    _put(stiff, each, to + STIFF)
    _put(stiff_along, each, to + STIFF + FIVE)
    _put(resisting, each, to + RESISTING)
    _put(resisting_along, each, to + RESISTING + FIVE)


@kernel
def _sum_slips(
    block: FloatArray, begin: int, end: int, square: float, along: float, each: FloatArray, to: int
) -> None:
    """Fill ``TRACTIONS`` and ``SLIPS``; without friction ``along`` there is none in the second direction.

    1 − t² is b² + u_s²/q², so that no digits are lost in fast slip.
    """
    first, both, second, ways = no_pressure(), no_pressure(), no_pressure(), spread(along)
    around, across, least = no_pressure(), no_pressure(), spread(square)
    for group in range(begin, end, STRIDE):
        c, s = load(block, group + COSINE), load(block, group + SINE)
        t, b = load(block, group + AROUND_UNIT), load(block, group + ALONG_UNIT)
        p, per_speed = load(block, group + PRESSURE), load(block, group + PER_SPEED)
        weight, rest = p * per_speed, least * per_speed * per_speed
        around, across = with_pressure(around, p * t, 1.0, c, s), with_pressure(across, p * b, 1.0, c, s)
        first = with_pressure(first, weight * (b * b + rest), 1.0, c, s)
        both = with_pressure(both, weight * t * b, 1.0, c, s)
        second = with_pressure(second, ways * (weight * (t * t + rest)), 1.0, c, s)
    _put(around, each, to + TRACTIONS)
    _put(across, each, to + TRACTIONS + FIVE)
    _put(first, each, to + SLIPS)
    _put(both, each, to + SLIPS + FIVE)
    _put(second, each, to + SLIPS + 2 * FIVE)


Three = tuple[Any, Any, Any]
Five = tuple[Any, Any, Any, Any, Any]
Seven = tuple[Any, Any, Any, Any, Any, Any, Any]
#: Sums of a weight times 1, c, s; c², c s; c³, c² s; c⁴, c³ s.
Nine = tuple[Any, Any, Any, Any, Any, Any, Any, Any, Any]


@inlined
def five_at(sums: FloatArray, at: int) -> Five:
    """Return the five sums of a weight that begin at a place."""
    return (
        load(sums, at),
        load(sums, at + WIDTH),
        load(sums, at + 2 * WIDTH),
        load(sums, at + 3 * WIDTH),
        load(sums, at + 4 * WIDTH),
    )


@inlined
def nine_at(sums: FloatArray, at: int) -> Nine:
    """Return the sums of a weight that has those times c², too."""
    return (*five_at(sums, at), *five_at(sums, at + SQUARED)[1:])


@inlined
def leaning(q: Seven, slope: tuple[Any, Any]) -> Five:
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
def leaning_more(q: Nine, slope: tuple[Any, Any]) -> Seven:
    """Return the same with two more sums."""
    x, y = slope
    return (*leaning(q[:7], slope), x * q[7] + y * q[8], x * q[8] + y * (q[3] - q[7]))


@inlined
def times(a: Any, p: Five) -> Five:
    """Return a p."""
    return a * p[0], a * p[1], a * p[2], a * p[3], a * p[4]


@inlined
def plus(a: Any, p: Five, b: Any, q: Five) -> Five:
    """Return a p + b q."""
    return (
        a * p[0] + b * q[0],
        a * p[1] + b * q[1],
        a * p[2] + b * q[2],
        a * p[3] + b * q[3],
        a * p[4] + b * q[4],
    )


@inlined
def plus_more(a: Any, p: Seven, b: Any, q: Seven) -> Seven:
    """Return a p + b q."""
    return (*plus(a, p[:5], b, q[:5]), a * p[5] + b * q[5], a * p[6] + b * q[6])


@inlined
def by_c(q: Five) -> Three:
    """Return the sums of w c times 1, c, s."""
    return q[1], q[3], q[4]


@inlined
def by_s(q: Five) -> Three:
    """Return the sums of w s times 1, c, s."""
    return q[2], q[4], q[0] - q[3]


@inlined
def sum_of(a: Any, p: Three, b: Any, q: Three) -> Three:
    """Return a p + b q."""
    return a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]


@inlined
def product(a: Any, p: Three) -> Three:
    """Return a p."""
    return a * p[0], a * p[1], a * p[2]
