"""Errors of outputs at chosen angles or positions of a drive, or times of its cycle."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.output_keys import Instant

PASSES: Final = {"error_at": 0.0, "error_at_forward": 1.0, "error_at_backward": -1.0}
"""Direction in which the drive passes, by the variable of the result; zero for both together."""
_ROUNDING: Final = 1e-9
_TURN: Final = 2.0 * math.pi


def errors_at(
    instants: Sequence[Instant],
    times: FloatArray,
    error: Mapping[str, FloatArray],
    drive: Callable[[Instant], FloatArray],
    period: float,
) -> dict[str, FloatArray]:
    """Return the mean errors at instants by variable of the result, each of shape (n_instants,).

    Of several cycles the first is left out, in which the start dies away.

    Parameters
    ----------
    instants
        Where errors are read.
    times
        Rising [s], shape (n_t,).
    error
        Of each output by its name, shape (n_t,).
    drive
        Returns the coordinate that an instant counts over time [rad or m], shape (n_t,).
    period
        Of the cycle [s]; infinite where there is none.

    Returns
    -------
    dict
        NaN where the drive does not pass, or not in that direction; of a drive that passes in one direction
        only, and of times, what both directions give together.
    """
    found = {name: np.full(len(instants), np.nan) for name in PASSES}
    if times.size < 2:
        return found
    begin = period if times[-1] >= (2.0 - _ROUNDING) * period else times[0]
    used = times >= begin - _ROUNDING * (times[-1] - times[0])
    for k, instant in enumerate(instants):
        values = error[instant.output][used]
        if instant.kind == "time":
            when = _of_cycles(times[used], instant.value, period)
            senses = np.zeros(when.size)
        else:
            when, senses = passes(
                times[used], drive(instant)[used], instant.value, turns=instant.kind == "angle"
            )
        read = np.interp(when, times[used], values)
        both = np.any(senses > 0.0) and np.any(senses < 0.0)
        for name, sense in PASSES.items():
            chosen = read[(senses == sense) | (sense == 0.0)]
            if chosen.size and (both or sense == 0.0):
                found[name][k] = chosen.mean()
    return found


def passes(
    times: FloatArray, coordinate: FloatArray, value: float, *, turns: bool
) -> tuple[FloatArray, FloatArray]:
    """Return the times at which a coordinate passes a value [s], and directions: 1, −1, or 0 for a return.

    Parameters
    ----------
    times
        Rising [s], shape (n_t,).
    coordinate
        Over these, shape (n_t,).
    value
        To be passed.
    turns
        Whether values that differ by whole turns are the same.
    """
    least, most = float(coordinate.min()), float(coordinate.max())
    room = _ROUNDING * max(most - least, abs(least), abs(most))
    first, last = (math.ceil((least - room - value) / _TURN), math.floor((most + room - value) / _TURN))
    levels = value + _TURN * np.arange(first, last + 1) if turns else np.array([value])
    found = [_met(times, coordinate - level, room) for level in levels]
    when, senses = (np.concatenate([np.empty(0), *(pair[i] for pair in found)]) for i in range(2))
    return when, senses


def _met(times: FloatArray, off: FloatArray, room: float) -> tuple[FloatArray, FloatArray]:
    """Return the zeros of values, with the sign of their rate; of a stay within ``room`` the beginning."""
    near = np.abs(off) <= room
    comes = np.flatnonzero(near & ~np.append(False, near[:-1]))
    before, after = off[np.maximum(comes - 1, 0)], off[np.minimum(comes + 1, off.size - 1)]
    crosses = np.flatnonzero((off[:-1] * off[1:] < 0.0) & ~near[:-1] & ~near[1:])
    steps = off[crosses + 1] - off[crosses]
    between = times[crosses] - off[crosses] * (times[crosses + 1] - times[crosses]) / steps
    return np.append(times[comes], between), np.append(np.sign(after - before), np.sign(steps))


def _of_cycles(times: FloatArray, value: float, period: float) -> FloatArray:
    """Return a time of the cycle in each of the cycles that are there [s]."""
    room = _ROUNDING * (times[-1] - times[0])
    if math.isinf(period):
        found = np.array([value])
    else:
        first = math.ceil((times[0] - room - value) / period)
        found = value + period * np.arange(first, math.floor((times[-1] + room - value) / period) + 1)
    return np.asarray(found[(found >= times[0] - room) & (found <= times[-1] + room)])
