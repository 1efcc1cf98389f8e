"""Four rings at a time: which of their nodes can be in contact, in windows, and their motion.

All numbers of a ring are made in lanes, one lane for each of four rings that follow each other, and kept in
an array that the loops over nodes read. Behind them it has place for all groups of nodes of these rings.
"""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.data import (
    ARM,
    COUNT,
    HEIGHT,
    LEAST,
    N_AXIAL,
    N_RADIAL,
    NODE_AREA,
    RADIUS,
    SurfaceData,
)
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.lanes import (
    WIDTH,
    above,
    absolute,
    floor,
    load,
    spread,
    square_root,
    store,
    total,
    zeros,
)

FIRST: Final = 0 * WIDTH
NUMBER: Final = 1 * WIDTH  #: First group and number of groups that can be in contact, see ``windows``.
NEARING: Final = 2 * WIDTH
#: Gap as drawn and approach speed: a, b, c, d and e of a + b cos θ + c sin θ + d cos² θ + e cos θ sin θ.
APPROACHING: Final = 7 * WIDTH
AROUND: Final = 12 * WIDTH
ALONG: Final = 15 * WIDTH  #: Slips around and along: a, b and c.


@inlined
def _put(block: FloatArray, place: int, a: Any, b: Any, c: Any) -> None:
    store(block, place, a)
    store(block, place + WIDTH, b)
    store(block, place + 2 * WIDTH, c)


@inlined
def groups_of(block: FloatArray, k: int) -> tuple[int, int]:
    """Return the first group and the number of groups of ring ``k`` of the block."""
    return int(block[FIRST + k]), int(block[NUMBER + k])


@inlined
def rings_from(surface: Record, r: int) -> int:
    """Return the number of rings of the block that begins at row ``r`` that belong to the surface."""
    return min(surface.last_row - r, WIDTH)


@kernel
def fill_windows(
    data: SurfaceData,
    surface: Record,
    memory: SurfaceMemory,
    station: Record,
    r: int,
    limit: float,
    edges: float,
) -> int:
    """Fill windows and gaps of four rings from row ``r`` on; return the number of groups within windows.

    Gaps up to ``limit`` [m] are looked at, and with ``edges`` 1 rows on an edge, without area, too.
    """
    rings, block, d, phi, zero = data.rings, memory.block, station.d, memory.scratch.tilt.phi, zeros()
    n_r, arm = load(rings[N_RADIAL], r), load(rings[ARM], r)
    shift = spread(station.opening) - load(rings[N_AXIAL], r) * spread(d[2])
    b = zero - (n_r * spread(d[0]) + arm * spread(phi[1]))
    c = zero - (n_r * spread(d[1]) - arm * spread(phi[0]))
    off = square_root(b * b + c * c)
    bent = 0.5 * max(surface.lean, 0.0) * (phi[0] * phi[0] + phi[1] * phi[1])
    room = load(rings[LEAST], r) + shift - spread(bent + limit)
    least_area = spread(-1.0 if edges > 0.0 else 0.0)
    near = above(load(rings[NODE_AREA], r), least_area, above(room, off, zero, spread(1.0)), zero)
    store(block, FIRST, zero)
    store(block, NUMBER, near)
    if total(near) == 0.0:
        return 0
    first, number = contact_windows(room, b, c, off, load(rings[COUNT], r))
    store(block, FIRST, first)
    store(block, NUMBER, above(near, zero, number, zero))
    _put(block, NEARING, shift, b, c)
    found = 0
    for k in range(rings_from(surface, r)):
        found += int(block[NUMBER + k])
    return found


@kernel
def fill_motion(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, r: int) -> None:
    """Fill approach and slips of four rings from row ``r`` on, and what the tilt adds to their gaps."""
    rings, block = data.rings, memory.block
    phi, rate = memory.scratch.tilt.phi, memory.scratch.tilt.rate
    n_r, n_z, arm = load(rings[N_RADIAL], r), load(rings[N_AXIAL], r), load(rings[ARM], r)
    radius, z = load(rings[RADIUS], r), load(rings[HEIGHT], r)
    v, w_x, w_y, both = station.v, spread(station.w[0]), spread(station.w[1]), spread(surface.along)
    slip_x, slip_y = spread(station.slip[0]) + w_y * z, spread(station.slip[1]) - w_x * z
    x, y, x_rate, y_rate = spread(phi[1]), spread(-phi[0]), spread(rate[1]), spread(-rate[0])
    bent = spread(surface.lean) * n_r * n_r
    half = spread(0.5) * bent
    store(block, NEARING, load(block, NEARING) - half * (y * y))
    store(block, NEARING + 3 * WIDTH, half * (y * y - x * x))
    store(block, NEARING + 4 * WIDTH, zeros() - bent * (x * y))
    _put(
        block,
        APPROACHING,
        n_z * spread(v[2]) - spread(station.v_opening) + bent * (y * y_rate),
        n_r * spread(v[0]) + arm * spread(rate[1]),
        n_r * spread(v[1]) - arm * spread(rate[0]),
    )
    store(block, APPROACHING + 3 * WIDTH, bent * (x * x_rate - y * y_rate))
    store(block, APPROACHING + 4 * WIDTH, bent * (x * y_rate + y * x_rate))
    _put(block, AROUND, spread(station.w[2]) * radius, slip_y, zeros() - slip_x)
    turning = n_r * radius
    _put(
        block,
        ALONG,
        both * (n_r * spread(station.slip[2])),
        zeros() - both * (turning * w_y + n_z * slip_x),
        both * (turning * w_x - n_z * slip_y),
    )


#: Angle by which the window is wider than need be [rad], above the errors of both approximations below.
MARGIN: Final = 2.0e-4


@inlined
def arc_cosine(x: Any) -> Any:
    """Return arccos ``x`` [rad] within 7e-5: Abramowitz and Stegun, Handbook (1964), 4.4.45."""
    size = absolute(x)
    polynomial = spread(0.0742610) - spread(0.0187293) * size
    polynomial = spread(1.5707288) + size * (size * polynomial - spread(0.2121144))
    angle = square_root(spread(1.0) - size) * polynomial
    return above(zeros(), x, spread(math.pi) - angle, angle)


@inlined
def direction(x: Any, y: Any) -> Any:
    """Return the angle of (x, y) ≠ 0 between 0 and 2π [rad], within 2e-5: ibid., 4.4.49 with fewer terms."""
    size_x, size_y, zero = absolute(x), absolute(y), zeros()
    ratio = above(size_x, size_y, size_y, size_x) / above(size_x, size_y, size_x, size_y)
    square = ratio * ratio
    tail = square * (spread(-0.0851330) + square * spread(0.0208351))
    tail = square * (spread(-0.3302995) + square * (spread(0.1801410) + tail))
    angle = ratio * (spread(0.9998660) + tail)
    angle = above(size_y, size_x, spread(0.5 * math.pi) - angle, angle)
    angle = above(zero, x, spread(math.pi) - angle, angle)
    return above(zero, y, spread(2.0 * math.pi) - angle, angle)


@inlined
def contact_windows(room: Any, a: Any, b: Any, eccentricity: Any, n_theta: Any) -> tuple[Any, Any]:
    """Return the first group of four nodes and the number of groups that hold every unworn gap below a limit.

    The gap of a ring is ``room + a cos θ + b sin θ`` above the limit (Eq. 48), a cosine with its minimum
    opposite to the direction of (a, b), whose size is the eccentricity [m]. Wear only widens the gap, so the
    window of the unworn gap holds every node in contact. The room includes a bound of the second-order term
    of the tilt. A node more at each end may be in it: looking up its gap costs less than exact trigonometry.
    The window may go on at group 0; where a gap is not a number it holds all.
    """
    zero, one, last = zeros(), spread(1.0), spread(WIDTH - 1.0)
    cosine = room / eccentricity
    inside = above(cosine, spread(-1.0), above(one, cosine, cosine, one), one)
    half_width = arc_cosine(inside) + spread(MARGIN)
    centre = direction(zero - a, zero - b)
    nodes_per_radian = n_theta * spread(0.5 / math.pi)
    first = zero - floor((half_width - centre) * nodes_per_radian)
    count = floor((centre + half_width) * nodes_per_radian) - first + one
    first = above(zero, first, first + n_theta, first)
    first = above(n_theta, first, first, zero)
    count = above(cosine, spread(-1.0), above(count, n_theta, n_theta, count), n_theta)
    first = above(n_theta, count, above(first, zero, first, zero), zero)
    quarter = spread(1.0 / WIDTH)
    begin, beyond = floor(first * quarter), first + count
    until = above(n_theta, beyond, beyond, n_theta)
    again = floor((beyond - until + last) * quarter)
    number = floor((until + last) * quarter) - begin + above(begin, again, again, begin)
    return begin, above(one, cosine, above(count, zero, number, zero), above(cosine, zero, zero, number))
