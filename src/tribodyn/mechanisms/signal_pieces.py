"""Signals as the pieces that kernels evaluate, and their integrals over time."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.signals import Signal
from tribodyn.kernels import actions as kinds
from tribodyn.kernels.jit import new_records

NO_KINKS: Final = np.empty(0)
_SAME: Final = 1.0e-12  #: Share of a time by which two instants may differ that are one but for rounding.


@dataclass(frozen=True)
class Pieces:
    """A signal between breaks."""

    #: Where each piece ends and what its polynomial is over the distance from, shape (n,).
    until: FloatArray
    left: FloatArray
    polynomial: FloatArray  #: Rising powers, shape (n, 5).
    sine: tuple[float, float, float]  #: Amplitude, angular frequency and phase of a sine beside it.
    #: Distance after which the pieces repeat, which begin at the first ``left``; zero for none.
    period: float = 0.0


def pieces_of(signal: Signal) -> Pieces:
    """Return the pieces of a signal; beyond a table that does not repeat its first and last value hold."""
    if signal.kind != "table":
        c = signal.coefficients
        sine = (float(c[1]), float(c[2]), float(c[3])) if signal.kind == "sinusoid" else (0.0, 0.0, 0.0)
        return Pieces(np.array([np.inf]), np.zeros(1), _padded(c[None, :1]), sine)
    knots, inner = signal.knots, signal.coefficients.T[:, ::-1]
    wide = knots[1:] > knots[:-1]
    if signal.period:
        until, left = np.append(knots[1:-1][wide[:-1]], np.inf), knots[:-1][wide]
        return Pieces(until, left, _padded(inner[wide]), (0.0, 0.0, 0.0), signal.period)
    ends = np.array([inner[0, 0], _value(inner[-1], knots[-1] - knots[-2])])
    polynomial = np.vstack([_padded(ends[:1, None]), _padded(inner[wide]), _padded(ends[1:, None])])
    left = np.concatenate([[knots[0]], knots[:-1][wide], [knots[-1]]])
    until = np.concatenate([left[1:], [np.inf]])
    return Pieces(until, left, polynomial, (0.0, 0.0, 0.0))


def integral_of(pieces: Pieces) -> Pieces:
    """Return the integral over time, zero at t = 0."""
    polynomial = np.zeros_like(pieces.polynomial)
    polynomial[:, 1:] = pieces.polynomial[:, :-1] / np.arange(1.0, 5.0)
    for k in range(1, len(polynomial)):
        polynomial[k, 0] = _value(polynomial[k - 1], pieces.left[k] - pieces.left[k - 1])
    amplitude, frequency, phase = pieces.sine
    sine = (amplitude / frequency, frequency, phase - 0.5 * np.pi) if amplitude != 0.0 else (0.0, 0.0, 0.0)
    at_zero = int(np.searchsorted(pieces.until, 0.0, side="right"))
    start = _value(polynomial[at_zero], -pieces.left[at_zero]) + sine[0] * portable.sin(sine[2])
    polynomial[:, 0] -= start
    return Pieces(pieces.until, pieces.left, polynomial, sine)


def negated(pieces: Pieces) -> Pieces:
    """Return the same with the other sign."""
    amplitude, frequency, phase = pieces.sine
    return Pieces(pieces.until, pieces.left, -pieces.polynomial, (-amplitude, frequency, phase))


def _padded(polynomial: FloatArray) -> FloatArray:
    """Return polynomials with five coefficients."""
    found = np.zeros((len(polynomial), 5))
    found[:, : polynomial.shape[1]] = polynomial
    return found


def _value(polynomial: FloatArray, x: float) -> float:
    """Return the value of one polynomial."""
    return float(np.polynomial.polynomial.polyval(x, polynomial))


def backward(signals: kinds.Signals, numbers: Iterable[int]) -> kinds.Signals:
    """Return signals of which some run backward: at −x they have the value that they had at x.

    ``signals``: all of a mechanism; they stay as they are; ``numbers``: of those that follow time.
    """
    records, pieces = signals.signals.copy(), signals.pieces.copy()
    for number in numbers:
        signal = records[number]
        own = slice(signal.first, signal.first + signal.n)
        begin = signal.begin if signal.period > 0.0 else -np.inf
        starts = np.append(begin, pieces.until[own][:-1])
        pieces.until[own], pieces.left[own] = -starts[::-1], -pieces.left[own][::-1]
        pieces.c[own] = (pieces.c[own] * [1.0, -1.0, 1.0, -1.0, 1.0])[::-1]
        signal.sine[1] *= -1.0
        signal.begin = -(signal.begin + signal.period)
    return kinds.Signals(records, pieces, -signals.kinks[::-1])


def constant(signals: kinds.Signals, numbers: Iterable[int], places: FloatArray) -> kinds.Signals:
    """Return signals of which some are constant around places: each value holds halfway to the next.

    ``signals``: all of a mechanism; they stay as they are; ``numbers``: of those that follow time;
    ``places``: where their values are taken, rising, shape (n,).
    """
    records, pieces = signals.signals.copy(), [signals.pieces]
    until = np.append(0.5 * (places[1:] + places[:-1]), np.inf)
    for number in numbers:
        own = new_records(places.size, kinds.Piece)
        own.until = until
        own.c[:, 0] = [kinds.evaluate(signals, number, place, place)[0] for place in places.tolist()]
        signal = records[number]
        signal.first, signal.n = sum(part.size for part in pieces), places.size
        signal.sine[:] = signal.begin = signal.period = 0.0
        pieces.append(own)
    return kinds.Signals(records, np.concatenate(pieces).view(np.recarray), np.empty(0))


class SignalList:
    """The signals of a mechanism, numbered as they are added."""

    def __init__(self) -> None:
        self.all: list[Pieces] = []
        self.kinks: list[FloatArray] = []

    def add(self, pieces: Pieces, kinks: FloatArray = NO_KINKS) -> int:
        """Add a signal and return its number; ``kinks`` are times that kernels must know."""
        self.all.append(pieces)
        self.kinks.append(kinks)
        return len(self.all) - 1

    def records(self) -> kinds.Signals:
        """Return the data of the kernels: one signal and one piece at least."""
        signals = new_records(max(len(self.all), 1), kinds.Signal)
        pieces = new_records(max(sum(p.until.size for p in self.all), 1), kinds.Piece)
        first = 0
        for k, one in enumerate(self.all):
            last = first + one.until.size
            signals[k].first, signals[k].n, signals[k].sine[:] = first, one.until.size, one.sine
            signals[k].begin, signals[k].period = one.left[0], one.period
            pieces.until[first:last], pieces.left[first:last] = one.until, one.left
            pieces.c[first:last] = one.polynomial
            first = last
        kinks = np.unique(np.concatenate([np.zeros(0), *self.kinks]))
        apart = np.diff(kinks, prepend=-np.inf) > _SAME * np.abs(kinks)
        return kinds.Signals(signals, pieces, kinks[apart])
