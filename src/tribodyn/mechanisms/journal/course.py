"""When a journal reverses and where tables kink: the instants at which an integration restarts."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal, constant
from tribodyn.kernels.journal.data import TIME, TURNED
from tribodyn.mechanisms.actions import crossings, inside, kinks_over, segments_of
from tribodyn.mechanisms.journal.parameters import Journal


def course(journal: Journal, duration: float) -> Any:
    """Return the segments of a run of ``duration`` [s] as kernels read them; one of a run without end."""
    spin = constant(journal.speed) if journal.spin is None else journal.spin
    of_time = np.union1d(kinks_over(journal.terms, TIME, np.zeros(1)), spin.kinks)
    if not math.isfinite(duration):
        return segments_of(np.empty(0), np.sign(_speed(spin, np.zeros(1))), of_time)
    ends = np.concatenate([[0.0], inside(np.append(_reversals(spin), spin.kinks), duration), [duration]])
    of_angle = kinks_over(journal.terms, TURNED, angle(spin, ends))
    met = crossings(lambda t: angle(spin, t), ends, of_angle)
    breaks = inside(np.concatenate([ends, of_time, met]), duration)
    ends = np.concatenate([[0.0], breaks, [duration]])
    middles = 0.5 * (ends[:-1] + ends[1:])
    others = [(angle(spin, middles), of_angle)]
    return segments_of(breaks, np.sign(_speed(spin, middles)), of_time, others)


def _speed(spin: Signal, times: FloatArray) -> FloatArray:
    """Return the speed of rotation [rad/s] at times [s]; a table's ends hold beyond it."""
    from scipy.interpolate import PPoly

    if not spin.knots.size:
        return np.full(times.shape, spin.coefficients[0])
    within = np.clip(times, spin.knots[0], spin.knots[-1])
    return np.asarray(PPoly(spin.coefficients, spin.knots)(within))


def angle(spin: Signal, times: FloatArray) -> FloatArray:
    """Return the angle of rotation since the start [rad] at times [s]."""
    from scipy.interpolate import PPoly

    if not spin.knots.size:
        return np.asarray(spin.coefficients[0] * times)
    turned = PPoly(spin.coefficients, spin.knots).antiderivative()
    within = np.clip(times, spin.knots[0], spin.knots[-1])
    return np.asarray(turned(within) - turned(0.0) + (times - within) * _speed(spin, times))


def _reversals(spin: Signal) -> FloatArray:
    """Return the times at which a table's speed is zero [s]."""
    from scipy.interpolate import PPoly

    if not spin.knots.size:
        return np.empty(0)
    found = PPoly(spin.coefficients, spin.knots).roots(extrapolate=False)
    return np.asarray(found[np.isfinite(found)])
