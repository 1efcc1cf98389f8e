"""Loads that follow time or coordinates, and the segments of a run between the instants at which they kink.

A load is a sum of terms; a term is a signal, or a product of two: with one over each, products make a map
over two coordinates. In each segment the mechanism moves one way and every coordinate stays between two
kinks, so that trial states beyond them go on with the polynomial of this side.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.signals import Signals, evaluate

NONE: Final = -1
"""Number of a signal that is not there."""
N_OVER: Final = 3
TIME: Final = 0
"""Coordinates that signals may follow; the first is time."""

Term: Final = record_type(("target", "i8"), ("signals", "i8", (2,)), ("over", "i8", (2,)), ("against", "i8"))
"""A term of a load: to which component it adds, numbers of its one or two signals and of the coordinates that
they follow, and 1 where it opposes the motion."""

Segment: Final = record_type(
    ("begin", "f8"), ("direction", "f8"), ("low", "f8", (N_OVER,)), ("high", "f8", (N_OVER,))
)
"""A part of a run without kinks: when it begins [s], the direction of motion (1, -1, or 0 at rest), and where
each coordinate stays."""


class Actions(NamedTuple):
    """What moves and loads a mechanism.

    Attributes
    ----------
    signals
        All of them.
    terms, segments
        Records named above, the latter in the order of time; one segment at least.
    """

    signals: Signals
    terms: Any
    segments: Any


@kernel
def held(segment: Record, k: int, x: float) -> float:
    """Return the coordinate ``x``, number ``k``, or the end of its segment that it lies beyond."""
    return min(max(x, segment.low[k]), segment.high[k])


@kernel
def add_terms(
    actions: Actions, segment: Record, direction: float, over: FloatArray, loads: FloatArray
) -> None:
    """Add all terms to ``loads``.

    Parameters
    ----------
    actions
        Terms and signals.
    segment
        What holds now.
    direction
        Of the motion that some terms oppose.
    over
        Coordinates that signals follow, shape (N_OVER,).
    loads
        Components, as the mechanism counts them.
    """
    terms = actions.terms
    for i in range(terms.size):
        term = terms[i]
        value = -direction if term.against == 1 else 1.0
        for k in range(2):
            if term.signals[k] != NONE:
                x = over[term.over[k]]
                found, _, _ = evaluate(actions.signals, term.signals[k], x, held(segment, term.over[k], x))
                value *= found
        loads[term.target] += value


@kernel
def add_over_time(
    actions: Actions, segment: Record, direction: float, over: FloatArray, loads: FloatArray
) -> None:
    """Add the terms that follow time to ``loads[0]`` and what time alone changes in them to ``loads[1]``.

    Arguments are those of :func:`add_terms`, but for ``loads`` of shape (2, n), the second row per second.
    """
    terms = actions.terms
    for i in range(terms.size):
        term = terms[i]
        value, rate, follows = -direction if term.against == 1 else 1.0, 0.0, False
        for k in range(2):
            if term.signals[k] != NONE:
                along = term.over[k]
                x = over[along]
                found, slope, _ = evaluate(actions.signals, term.signals[k], x, held(segment, along, x))
                rate = rate * found + (value * slope if along == TIME else 0.0)
                value, follows = value * found, follows or along == TIME
        if follows:
            loads[0, term.target] += value
            loads[1, term.target] += rate


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
