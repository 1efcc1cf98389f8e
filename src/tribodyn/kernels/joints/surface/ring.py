"""Rows of nodes at equal angles around the axis, four nodes at a time.

On a surface of revolution, what a node needs of the motion is a + b cos θ + c sin θ with numbers that the
nodes of a row share: gap without wear, approach speed, slip around the axis and slip along the profile. With
the normal n = (n_r cos θ, n_r sin θ, n_z) at the radius R and the height z, and the directions

    e = (−sin θ, cos θ, 0),    n × e = (−n_z cos θ, −n_z sin θ, n_r)

of the two slips, x × n = (z n_r − R n_z) e. The second-order term of the tilt has the slope of the axis
w = φ_y cos θ − φ_x sin θ, see ``tilt``.

A window of contact is widened to whole groups of four nodes: out of reach there is no pressure. Where the
number of nodes is not a multiple of four, the last group repeats some, which the table of angles lifts out of
reach.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined
from tribodyn.kernels.joints.surface.data import AREA, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.nodes import ring_window
from tribodyn.kernels.joints.surface.wrench import slip_square
from tribodyn.kernels.lanes import WIDTH, above, absolute, entries, floor, rows, spread, total, zeros

Wave = tuple[Any, Any, Any]
"""a, b and c of a + b cos θ + c sin θ, each in all lanes."""


Pressures = tuple[Any, Any, Any, Any, Any]
Tractions = tuple[Any, Any, Any, Any, Any, Any]


class Law(NamedTuple):
    """Constants of the contact law of a surface, in all lanes but for the coefficients of its table.

    Attributes
    ----------
    cubics
        Coefficients of the table.
    step, scale, shift, last
        Width of an interval of the table [1], intervals per gap [1/m], those below a gap of zero, number
        of the last one.
    v_min, least, square
        Least entry velocity [m/s], least pressure [Pa], and u_s² [m²/s²].
    """

    cubics: FloatArray
    step: Any
    scale: Any
    shift: Any
    last: Any
    v_min: Any
    least: Any
    square: Any


class RingMotion(NamedTuple):
    """What the nodes of a row share: see above; ``lean`` is ρ n_r² [m], ``slope`` that of the axis."""

    gap: Wave
    approach: Wave
    around: Wave
    along: Wave
    lean: Any
    slope: tuple[Any, Any]
    slope_rate: tuple[Any, Any]


class Node(NamedTuple):
    """Four nodes: place in the table of the contact law, its coefficients, δ̇₋ [m/s], P_k, C and P_c [Pa]."""

    position: Any
    number: Any
    x: Any
    table: Any
    reference: Any
    rigid: Any
    damping: Any
    pressure: Any


@inlined
def law_of(data: SurfaceData, surface: Record) -> Law:
    """Return the law of a surface."""
    first, last = surface.first_interval, surface.last_interval
    return Law(
        data.cubics[8 * first : 8 * last],
        spread(1.0 / surface.inverse_step),
        spread(surface.inverse_step / surface.roughness),
        spread(1.0 - surface.h_first * surface.inverse_step),
        spread(float(last - first - 1)),
        spread(surface.minimum_entry_velocity),
        spread(0.0 if surface.tensile_clip > 0.0 else -1.0e300),
        spread(slip_square(surface)),
    )


@inlined
def _spread(a: float, b: float, c: float) -> Wave:
    return spread(a), spread(b), spread(c)


@inlined
def wave(numbers: Wave, c: Any, s: Any) -> Any:
    """Return a + b cos θ + c sin θ."""
    return numbers[0] + numbers[1] * c + numbers[2] * s


@inlined
def motion_of(data: SurfaceData, surface: Record, row: Record, station: Record, tilt: Record) -> RingMotion:
    """Return what the motion of the shaft is to the nodes of a row."""
    n_r, n_z, arm = row.normal[0], row.normal[2], row.arm
    radius, z = data.nodes[POSITION, row.first], data.nodes[POSITION + 2, row.first]
    d, v, phi, rate, w = station.d, station.v, tilt.phi, tilt.rate, station.w
    slip_x, slip_y = station.slip[0] + w[1] * z, station.slip[1] - w[0] * z
    both = surface.along
    return RingMotion(
        _spread(station.opening - n_z * d[2], -(n_r * d[0] + arm * phi[1]), -(n_r * d[1] - arm * phi[0])),
        _spread(n_z * v[2] - station.v_opening, n_r * v[0] + arm * rate[1], n_r * v[1] - arm * rate[0]),
        _spread(w[2] * radius, slip_y, -slip_x),
        _spread(
            both * n_r * station.slip[2],
            -both * (n_r * radius * w[1] + n_z * slip_x),
            both * (n_r * radius * w[0] - n_z * slip_y),
        ),
        spread(surface.lean * n_r * n_r),
        (spread(phi[1]), spread(-phi[0])),
        (spread(rate[1]), spread(-rate[0])),
    )


@inlined
def groups(row: Record, surface: Record, station: Record, tilt: Record, limit: float) -> tuple[int, int]:
    """Return the first group of four nodes and the number of groups that hold every gap below ``limit`` [m].

    The groups may go on at the first one of the row.
    """
    first, count = ring_window(row, surface.lean, station, tilt.phi, limit)
    if count == 0:
        return 0, 0
    begin, until = first // WIDTH, min(first + count, row.count)
    end = (until + WIDTH - 1) // WIDTH
    return begin, end - begin + min((first + count - until + WIDTH - 1) // WIDTH, begin)


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


@inlined
def gap_and_approach(motion: RingMotion, gap: Any, c: Any, s: Any) -> tuple[Any, Any]:
    """Return the gap [m] and the approach speed [m/s] from the gap as drawn, with wear."""
    w = motion.slope[0] * c + motion.slope[1] * s
    rate = motion.slope_rate[0] * c + motion.slope_rate[1] * s
    bent = motion.lean * w
    return gap + wave(motion.gap, c, s) - spread(0.5) * bent * w, wave(motion.approach, c, s) + bent * rate


@inlined
def reference_of(v_min: Any, approach: Any, entry: Any) -> Any:
    """Return the reference velocity [m/s], as ``pressure.reference_velocity`` does."""
    speed = absolute(approach)
    return above(entry, zeros(), entry, above(speed, v_min, speed, v_min))


@inlined
def node_of(law: Law, gap: Any, approach: Any, entry: Any) -> Node:
    """Return what the contact law makes of gap, approach speed and remembered entry velocity."""
    zero, position = zeros(), law.shift + law.scale * gap
    inside = above(position, zero, position, zero)
    number = floor(above(law.last, inside, inside, law.last))
    x, table = position - number, rows(law.cubics, number)
    k_0, k_1, k_2, k_3, c_0, c_1, c_2, c_3 = table
    rigid, damping = k_0 + x * (k_1 + x * (k_2 + x * k_3)), c_0 + x * (c_1 + x * (c_2 + x * c_3))
    reference = reference_of(law.v_min, approach, entry)
    whole = rigid + damping * (approach / reference)
    pressure = above(law.least, whole, law.least, whole)  # this way round for NaN
    return Node(position, number, x, table, reference, rigid, damping, pressure)


@inlined
def energy_of(law: Law, energy: FloatArray, node: Node) -> Any:
    """Return the stored energy over σ [Pa] from those at the nodes of the table: ``lookup.stored_energy``."""
    k_0, k_1, k_2, k_3 = node.table[0], node.table[1], node.table[2], node.table[3]
    half, third, quarter, x = spread(0.5), spread(1.0 / 3.0), spread(0.25), node.x
    below = x * (k_0 + x * (half * k_1 + x * (third * k_2 + x * (quarter * k_3))))
    whole = k_0 + (half * k_1 + (third * k_2 + quarter * k_3))
    return entries(energy, node.number) + law.step * (whole - below)


@inlined
def slip_of(motion: RingMotion, c: Any, s: Any) -> tuple[Any, Any, Any]:
    """Return the slip around the axis and along the profile [m/s], and its square."""
    around, along = wave(motion.around, c, s), wave(motion.along, c, s)
    return around, along, around * around + along * along


@inlined
def no_pressure() -> Pressures:
    """Return empty sums of pressures."""
    return zeros(), zeros(), zeros(), zeros(), zeros()


@inlined
def with_pressure(sums: Pressures, p: Any, c: Any, s: Any) -> Pressures:
    """Return the sums of p (1, c, s, c c, c s) with those of four more nodes."""
    p_c = p * c
    return sums[0] + p, sums[1] + p_c, sums[2] + p * s, sums[3] + p_c * c, sums[4] + p_c * s


@inlined
def no_traction() -> Tractions:
    """Return empty sums of tractions."""
    return zeros(), zeros(), zeros(), zeros(), zeros(), zeros()


@inlined
def with_traction(sums: Tractions, t: Any, b: Any, c: Any, s: Any) -> Tractions:
    """Return the sums of tractions t around and b along (1, c, s) with those of four more nodes."""
    t_1, t_c, t_s, b_1, b_c, b_s = sums
    return t_1 + t, t_c + t * c, t_s + t * s, b_1 + b, b_c + b * c, b_s + b * s


@inlined
def add_pressures(
    data: SurfaceData, surface: Record, row: Record, phi: FloatArray, sums: Pressures, out: FloatArray
) -> None:
    """Add force and moment of the pressures of a row to ``out`` (6,)."""
    p, p_c, p_s, p_cc, p_cs = total(sums[0]), total(sums[1]), total(sums[2]), total(sums[3]), total(sums[4])
    area, n_r, n_z, arm = data.nodes[AREA, row.first], row.normal[0], row.normal[2], row.arm
    bent = surface.lean * n_r * n_r
    out[0] -= area * n_r * p_c
    out[1] -= area * n_r * p_s
    out[2] -= area * n_z * p
    out[3] += area * (arm * p_s + bent * (phi[1] * p_cs - phi[0] * (p - p_cc)))
    out[4] -= area * (arm * p_c + bent * (phi[1] * p_cc - phi[0] * p_cs))


@inlined
def add_friction(
    data: SurfaceData,
    surface: Record,
    row: Record,
    direction: float,
    pressures: Pressures,
    tractions: Tractions,
    out: FloatArray,
) -> None:
    """Add force and moment of friction on a row to ``out`` (6,), from tractions given over −μ."""
    factor = -surface.friction_coefficient * data.nodes[AREA, row.first]
    if surface.torque_radius > 0.0:
        out[5] += factor * direction * surface.torque_radius * total(pressures[0])
        return
    t, t_c, t_s = total(tractions[0]), total(tractions[1]), total(tractions[2])
    b, b_c, b_s = total(tractions[3]), total(tractions[4]), total(tractions[5])
    n_r, n_z = row.normal[0], row.normal[2]
    radius, z = data.nodes[POSITION, row.first], data.nodes[POSITION + 2, row.first]
    lever = radius * n_r + z * n_z
    out[0] -= factor * (t_s + n_z * b_c)
    out[1] += factor * (t_c - n_z * b_s)
    out[2] += factor * n_r * b
    out[3] += factor * (lever * b_s - z * t_c)
    out[4] -= factor * (z * t_s + lever * b_c)
    out[5] += factor * radius * t
