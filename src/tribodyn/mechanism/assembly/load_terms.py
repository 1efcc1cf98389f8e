"""Loads of a mechanism as records and terms that kernels read."""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from tribodyn.cases.case import unit
from tribodyn.kernels.mechanism import data as kinds
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import COORDINATE_OF, LoadKeys
from tribodyn.mechanisms.action_intervals import Term
from tribodyn.mechanisms.shaft_loads import parts_of, term

_KINDS: Final = {"ground": kinds.LOAD_GROUND, "body": kinds.LOAD_BODY, "motion": kinds.LOAD_MOTION}
_FOLLOWED: Final = {
    "times": kinds.TIME,
    "angles": kinds.FOLLOWED,
    "positions": kinds.FOLLOWED,
    "speeds": kinds.FOLLOWED_SPEED,
    "velocities": kinds.FOLLOWED_SPEED,
}
"""Numbers of what loads follow."""
_SIZE_AT: Final = {"force": 0, "moment": 3}
"""Component that holds the size of a load against the motion."""


def terms_of(case: MechanismCase, load: LoadKeys) -> Iterator[Term]:
    """Yield the terms of a load; against the motion they are its size."""
    for vector, factors in parts_of(load, _FOLLOWED, case.period, case.span):
        if load.frame == "motion":
            yield term(_size_at(load), 1.0, factors)
        else:
            yield from (term(int(i), float(vector[i]), factors) for i in np.flatnonzero(vector))


def fill_load(record: Any, model: Model, load: LoadKeys, terms: list[Term]) -> None:
    """Fill the record of a load, and add its terms to those of the loads before it."""
    record.force, record.slip_velocity = _KINDS[load.frame], load.slip
    if load.frame == "motion":
        record.opposes, record.own_speed = _size_at(load), int(load.follows_own_speed)
        if load.direction is not None:
            record.force, record.direction[:] = kinds.LOAD_LINE, unit(load.direction, "direction")
    if load.along is not None:
        record.follows = model.joints.index(load.along)
        record.follows_position = int("position" in {COORDINATE_OF[over] for over in load.joint_axes})
        record.follows_sign = model.case.joints[load.along].sign
    record.first_term = len(terms)
    terms += terms_of(model.case, load)
    record.last_term = len(terms)


def _size_at(load: LoadKeys) -> int:
    return _SIZE_AT[next(iter(load.given))]
