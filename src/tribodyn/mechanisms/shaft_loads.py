"""Loads of a case as the terms that kernels add up, and the segments between the kinks of tables."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.followed_tables import lasts_a_cycle
from tribodyn.cases.loads import BodyLoad
from tribodyn.core.signals import Signal, for_each_cycle, scaled, sinusoid
from tribodyn.kernels import actions as kinds
from tribodyn.kernels.actions import Actions
from tribodyn.kernels.jit import new_records
from tribodyn.mechanisms.signal_pieces import NO_KINKS, SignalList, pieces_of

TIME: Final = 0  #: The first of the coordinates that signals may follow.
#: Steps in a wave of a load, at least: a longer step may see its zeros alone. What a wave lends a shaft and
#: takes back is up to a hundred times what the contact turns into heat, so that a small delay of the steps
#: would show in the balance.
WAVE_STEPS: Final = 24
_SAME: Final = 1.0e-12  #: Instants closer than this share of a run are one.
_BEFORE: Final = 1.0e-9  #: Share of the way to a kink by which a segment ends before it.
_BISECTIONS: Final = 60

#: Signals that are multiplied, each with the number of the quantity that it follows.
Factors: TypeAlias = tuple[tuple[Signal, int], ...]


@dataclass(frozen=True)
class Term:
    """A part of a load."""

    target: int  #: Number of the component that it adds to.
    factors: Factors  #: Up to three signals.
    against: bool = False  #: Whether it opposes the motion.


def kinks_over(terms: Iterable[Term], over: int, reached: FloatArray) -> FloatArray:
    """Return the kinks of signals over one coordinate, increasing; ``reached`` holds values of it."""
    low, high = float(reached.min()), float(reached.max())
    factors = [factor for term in terms for factor in term.factors]
    found = [signal.kinks_within(low, high) for signal, follows in factors if follows == over]
    return np.unique(np.concatenate([np.empty(0), *found]))


def shortest_wave(terms: Iterable[Term]) -> float:
    """Return the shortest period of a sinusoid over time among some loads [s]; infinite without one."""
    waves = (s for term in terms for s, over in term.factors if over == TIME and s.kind == "sinusoid")
    return min((2.0 * math.pi / abs(s.coefficients[2]) for s in waves if s.coefficients[2]), default=math.inf)


def actions_of(signals: SignalList, terms: Sequence[Term], segments: Any) -> Actions:
    """Return the data of the kernels.

    ``signals``: those that the mechanism has numbered before; ``terms``: its loads from tables; ``segments``:
    from :func:`segments_of`.
    """
    records = term_records(signals, terms)
    return Actions(signals.records(), records, segments)


def term_records(signals: SignalList, terms: Sequence[Term]) -> Any:
    """Return terms as kernels read them, their signals numbered in the list, shape (n,)."""
    records = new_records(len(terms), kinds.Term)
    for record, term in zip(records, terms, strict=True):
        record.target, record.against = term.target, int(term.against)
        record.signals[:], record.over[:] = kinds.NONE, TIME
        for k, (signal, over) in enumerate(term.factors):
            of_time = signal.kinks if over == TIME else NO_KINKS
            record.signals[k], record.over[k] = signals.add(pieces_of(signal), of_time), over
    return records


def inside(times: FloatArray, duration: float) -> FloatArray:
    """Return the instants strictly inside a run of ``duration`` [s], each once, increasing."""
    times = np.unique(times)
    times = times[(times > 0.0) & (times < duration * (1.0 - _SAME))]
    apart = np.diff(times, prepend=0.0) > _SAME * duration
    return np.asarray(times[apart])


def crossings(
    coordinate: Callable[[FloatArray], FloatArray], turns: FloatArray, levels: FloatArray
) -> FloatArray:
    """Return the times at which a coordinate passes some values, shape (n,).

    ``coordinate``: its values at times [s]; ``turns``: times between which it grows or falls all the way,
    those of begin and end of the run among them.
    """
    at = coordinate(turns)
    level, begin, end = (
        np.broadcast_to(x, (levels.size, turns.size - 1)) for x in (levels[:, None], turns[:-1], turns[1:])
    )
    passed = (at[:-1] - level) * (at[1:] - level) < 0.0
    level, low, high = level[passed], begin[passed], end[passed]
    rising = np.broadcast_to(at[1:] > at[:-1], passed.shape)[passed]
    for _ in range(_BISECTIONS if level.size else 0):
        middle = 0.5 * (low + high)
        above = (coordinate(middle) > level) == rising
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return 0.5 * (low + high)


def segments_of(
    breaks: FloatArray,
    directions: FloatArray,
    time_kinks: FloatArray,
    others: Sequence[tuple[FloatArray, FloatArray]] = (),
) -> Any:
    """Return the segments of a run as kernels read them, shape (n,).

    ``breaks``: instants between segments [s], increasing, shape (n - 1,); ``directions``: direction of motion
    in each segment, shape (n,); ``time_kinks``: where signals over time kink, those beyond the run among them
    [s]; ``others``: of each other coordinate its values in the middle of the segments, shape (n,), and where
    signals over it kink.
    """
    segments = new_records(directions.size, kinds.Segment)
    segments.begin = np.concatenate([[0.0], breaks])
    segments.direction = directions
    segments.low[:], segments.high[:] = -np.inf, np.inf
    after = np.append(breaks, segments.begin[-1] + 1.0)
    middles = 0.5 * (segments.begin + after)
    middles[-1] = _just_after(segments.begin[-1], time_kinks)
    for k, (values, kinks) in enumerate([(middles, np.union1d(breaks, time_kinks)), *others]):
        ends = np.concatenate([[-np.inf], kinks, [np.inf]])
        place = np.searchsorted(ends, values, side="right")
        low, high = ends[place - 1], ends[np.minimum(place, ends.size - 1)]
        with np.errstate(invalid="ignore"):
            room = np.where(np.isfinite(high), _BEFORE * (high - np.maximum(low, values - 1.0)), 0.0)
        segments.low[:, k], segments.high[:, k] = low, high - room
    return segments


def _just_after(t: float, kinks: FloatArray) -> float:
    """Return a time after ``t`` [s] and before the next kink."""
    later = kinks[kinks > t]
    return float(0.5 * (t + later[0])) if later.size else t + 1.0


#: Number and sign of the load that a component is: 0 to 2 of the force, 3 to 5 of the right-handed moment.
Targets = Mapping[int, tuple[int, float]]
_LATERAL: Final = np.array([1.0, 1.0, 0.0] * 2)


def parts_of(
    load: BodyLoad, coordinates: Mapping[str, int], period: float | None, duration: float
) -> Iterator[tuple[FloatArray, Factors]]:
    """Yield components of force and moment, shape (6,), and the signals whose product multiplies them.

    ``coordinates``: numbers of what signals follow, by the names that tables have for them; ``period``: time
    after which a table over time of that length repeats [s]; None where none does; ``duration``: of the run
    [s].
    """
    for key, signal in load.given.items():
        cycle = signal.period if signal.cyclic else period if signal.pulse is None else None
        for product in signal.products():
            yield (
                np.array(load.shares(key)),
                tuple((over_run(found, over, cycle, duration), coordinates[over]) for found, over in product),
            )


def over_run(signal: Signal, over: str, period: float | None, duration: float) -> Signal:
    """Return a signal as it holds over the whole run."""
    again = over == "times" and lasts_a_cycle(signal.knots.tolist(), period)
    return for_each_cycle(signal, period or 0.0, duration) if again else signal


def term(target: int, share: float, factors: Factors, *, against: bool = False) -> Term:
    """Return a share of a product of signals as a term."""
    (first, follows), *others = factors
    return Term(target, ((scaled(first, share), follows), *others), against)


def shaft_terms(
    parts: Iterator[tuple[FloatArray, Factors]],
    targets: Targets,
    *,
    arm: FloatArray,
    angle: int,
    follower: bool,
    against: bool = False,
) -> Iterator[Term]:
    """Yield the terms of a load on a shaft that turns about Z.

    ``parts``: from :func:`parts_of`; ``targets``: where components go; those that are missing do nothing;
    ``arm``: from the centre of the shaft to where forces act, in the axes of the shaft [m], shape (3,);
    ``angle``: number of the angle by which the shaft turns; ``follower``: whether the load turns with it, or
    is fixed in space; ``against``: whether the load opposes the motion.
    """
    wave = {name: sinusoid(0.0, 1.0, 1.0, phase) for name, phase in (("cos", 0.5 * math.pi), ("sin", 0.0))}
    extra: tuple[Factors, ...] = ((), ((wave["cos"], angle),), ((wave["sin"], angle),))
    for vector, factors in parts:
        weights = _fixed_in_body(vector, arm) if follower else _fixed_in_space(vector, arm)
        for components, turning in zip(weights, extra, strict=True):
            for component in np.flatnonzero(components):
                if int(component) in targets:
                    target, sign = targets[int(component)]
                    share = sign * float(components[component])
                    yield term(target, share, (*factors, *turning), against=against)


def _fixed_in_body(vector: FloatArray, arm: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the wrench about the centre: constant, with the cosine, and with the sine of the angle."""
    wrench = vector + np.concatenate([np.zeros(3), np.cross(arm, vector[:3])])
    lateral = wrench * _LATERAL
    return wrench - lateral, lateral, _quarter_turned(lateral)


def _fixed_in_space(vector: FloatArray, arm: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the same of a force whose point turns with the shaft and whose direction does not."""
    force, nothing = vector[:3], np.zeros(3)
    lateral = arm * _LATERAL[:3]
    along, across = np.cross(arm - lateral, force), np.cross(lateral, force)
    turned = np.cross(_quarter_turned(np.append(lateral, nothing))[:3], force)
    return (
        vector + np.concatenate([nothing, along]),
        np.concatenate([nothing, across]),
        np.concatenate([nothing, turned]),
    )


def _quarter_turned(wrench: FloatArray) -> FloatArray:
    """Return lateral components turned by a right angle about Z."""
    return np.array([-wrench[1], wrench[0], 0.0, -wrench[4], wrench[3], 0.0])
