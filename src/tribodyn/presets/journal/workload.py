"""Amount of work and memory of a run of the journal."""

import math
from dataclasses import replace
from typing import Final

from tribodyn.mechanism.workload import workload as of_mechanism
from tribodyn.mechanisms.workload import Keys, Workload
from tribodyn.presets.journal.case import JournalCase, mechanism_of

_OF_REBOUND: Final = 35.0  #: Steps of a rebound, measured with ``journal-dry``: 834 steps in 24 rebounds.
_REBOUNDS: Final = 25.0  #: Rebounds after which damping has ended them.
_AT_REST: Final = 2.0  #: Steps in the time of a rebound after that.
#: Steps until the journal has settled in the film, and in the time of a rebound after that.
_IN_OIL: Final = (200.0, 0.1)


def workload(case: JournalCase) -> Workload:
    """Return the counts of a case."""
    found = of_mechanism(mechanism_of(case))
    # A level film is solved on half its length.
    level = found.cells and not case.journal.tilt
    band = 0.5 * case.film.grid.z + 1.0 if level else found.band
    return replace(found, steps=_steps(case), band=band, keys=Keys())


def _steps(case: JournalCase) -> float:
    """Return the expected steps: those of rebounds until they have died away."""
    force = max(math.hypot(case.loads.force_x, case.loads.force_y), 1.0)
    fall = math.sqrt(2.0 * case.joint.clearance * case.journal.mass / force)
    rebounds = case.duration / (2.0 * fall)
    if case.film.lubricated:
        return _IN_OIL[0] + _IN_OIL[1] * rebounds
    damped = case.contact.law_of(case.surface_pair).damping_factor != "none"
    counted = min(rebounds, _REBOUNDS) if damped or case.contact.loss_coefficient else rebounds
    return _OF_REBOUND * counted + _AT_REST * rebounds


WORKLOAD: Final = workload
