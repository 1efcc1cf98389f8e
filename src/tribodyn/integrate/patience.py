"""Detection of a run that makes no progress, although it goes on stepping."""

from __future__ import annotations

import time
from typing import Final

from tribodyn.core.errors import IntegrationFailure
from tribodyn.integrate.schedule import Schedule

LOOK: Final = 4.0
"""Time between two looks [s]; two of them find out within ten seconds."""
LEAST_WORK: Final = 2000
"""Evaluations between two looks below which a run is slow, but not stuck."""
COLLAPSED: Final = 1.0e-5
"""Mean progress of an evaluation between two looks, over the usual one, of a run that is stuck. Thousands of
evaluations in one impact, or in the ringing after it, get on a hundred times as fast."""
USUAL: Final = 0.1
"""The usual progress of an evaluation, over the interval of output times, where there is no other yet."""
MOST_LEFT: Final = 1.0e9
"""Evaluations that the rest of a run may need at the present pace."""


class Patience:
    """Watches the progress of one run.

    Parameters
    ----------
    schedule
        Of the run.
    """

    def __init__(self, schedule: Schedule) -> None:
        self._end, n_outputs = float(schedule.edges[-1]), max(schedule.output_times.size, 1000)
        self._usual = USUAL * (self._end - float(schedule.edges[0])) / n_outputs
        self._looked, self._begin = time.monotonic(), float(schedule.edges[0])
        self._reached, self._work = self._begin, 0

    def look(self, t: float, evaluations: int) -> None:
        """Raise ``IntegrationFailure`` where steps have become too short to get anywhere.

        Parameters
        ----------
        t
            Simulated time reached [s].
        evaluations
            Of the right-hand side so far.
        """
        now = time.monotonic()
        if now - self._looked < LOOK:
            return
        work, progress = evaluations - self._work, t - self._reached
        usual = min(self._usual, (self._reached - self._begin) / self._work) if self._work else self._usual
        pace = progress / max(work, 1)
        if work > LEAST_WORK and pace < COLLAPSED * usual and (self._end - t) > MOST_LEFT * pace:
            reason = (
                f"the run makes no progress any more: its last {work} evaluations covered {progress:.3g} s. "
                "Something swings or switches there faster than the rest of the run can wait for"
            )
            raise IntegrationFailure(t, reason)
        self._looked, self._reached, self._work = now, t, evaluations
