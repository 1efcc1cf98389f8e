"""Loads on the vane beside those of the paper: tables, maps, vane passing and surge, as terms for kernels."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from tribodyn.core.signals import Signal, pulse, repeated, scaled, sinusoid
from tribodyn.kernels.vsv.data import (
    AIR_M,
    AIR_X,
    AIR_Y,
    AIR_Z,
    BEND_X,
    BEND_Y,
    CRANK_ANGLE,
    TIME,
    VANE,
)
from tribodyn.mechanisms.actions import Term

if TYPE_CHECKING:
    from tribodyn.mechanisms.vsv.actions import VaneLoad
    from tribodyn.mechanisms.vsv.case import VsvCase

_TARGETS: Final = {"force_x": AIR_X, "force_y": AIR_Y, "force_z": AIR_Z, "moment": AIR_M}
_BENDS: Final = {"force_x": BEND_Y, "force_y": BEND_X}
"""What a force does about the centre of the vane where its line of action lies beside it."""
_SAME: Final = 1.0e-9


def terms_of(case: VsvCase, vane_arm: float) -> Iterator[Term]:
    """Yield the loads of a case from tables.

    Parameters
    ----------
    case
        The case.
    vane_arm
        From the trunnion centre down to the vane's centre [m].
    """
    for load in case.loads.more.values():
        yield from _of_table(case, load, vane_arm)
    for passing in case.loads.passing.values():
        for key, amplitude in passing.given.items():
            wave = sinusoid(0.0, amplitude, passing.order * passing.shaft_speed, passing.phase)
            yield Term(_TARGETS[key], ((wave, TIME),))
    for surge in case.loads.pulses.values():
        for key, height in surge.given.items():
            yield Term(_TARGETS[key], ((pulse(surge.begin, surge.length, height), TIME),))


def _of_table(case: VsvCase, load: VaneLoad, vane_arm: float) -> Iterator[Term]:
    """Yield the terms of one load."""
    over_angle, arm = VANE if load.along == "vane" else CRANK_ANGLE, load.arm
    for key, signal in load.given.items():
        for product in signal.products():
            (first, follows), *others = (
                (_cyclic(case, found), TIME) if over == "times" else (found, over_angle)
                for found, over in product
            )
            yield Term(_TARGETS[key], ((first, follows), *others), load.against_motion)
            if arm is not None and key in _BENDS:
                bending = scaled(first, arm - vane_arm)
                yield Term(_BENDS[key], ((bending, follows), *others), load.against_motion)


def _cyclic(case: VsvCase, signal: Signal) -> Signal:
    """Return a table over time that is as long as a drive cycle once for each cycle of the run."""
    if signal.kind != "table" or abs(signal.knots[-1] - case.period) > _SAME * case.period:
        return signal
    return repeated(signal, max(1, math.ceil(case.duration / case.period * (1.0 - _SAME))))
