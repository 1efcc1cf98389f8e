"""Loads on the vane beside those of the paper: tables, maps, vane passing and surge, as terms for kernels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from tribodyn.cases.beyond import lasts_a_cycle
from tribodyn.core.signals import Signal, for_each_cycle, pulse, scaled, sinusoid
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
    from tribodyn.papers.cheng_2022.reduced.actions import VaneLoad
    from tribodyn.papers.cheng_2022.reduced.case import VsvCase

_TARGETS: Final = {"force_x": AIR_X, "force_y": AIR_Y, "force_z": AIR_Z, "moment": AIR_M}
_BENDS: Final = {"force_x": BEND_Y, "force_y": BEND_X}
"""What a force does about the centre of the vane where its line of action lies beside it."""


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
    of, arm = {"times": TIME, "angles": VANE if load.along == "vane" else CRANK_ANGLE}, load.arm
    for key, signal in load.given.items():
        for product in signal.products():
            (first, follows), *others = ((_over_run(case, found, over), of[over]) for found, over in product)
            yield Term(_TARGETS[key], ((first, follows), *others), load.against_motion)
            if arm is not None and key in _BENDS:
                bending = scaled(first, arm - vane_arm)
                yield Term(_BENDS[key], ((bending, follows), *others), load.against_motion)


def _over_run(case: VsvCase, signal: Signal, over: str) -> Signal:
    """Return a signal as it holds over the whole run."""
    again = over == "times" and lasts_a_cycle(signal.knots.tolist(), case.period)
    return for_each_cycle(signal, case.period, case.duration) if again else signal
