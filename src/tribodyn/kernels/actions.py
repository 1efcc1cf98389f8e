"""Numbers that follow time or a coordinate, and the loads made of them: one evaluation for all mechanisms.

A load is a sum of terms; a term is a product of up to three signals. With a signal over each coordinate,
products make a map over two of them; a sine or cosine of an angle makes a force that is fixed in a body that
turns. A run is divided into segments at the instants at which loads kink. In each segment the mechanism moves
in one direction and every coordinate stays between two kinks, so that trial states beyond them go on with the
polynomial of this side.
"""

import math
from typing import Annotated, Any, Final, NamedTuple

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import cos, sin
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import entry, kernel

ROUNDING: Final = 1.0e-11  #: Share of a period before its end that counts as the beginning of the next.
#: Pieces of a polynomial, a sine beside it (amplitude, angular frequency, phase), and where the pieces begin
#: and after what distance they repeat; 0 for pieces that do not.
Signal: Final = record_type(
    ("first", "i8"), ("n", "i8"), ("sine", "f8", (3,)), ("begin", "f8"), ("period", "f8")
)
#: A polynomial over the distance from ``left``, rising powers, up to ``until``.
Piece: Final = record_type(("until", "f8"), ("left", "f8"), ("c", "f8", (5,)))


class Signals(NamedTuple):
    """Signals of drives and loads."""

    #: Records named above.
    signals: Annotated[Record, Signal, 1]
    pieces: Annotated[Record, Piece, 1]
    kinks: FloatArray  #: Times at which a table of time has a kink [s].


@entry
def evaluate(signals: Signals, number: int, x: float, within: float) -> tuple[float, float, float]:
    """Return the value of a signal at ``x`` and its first two derivatives.

    The piece is the one that holds at ``within``: stages beyond a kink go on with the piece before it.
    """
    signal, pieces = signals.signals[number], signals.pieces
    if signal.period > 0.0:
        shift = signal.period * math.floor((within - signal.begin) / signal.period + ROUNDING)
        x, within = x - shift, within - shift
    low, high = signal.first, signal.first + signal.n - 1
    while low < high:
        middle = (low + high) // 2
        if within < pieces[middle].until:
            high = middle
        else:
            low = middle + 1
    c, s = pieces[low].c, x - pieces[low].left
    value = c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4])))
    rate = c[1] + s * (2.0 * c[2] + s * (3.0 * c[3] + s * 4.0 * c[4]))
    second = 2.0 * c[2] + s * (6.0 * c[3] + s * 12.0 * c[4])
    amplitude, frequency = signal.sine[0], signal.sine[1]
    if amplitude != 0.0:
        phase = frequency * x + signal.sine[2]
        value += amplitude * sin(phase)
        rate += amplitude * frequency * cos(phase)
        second -= amplitude * frequency * frequency * sin(phase)
    return value, rate, second


NONE: Final = -1  #: Number of a signal that is not there.
N_FACTORS: Final = 3  #: Signals of a term at most.
N_OVER: Final = 5
TIME: Final = 0  #: Number of quantities that signals may follow at most; the first is time.

#: A term of a load: the component that it adds to, numbers of its signals (``NONE`` after the last) and of
#: the quantities that they follow, and 1 where it opposes the motion.
Term: Final = record_type(
    ("target", "i8"), ("signals", "i8", (N_FACTORS,)), ("over", "i8", (N_FACTORS,)), ("against", "i8")
)

#: A part of a run without kinks: when it begins [s], the direction of motion (1, -1, or 0 at rest), and where
#: each coordinate stays.
Segment: Final = record_type(
    ("begin", "f8"), ("direction", "f8"), ("low", "f8", (N_OVER,)), ("high", "f8", (N_OVER,))
)


class Actions(NamedTuple):
    """Drives and loads of a mechanism."""

    signals: Signals  #: All of them.
    #: Records named above, the latter in the order of time; one segment at least.
    terms: Annotated[Record, Term, 1]
    segments: Annotated[Record, Segment, 1]


@kernel
def held(segment: Record, k: int, x: float) -> float:
    """Return the coordinate ``x``, number ``k``, or the end of its segment that it lies beyond."""
    return min(max(x, segment.low[k]), segment.high[k])


@kernel
def follow(places: FloatArray, segment: Record, k: int, x: float) -> None:
    """Fill in ``places`` that quantity ``k`` is ``x``, and the value whose piece holds there."""
    places[k, 0], places[k, 1] = x, held(segment, k, x)


@kernel
def product(signals: Signals, term: Record, places: FloatArray, along: int) -> tuple[float, float]:
    """Return the product of the signals of a term, and its derivative in the quantity ``along``."""
    value, rate = 1.0, 0.0
    for k in range(N_FACTORS):
        if term.signals[k] != NONE:
            over = term.over[k]
            found, slope, _ = evaluate(signals, term.signals[k], places[over, 0], places[over, 1])
            rate = rate * found + (value * slope if over == along else 0.0)
            value *= found
    return value, rate


@kernel
def add_terms(
    signals: Signals,
    terms: Any,
    first: int,
    last: int,
    direction: float,
    places: FloatArray,
    loads: FloatArray,
) -> None:
    """Add the terms ``first`` to ``last`` to the components ``loads``, as the mechanism counts them.

    ``direction`` is that of the motion that some oppose; ``places`` (n, 2) hold of each quantity that signals
    follow its value, and the value whose piece holds.
    """
    for i in range(first, last):
        value, _ = product(signals, terms[i], places, NONE)
        loads[terms[i].target] += -direction * value if terms[i].against == 1 else value


@kernel
def add_following(
    signals: Signals,
    terms: Any,
    first: int,
    last: int,
    direction: float,
    along: int,
    places: FloatArray,
    loads: FloatArray,
) -> None:
    """Add the terms that follow the quantity ``along`` to ``loads[0]`` and their derivatives to ``loads[1]``.

    Arguments are those of :func:`add_terms`, but for ``loads`` of shape (2, n), the second row per unit of
    ``along``.
    """
    for i in range(first, last):
        term, follows = terms[i], False
        for k in range(N_FACTORS):
            follows = follows or (term.signals[k] != NONE and term.over[k] == along)
        if follows:
            value, rate = product(signals, term, places, along)
            sign = -direction if term.against == 1 else 1.0
            loads[0, term.target] += sign * value
            loads[1, term.target] += sign * rate


@kernel
def oppose(
    size: float, growth: float, u: FloatArray, slip: float, force: FloatArray, slope: FloatArray
) -> None:
    """Add a force of a given size [N] against a velocity (n,), and its derivative (n, n).

    F = −size u/√(u² + slip²), which is smooth through rest; ``growth`` is the derivative of its size in the
    speed [N s/m].
    """
    speed = norm(u)
    square = speed * speed + slip * slip
    if square == 0.0:
        square = 1.0
    root = math.sqrt(square)
    ratio, steeper = size / root, 0.0 if speed == 0.0 else growth / (speed * root)
    for i in range(u.size):
        force[i] -= ratio * u[i]
        for j in range(u.size):
            slope[i, j] += ratio * u[i] * u[j] / square - steeper * u[i] * u[j]
        slope[i, i] -= ratio


@kernel
def oppose_along(
    size: float,
    growth: float,
    line: FloatArray,
    u: FloatArray,
    slip: float,
    force: FloatArray,
    slope: FloatArray,
) -> None:
    """Add a force along a line against the part of a velocity along it.

    Arguments are those of :func:`oppose`; ``line`` is its unit vector, shape (n,).
    """
    speed = 0.0
    for i in range(u.size):
        speed += line[i] * u[i]
    square = speed * speed + slip * slip
    if square == 0.0:
        square = 1.0
    root = math.sqrt(square)
    push = -size * speed / root
    steepness = -size * slip * slip / square / root - growth * abs(speed) / root
    for i in range(u.size):
        force[i] += push * line[i]
        for j in range(u.size):
            slope[i, j] += steepness * line[i] * line[j]


@kernel
def norm(u: FloatArray) -> float:
    """Return the length of a vector."""
    square = 0.0
    for i in range(u.size):
        square += u[i] * u[i]
    return math.sqrt(square)


@kernel
def begin_segment(actions: Actions, t: float, segment: Record) -> bool:
    """Fill ``segment`` with what holds from ``t`` on and tell whether the direction of motion changes."""
    segments = actions.segments
    first, last = 0, segments.size - 1
    while first < last:
        middle = (first + last + 1) // 2
        if segments[middle].begin <= t:
            first = middle
        else:
            last = middle - 1
    now = segments[first]
    turned: bool = now.direction != segment.direction
    segment.begin, segment.direction = now.begin, now.direction
    for k in range(N_OVER):
        segment.low[k], segment.high[k] = now.low[k], now.high[k]
    return turned
