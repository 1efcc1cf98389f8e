"""Loads of the journal from tables, as terms for kernels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

import numpy as np

from tribodyn.kernels.journal.data import OPPOSED, SLIDING, TIME, TURNED, TURNING
from tribodyn.mechanisms.actions import Term
from tribodyn.mechanisms.loads import parts_of, shaft_terms, term

if TYPE_CHECKING:
    from tribodyn.mechanisms.journal.case import JournalCase

_TARGETS: Final = {0: (0, 1.0), 1: (1, 1.0), 3: (2, 1.0), 4: (3, -1.0)}
_FOLLOWED: Final = {"times": TIME, "angles": TURNED, "speeds": TURNING, "velocities": SLIDING}


def terms_of(case: JournalCase) -> Iterator[Term]:
    """Yield the loads of a case from tables."""
    for load in case.loads.more.values():
        parts = parts_of(load, _FOLLOWED, None, case.duration)
        if load.frame == "motion":
            yield from (term(OPPOSED, 1.0, factors) for _, factors in parts)
            continue
        arm = np.array([0.0, 0.0, load.height])
        yield from shaft_terms(parts, _TARGETS, arm=arm, angle=TURNED, follower=load.frame == "body")
