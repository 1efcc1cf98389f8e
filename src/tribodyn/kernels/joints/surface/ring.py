"""Rows of nodes at equal angles around the axis, four nodes at a time.

On a surface of revolution, what a node needs of the motion is a + b cos θ + c sin θ with numbers that the
nodes of a row share: gap without wear, approach speed, slip around the axis and slip along the profile. With
the normal n = (n_r cos θ, n_r sin θ, n_z) at the radius R and the height z, and the directions

    e = (−sin θ, cos θ, 0),    n × e = (−n_z cos θ, −n_z sin θ, n_r)

of the two slips, x × n = (z n_r − R n_z) e. The second-order term of the tilt, see ``tilt``, adds
−½ ρ n_r² w² with w = φ_y cos θ − φ_x sin θ to the gap, and its rate to the approach speed.

Loops are short, so that a processor has many groups in hand at once: first what the motion is to the nodes,
then pressures, then sums. Between the first two and the last the groups of four rings are kept in columns.

A window of contact is widened to whole groups of four nodes: out of reach there is no pressure. Where the
number of nodes is not a multiple of four, the last group repeats some, which the table of angles lifts out of
reach.
"""

from typing import Any, Final, NamedTuple

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import ALONG, APPROACHING, AROUND, NEARING, groups_of, rings_from
from tribodyn.kernels.joints.surface.data import COS, GAP, LIFT, SIN, SurfaceData
from tribodyn.kernels.joints.surface.jacobian import slip_square
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, COLUMNS, SurfaceMemory
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

Wave = tuple[Any, Any, Any]  #: a, b and c of a + b cos θ + c sin θ, each in all lanes.
BentWave = tuple[Any, Any, Any, Any, Any]  #: And d and e of d cos² θ + e cos θ sin θ.

COSINE: Final = 0 * WIDTH
SINE: Final = 1 * WIDTH  #: Of θ.
NUMBER: Final = 2 * WIDTH
FRACTION: Final = 3 * WIDTH  #: Interval of the contact table, as ``store_places`` writes it, and place in it.
RATIO: Final = 4 * WIDTH  #: Approach speed over reference velocity.
AROUND_UNIT: Final = 5 * WIDTH
ALONG_UNIT: Final = 6 * WIDTH  #: Slips around and along over √(s² + u_s²).
PRESSURE: Final = 7 * WIDTH  #: P_c [Pa].
POSITION: Final = 8 * WIDTH
SPEED: Final = 9 * WIDTH
RIGID: Final = 10 * WIDTH
#: Of reports: place in the whole table, |s| [m/s] where slips count, P_k [Pa], the stored energy over σ [Pa].
ENERGY: Final = 11 * WIDTH
FOLLOWING: Final = 8 * WIDTH
PER_SPEED: Final = 9 * WIDTH
STIFFNESS: Final = 10 * WIDTH
#: Of derivatives: ∂/∂δ̇ of ``RATIO`` [s/m], 1/√(s² + u_s²) [s/m], ∂P_c/∂h [Pa/m] and ∂P_c/∂δ̇ [Pa s/m].
RESISTANCE: Final = 11 * WIDTH
STRIDE: Final = COLUMNS * WIDTH  #: Numbers of a group.
WRENCH: Final = 0.0
REPORT: Final = 1.0
DERIVATIVES: Final = 2.0  #: Purpose for which the groups are filled.


class RingMotion(NamedTuple):
    """Common data of the nodes of a row, see above."""

    gap: BentWave
    approach: BentWave
    around: Wave
    along: Wave


@inlined
def _wave_of(block: FloatArray, at: int) -> Wave:
    return spread(block[at]), spread(block[at + WIDTH]), spread(block[at + 2 * WIDTH])


@inlined
def _bent_wave_of(block: FloatArray, at: int) -> BentWave:
    a, b, c = _wave_of(block, at)
    return a, b, c, spread(block[at + 3 * WIDTH]), spread(block[at + 4 * WIDTH])


@inlined
def motion_of(block: FloatArray, k: int) -> RingMotion:
    """Return the motion of the shaft at the nodes of ring ``k`` of the block."""
    return RingMotion(
        _bent_wave_of(block, NEARING + k),
        _bent_wave_of(block, APPROACHING + k),
        _wave_of(block, AROUND + k),
        _wave_of(block, ALONG + k),
    )


@inlined
def _wave(numbers: Wave, c: Any, s: Any) -> Any:
    """Return a + b cos θ + c sin θ."""
    return numbers[0] + numbers[1] * c + numbers[2] * s


@inlined
def wave(numbers: BentWave, bends: float, c: Any, s: Any) -> Any:
    """Return the sum of a bent wave, of which d and e are left out where ``bends`` is 0."""
    if bends > 0.0:
        return numbers[0] + (numbers[1] + numbers[3] * c + numbers[4] * s) * c + numbers[2] * s
    return _wave(numbers[:3], c, s)


@inlined
def does_bend(surface: Record) -> float:
    """Return whether the tilt has a second-order term, 1 or 0."""
    return 1.0 if surface.lean != 0.0 else 0.0


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
    """Return the begin of a group in the table of angles and in arrays over all nodes."""
    whole = number_of_groups(row)
    at = WIDTH * (group if group < whole else group - whole)
    return row.angle + at, row.first + min(at, row.count - WIDTH)


@kernel
def fill_groups(data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, purpose: float) -> int:
    """Fill the motion at the nodes of a block, whose rings are filled; return the ends of groups.

    ``r`` is its first row; ``WRENCH``, ``REPORT`` and ``DERIVATIVES`` have columns of their own.
    """
    entry_velocity, block, at = memory.entry_velocity, memory.block, BLOCK_GROUPS
    cos, sin, lift, drawn = data.angles[COS], data.angles[SIN], data.angles[LIFT], data.nodes[GAP]
    zero, one, v_min = zeros(), spread(1.0), spread(surface.minimum_entry_velocity)
    scale, shift = surface.inverse_step / surface.roughness, 1.0 - surface.h_first * surface.inverse_step
    last, least = float(surface.last_interval - surface.first_interval - 1), slip_square(surface)
    bends, slides = does_bend(surface), surface.along != 0.0
    scales, shifts, last_one, least_square = spread(scale), spread(shift), spread(last), spread(least)
    for k in range(rings_from(surface, r)):
        row, motion = data.rows[r + k], motion_of(block, k)
        whole, angles, nodes, last_node = number_of_groups(row), row.angle, row.first, row.count - WIDTH
        first, number = groups_of(block, k)
        for group in range(first, first + number):
            on = WIDTH * (group if group < whole else group - whole)
            angle, node = angles + on, nodes + min(on, last_node)
            c, s = load(cos, angle), load(sin, angle)
            gap = load(drawn, node) + load(lift, angle) + wave(motion.gap, bends, c, s)
            approach = wave(motion.approach, bends, c, s)
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
                if slides:
                    store(block, at + SPEED, square_root(square))
            at += STRIDE
    return at


@inlined
def least_pressure(surface: Record) -> float:
    """Return the least pressure, zero or none [Pa]."""
    return 0.0 if surface.tensile_clip > 0.0 else -1.0e300


@kernel
def fill_pressures(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, end: int, purpose: float
) -> None:
    """Fill the pressures of the groups up to ``end``, and what else the ``purpose`` needs."""
    first, last, block = surface.first_interval, surface.last_interval, memory.block
    cubics, energy, step = data.cubics[8 * first : 8 * last], data.energy[first:last], surface.inverse_step
    least, most, width = spread(least_pressure(surface)), spread(surface.hardness), spread(1.0 / step)
    half, third, quarter = spread(0.5), spread(1.0 / 3.0), spread(0.25)
    two, three, slope, zero = spread(2.0), spread(3.0), spread(step / surface.roughness), zeros()
    for at in range(BLOCK_GROUPS, end, STRIDE):
        x = load(block, at + FRACTION)
        k_0, k_1, k_2, k_3, c_0, c_1, c_2, c_3 = rows_at(cubics, block, at + NUMBER)
        rigid, damping = k_0 + x * (k_1 + x * (k_2 + x * k_3)), c_0 + x * (c_1 + x * (c_2 + x * c_3))
        whole = rigid + damping * load(block, at + RATIO)
        bounded = above(least, whole, least, above(whole, most, most, whole))  # this way round for NaN
        store(block, at + PRESSURE, bounded)
        if purpose == DERIVATIVES:
            stiffness = k_1 + x * (two * k_2 + x * (three * k_3))
            stiffness += load(block, at + RATIO) * (c_1 + x * (two * c_2 + x * (three * c_3)))
            resistance = damping * load(block, at + FOLLOWING)
            store(
                block, at + STIFFNESS, above(least, whole, zero, above(whole, most, zero, slope * stiffness))
            )
            store(block, at + RESISTANCE, above(least, whole, zero, above(whole, most, zero, resistance)))
        if purpose == REPORT:  # the energy as ``lookup.stored_energy`` has it
            k_1, k_2, k_3 = half * k_1, third * k_2, quarter * k_3
            left = k_0 + (k_1 + (k_2 + k_3)) - x * (k_0 + x * (k_1 + x * (k_2 + x * k_3)))
            store(block, at + RIGID, rigid)
            store(block, at + ENERGY, entries_at(energy, block, at + NUMBER) + width * left)
