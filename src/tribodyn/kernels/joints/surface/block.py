"""Four rings at a time: which of their nodes can be in contact, and what the motion of the shaft is to them.

All numbers of a ring are made in lanes, one lane for each of four rings that follow each other, and kept in
an array that the loops over nodes read. Behind them it has place for all groups of nodes of these rings.
"""

from typing import Any, Final

from tribodyn.core.arrays import FloatArray
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
from tribodyn.kernels.joints.surface.windows import contact_windows
from tribodyn.kernels.lanes import WIDTH, above, load, spread, square_root, store, total, zeros

FIRST: Final = 0 * WIDTH
NUMBER: Final = 1 * WIDTH
"""First group and number of groups that can be in contact, see ``windows``."""
NEARING: Final = 2 * WIDTH
APPROACHING: Final = 7 * WIDTH
"""Gap as drawn and approach speed: a, b, c, d and e of a + b cos θ + c sin θ + d cos² θ + e cos θ sin θ."""
AROUND: Final = 12 * WIDTH
ALONG: Final = 15 * WIDTH
"""Slips around and along: a, b and c."""


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
    """Fill windows and gaps of four rings and return the number of their groups within the windows.

    Parameters
    ----------
    data, surface, memory, station
        As for ``ring_wrench.wrench``.
    r
        Row of the first of the rings.
    limit
        Largest gap that is looked at [m].
    edges
        1 if rows on an edge, without area, are looked at, too.
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
