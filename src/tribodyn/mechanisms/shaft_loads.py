"""Loads of a case as the terms that kernels add up."""

import math
from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from tribodyn.cases.beyond import lasts_a_cycle
from tribodyn.cases.loads import BodyLoad
from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal, for_each_cycle, scaled, sinusoid
from tribodyn.mechanisms.action_intervals import Factors, Term

Targets = Mapping[int, tuple[int, float]]
"""Number and sign of the load that a component is: 0 to 2 of the force, 3 to 5 of the right-handed moment."""
_LATERAL: Final = np.array([1.0, 1.0, 0.0] * 2)


def parts_of(
    load: BodyLoad, coordinates: Mapping[str, int], period: float | None, duration: float
) -> Iterator[tuple[FloatArray, Factors]]:
    """Yield components of force and moment, shape (6,), and the signals whose product multiplies them.

    Parameters
    ----------
    load
        The load.
    coordinates
        Numbers of what signals follow, by the names that tables have for them.
    period
        Time after which a table over time of that length repeats [s]; None where none does.
    duration
        Of the run [s].
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

    Parameters
    ----------
    parts
        From :func:`parts_of`.
    targets
        Where components go; those that are missing do nothing.
    arm
        From the centre of the shaft to where forces act, in the axes of the shaft [m], shape (3,).
    angle
        Number of the angle by which the shaft turns.
    follower
        Whether the load turns with it, or is fixed in space.
    against
        Whether the load opposes the motion.
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
