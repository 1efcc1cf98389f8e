"""How much a run of the journal computes and keeps."""

from __future__ import annotations

import math
from typing import Final

from tribodyn.kernels.journal.quantities import OBSERVED
from tribodyn.mechanisms.journal.case import JournalCase
from tribodyn.mechanisms.workload import Keys, Workload

_OF_REBOUND: Final = 35.0
"""Steps of a rebound, measured with ``journal-dry``: 834 steps in 24 rebounds."""
_REBOUNDS: Final = 25.0
"""Rebounds after which damping has ended them."""
_AT_REST: Final = 2.0
"""Steps in the time of a rebound after that."""
_IN_OIL: Final = (200.0, 0.1)
"""Steps until the journal has settled in the film, and in the time of a rebound after that."""


def workload(case: JournalCase) -> Workload:
    """Return the counts of a case."""
    run, grid, film = case.run, case.solver.grid, case.film
    oil = film.lubricated
    return Workload(
        steps=_steps(case),
        states=8.0 if case.journal.tilt else 4.0,
        nodes=grid.theta * (grid.z + 2.0),
        joints=1.0,
        fields=0.0,
        samples=run.duration / run.output_interval,
        followed=0.0,
        quantities=len(OBSERVED),
        cells=float(film.grid.theta * film.grid.z) if oil else 0.0,
        band=(film.grid.z if case.journal.tilt else film.grid.z / 2.0) + 1.0 if oil else 0.0,
        own_matrix=False,
        compiled=case.solver.name == "mebdf",
        keys=Keys(),
    )


def _steps(case: JournalCase) -> float:
    """Return the expected steps: those of rebounds until they have died away."""
    force = max(math.hypot(case.loads.force_x, case.loads.force_y), 1.0)
    fall = math.sqrt(2.0 * case.joint.clearance * case.journal.mass / force)
    rebounds = case.duration / (2.0 * fall)
    if case.film.lubricated:
        return _IN_OIL[0] + _IN_OIL[1] * rebounds
    damped = case.contact.law_of(case.surface_pair).damping_factor != "none"
    lasting = min(rebounds, _REBOUNDS) if damped or case.contact.loss_coefficient else rebounds
    return _OF_REBOUND * lasting + _AT_REST * rebounds


WORKLOAD: Final = workload
