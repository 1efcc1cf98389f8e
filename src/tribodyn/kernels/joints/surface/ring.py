"""Rows of nodes at equal angles around the axis, four nodes at a time.

On a surface of revolution, what a node needs of the motion is a + b cos θ + c sin θ with numbers that the
nodes of a row share: gap without wear, approach speed, slip around the axis and slip along the profile. With
the normal n = (n_r cos θ, n_r sin θ, n_z) at the radius R and the height z, and the directions

    e = (−sin θ, cos θ, 0),    n × e = (−n_z cos θ, −n_z sin θ, n_r)

of the two slips, x × n = (z n_r − R n_z) e. The second-order term of the tilt has the slope of the axis
w = φ_y cos θ − φ_x sin θ, see ``tilt``.

Loops are short, so that a processor has many groups in hand at once: first what the motion is to the nodes,
then pressures, then sums. Between the first two and the last the groups of four rings are kept in columns.

A window of contact is widened to whole groups of four nodes: out of reach there is no pressure. Where the
number of nodes is not a multiple of four, the last group repeats some, which the table of angles lifts out of
reach.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import (
    ALONG,
    APPROACHING,
    AROUND,
    BENT,
    NEARING,
    groups_of,
    rings_from,
)
from tribodyn.kernels.joints.surface.data import COS, GAP, LIFT, SIN, SurfaceData
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, COLUMNS, SurfaceMemory
from tribodyn.kernels.joints.surface.wrench import slip_square
from tribodyn.kernels.lanes import (
    WIDTH,
    above,
    absolute,
    entries_at,
    floor,
    load,
    rows_at,
    spread,
    square_root,
    store,
    store_places,
    zeros,
)

Wave = tuple[Any, Any, Any]
"""a, b and c of a + b cos θ + c sin θ, each in all lanes."""

COSINE: Final = 0 * WIDTH
SINE: Final = 1 * WIDTH
"""Of θ."""
NUMBER: Final = 2 * WIDTH
FRACTION: Final = 3 * WIDTH
"""Interval of the contact table, as ``store_places`` writes it, and place in it."""
RATIO: Final = 4 * WIDTH
"""Approach speed over reference velocity."""
AROUND_UNIT: Final = 5 * WIDTH
ALONG_UNIT: Final = 6 * WIDTH
"""Slips around and along over √(s² + u_s²)."""
PRESSURE: Final = 7 * WIDTH
"""P_c [Pa]."""
POSITION: Final = 8 * WIDTH
APPROACH: Final = 9 * WIDTH
SQUARE: Final = 10 * WIDTH
DRAG_SPEED: Final = 11 * WIDTH
RIGID: Final = 12 * WIDTH
ENERGY: Final = 13 * WIDTH
"""Of reports: place in the whole table, approach speed [m/s], s² [m²/s²], s²/√(s² + u_s²) [m/s], P_k [Pa] and
the stored energy over σ [Pa]."""
FOLLOWING: Final = 8 * WIDTH
PER_SPEED: Final = 9 * WIDTH
STIFFNESS: Final = 10 * WIDTH
RESISTANCE: Final = 11 * WIDTH
"""Of derivatives: ∂/∂δ̇ of ``RATIO`` [s/m], 1/√(s² + u_s²) [s/m], ∂P_c/∂h [Pa/m] and ∂P_c/∂δ̇ [Pa s/m]."""
STRIDE: Final = COLUMNS * WIDTH
"""Numbers of a group."""
WRENCH: Final = 0.0
REPORT: Final = 1.0
DERIVATIVES: Final = 2.0
"""What the groups are filled for."""


class RingMotion(NamedTuple):
    """What the nodes of a row share: see above; ``lean`` is ρ n_r² [m], ``slope`` that of the axis."""

    gap: Wave
    approach: Wave
    around: Wave
    along: Wave
    lean: Any
    slope: tuple[Any, Any]
    slope_rate: tuple[Any, Any]


@inlined
def _wave_of(block: FloatArray, at: int) -> Wave:
    return spread(block[at]), spread(block[at + WIDTH]), spread(block[at + 2 * WIDTH])


@inlined
def motion_of(memory: SurfaceMemory, k: int) -> RingMotion:
    """Return what the motion of the shaft is to the nodes of ring ``k`` of the block."""
    block, phi, rate = memory.block, memory.scratch.tilt.phi, memory.scratch.tilt.rate
    return RingMotion(
        _wave_of(block, NEARING + k),
        _wave_of(block, APPROACHING + k),
        _wave_of(block, AROUND + k),
        _wave_of(block, ALONG + k),
        spread(block[BENT + k]),
        (spread(phi[1]), spread(-phi[0])),
        (spread(rate[1]), spread(-rate[0])),
    )


@inlined
def _wave(numbers: Wave, c: Any, s: Any) -> Any:
    """Return a + b cos θ + c sin θ."""
    return numbers[0] + numbers[1] * c + numbers[2] * s


@inlined
def gap_and_approach(motion: RingMotion, gap: Any, c: Any, s: Any) -> tuple[Any, Any]:
    """Return the gap [m] and the approach speed [m/s] from the gap as drawn, with wear."""
    w = motion.slope[0] * c + motion.slope[1] * s
    rate = motion.slope_rate[0] * c + motion.slope_rate[1] * s
    bent = motion.lean * w
    return gap + _wave(motion.gap, c, s) - spread(0.5) * bent * w, _wave(motion.approach, c, s) + bent * rate


@inlined
def reference_of(v_min: Any, approach: Any, entry: Any) -> Any:
    """Return the reference velocity [m/s], as ``pressure.reference_velocity`` does."""
    speed = absolute(approach)
    return above(entry, zeros(), entry, above(speed, v_min, speed, v_min))


@inlined
def number_of_groups(row: Record) -> int:
    """Return the number of groups in a row."""
    return (row.count + WIDTH - 1) // WIDTH


@inlined
def place_of(row: Record, group: int) -> tuple[int, int]:
    """Return where a group begins in the table of angles and in arrays over all nodes."""
    whole = number_of_groups(row)
    at = WIDTH * (group if group < whole else group - whole)
    return row.angle + at, row.first + min(at, row.count - WIDTH)


@kernel
def fill_groups(data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, purpose: float) -> int:
    """Fill what the motion is to the nodes of a block, whose rings are filled; return where groups end.

    Parameters
    ----------
    data, surface, memory
        As for ``ring_wrench.wrench``.
    r
        Row of the first ring of the block.
    purpose
        ``WRENCH``, ``REPORT`` or ``DERIVATIVES``, which have columns of their own.
    """
    entry_velocity, block, at = memory.entry_velocity, memory.block, BLOCK_GROUPS
    cos, sin, lift, drawn = data.angles[COS], data.angles[SIN], data.angles[LIFT], data.nodes[GAP]
    zero, one, v_min = zeros(), spread(1.0), spread(surface.minimum_entry_velocity)
    scale, shift = surface.inverse_step / surface.roughness, 1.0 - surface.h_first * surface.inverse_step
    last, least = float(surface.last_interval - surface.first_interval - 1), slip_square(surface)
    scales, shifts, last_one, least_square = spread(scale), spread(shift), spread(last), spread(least)
    for k in range(rings_from(surface, r)):
        row, motion = data.rows[r + k], motion_of(memory, k)
        whole, angles, nodes, last_node = number_of_groups(row), row.angle, row.first, row.count - WIDTH
        first, number = groups_of(block, k)
        for group in range(first, first + number):
            on = WIDTH * (group if group < whole else group - whole)
            angle, node = angles + on, nodes + min(on, last_node)
            c, s = load(cos, angle), load(sin, angle)
            gap, approach = gap_and_approach(motion, load(drawn, node) + load(lift, angle), c, s)
            reference = reference_of(v_min, approach, load(entry_velocity, node))
            position = shifts + scales * gap
            inside = above(position, zero, position, zero)
            interval = floor(above(last_one, inside, inside, last_one))
            around, along = _wave(motion.around, c, s), _wave(motion.along, c, s)
            square = around * around + along * along
            root = square_root(square + least_square)
            inverse = one / (reference * root)  # one division for two
            per_speed = reference * inverse
            store(block, at + COSINE, c)
            store(block, at + SINE, s)
            store_places(block, at + NUMBER, interval)
            store(block, at + FRACTION, position - interval)
            store(block, at + RATIO, approach * (root * inverse))
            store(block, at + AROUND_UNIT, per_speed * around)
            store(block, at + ALONG_UNIT, per_speed * along)
            if purpose == DERIVATIVES:
                # Without memory and faster than the least velocity, the ratio is ±1 whatever the speed.
                known, slow = (
                    above(load(entry_velocity, node), zero, one, zero),
                    above(v_min, absolute(approach), one, zero),
                )
                store(block, at + FOLLOWING, above(known + slow, zero, root * inverse, zero))
                store(block, at + PER_SPEED, per_speed)
            if purpose == REPORT:
                store(block, at + POSITION, position)
                store(block, at + APPROACH, approach)
                store(block, at + SQUARE, square)
                store(block, at + DRAG_SPEED, per_speed * square)
            at += STRIDE
    return at


@kernel
def fill_pressures(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, end: int, purpose: float
) -> None:
    """Fill the pressures of the groups up to ``end``, and what else the ``purpose`` needs."""
    first, last, block = surface.first_interval, surface.last_interval, memory.block
    cubics, energy, step = data.cubics[8 * first : 8 * last], data.energy[first:last], surface.inverse_step
    least, width = spread(0.0 if surface.tensile_clip > 0.0 else -1.0e300), spread(1.0 / step)
    half, third, quarter = spread(0.5), spread(1.0 / 3.0), spread(0.25)
    two, three, slope, zero = spread(2.0), spread(3.0), spread(step / surface.roughness), zeros()
    for at in range(BLOCK_GROUPS, end, STRIDE):
        x = load(block, at + FRACTION)
        k_0, k_1, k_2, k_3, c_0, c_1, c_2, c_3 = rows_at(cubics, block, at + NUMBER)
        rigid, damping = k_0 + x * (k_1 + x * (k_2 + x * k_3)), c_0 + x * (c_1 + x * (c_2 + x * c_3))
        whole = rigid + damping * load(block, at + RATIO)
        store(block, at + PRESSURE, above(least, whole, least, whole))  # this way round for NaN
        if purpose == DERIVATIVES:
            stiffness = k_1 + x * (two * k_2 + x * (three * k_3))
            stiffness += load(block, at + RATIO) * (c_1 + x * (two * c_2 + x * (three * c_3)))
            resistance = damping * load(block, at + FOLLOWING)
            store(block, at + STIFFNESS, above(least, whole, zero, slope * stiffness))
            store(block, at + RESISTANCE, above(least, whole, zero, resistance))
        if purpose == REPORT:  # the energy as ``lookup.stored_energy`` has it
            k_1, k_2, k_3 = half * k_1, third * k_2, quarter * k_3
            left = k_0 + (k_1 + (k_2 + k_3)) - x * (k_0 + x * (k_1 + x * (k_2 + x * k_3)))
            store(block, at + RIGID, rigid)
            store(block, at + ENERGY, entries_at(energy, block, at + NUMBER) + width * left)
