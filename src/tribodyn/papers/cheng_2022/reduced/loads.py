"""Loads on the vane beside those of the paper: tables, maps, vane passing and surge, as terms for kernels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

import numpy as np

from tribodyn.kernels.vsv import data as at
from tribodyn.mechanisms.shaft_loads import Term, parts_of, shaft_terms

if TYPE_CHECKING:
    from tribodyn.papers.cheng_2022.reduced.actions import VaneLoad
    from tribodyn.papers.cheng_2022.reduced.case import VsvCase

_TARGETS: Final = {
    0: (at.AIR_X, 1.0),
    1: (at.AIR_Y, 1.0),
    2: (at.AIR_Z, 1.0),
    3: (at.BEND_X, 1.0),
    4: (at.BEND_Y, -1.0),
    5: (at.AIR_M, 1.0),
}
_FOLLOWED: Final = {
    "vane": {"times": at.TIME, "angles": at.VANE, "speeds": at.VANE_SPEED},
    "crank": {"times": at.TIME, "angles": at.CRANK_ANGLE, "speeds": at.CRANK_SPEED},
}


def terms_of(case: VsvCase, vane_arm: float) -> Iterator[Term]:
    """Yield the loads of a case from tables.

    ``vane_arm``: from the trunnion centre down to the vane's centre [m].
    """
    loads = case.loads
    for load in (
        *loads.more.values(),
        *(gust.load for gust in (*loads.passing.values(), *loads.pulses.values())),
    ):
        yield from _of_table(case, load, vane_arm)


def _of_table(case: VsvCase, load: VaneLoad, vane_arm: float) -> Iterator[Term]:
    """Yield the terms of one load."""
    arm = np.zeros(3)
    if load.arm is not None:
        arm[2] = vane_arm - load.arm
    if load.point is not None:
        arm[:2] = load.point[:2]
    return shaft_terms(
        parts_of(load, _FOLLOWED[load.along], case.period, case.duration),
        _TARGETS,
        arm=arm,
        angle=at.VANE,
        follower=load.frame == "body",
        against=load.opposes,
    )
