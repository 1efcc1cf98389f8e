"""Numbers that follow time or a coordinate."""

import math
from typing import Annotated, Final, NamedTuple

from mebdf.kernels.elementary import cos, sin
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import entry

ROUNDING: Final = 1.0e-11
"""Share of a period before its end that counts as the beginning of the next."""
Signal: Final = record_type(
    ("first", "i8"), ("n", "i8"), ("sine", "f8", (3,)), ("begin", "f8"), ("period", "f8")
)
"""Pieces of a polynomial, a sine beside it (amplitude, angular frequency, phase), and where the pieces begin
and after what distance they repeat; 0 for pieces that do not."""
Piece: Final = record_type(("until", "f8"), ("left", "f8"), ("c", "f8", (5,)))
"""A polynomial over the distance from ``left``, rising powers, up to ``until``."""


class Signals(NamedTuple):
    """Signals of drives and loads.

    Attributes
    ----------
    signals, pieces
        Records named above.
    kinks
        Times at which a table of time has a kink [s].
    """

    signals: Annotated[Record, Signal, 1]
    pieces: Annotated[Record, Piece, 1]
    kinks: FloatArray


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
