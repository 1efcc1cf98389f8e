"""Estimate of the processor time of a run from earlier runs."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from statistics import median
from typing import Final

from tribodyn.cases.case import Case
from tribodyn.cases.tables import keys_in
from tribodyn.cases.write import Choices, choices_of
from tribodyn.core.errors import InputError

MOST_ROWS: Final = 100_000
"""Rows of a result that a page is sent, at most."""
_LAST: Final = 5
"""Number of runs from which the next one is estimated: a single one may have met a busy machine."""
_NO_GRID: Final = ("run", "wear")
"""Tables whose whole numbers do not say how fine a grid is."""
_TOLERANCE_POWER: Final = -0.2
"""Exponent of the number of steps over the relative tolerance, for a method of the fourth order or so."""


@dataclass
class Costs:
    """Seconds that runs took, by their equations.

    Attributes
    ----------
    seconds
        Of the last runs with these equations, for a case of size one.
    """

    seconds: Mapping[Choices, tuple[float, ...]] = field(default_factory=dict)

    def note(self, case: Case, seconds: float) -> None:
        """Remember the time of a run."""
        choices = choices_of(case)
        last = (*self.seconds.get(choices, ()), seconds / size(case))[-_LAST:]
        # Anew: threads may be looking at the ones before.
        self.seconds = {**self.seconds, choices: last}

    def knows(self, case: Case) -> bool:
        """Return whether a run with these equations was made before."""
        return choices_of(case) in self.seconds

    def expected(self, case: Case) -> float | None:
        """Return the expected time of a run [s], as if all equations cost the same; None before any run."""
        seconds = self.seconds
        if not seconds:
            return None
        last = next(reversed([*seconds.values()]))
        return median(seconds.get(choices_of(case), last)) * size(case)


def size(case: Case) -> float:
    """Return the amount of work of a case: its time, its nodes and its tolerance, in no particular unit."""
    found = case.duration
    for path, key in keys_in(case).items():
        value = case.at(path) if key.kind == "count" and path.partition(".")[0] not in _NO_GRID else None
        if isinstance(value, int) and value > 0:
            found *= value / float(key.example or 1.0)
    tolerance = case.at("solver.rtol")
    return found * tolerance**_TOLERANCE_POWER if isinstance(tolerance, float) else found


def refuse_rows(case: Case) -> None:
    """Refuse a case whose result no page could hold."""
    interval = case.at("run.output_interval")
    if isinstance(interval, float) and case.duration / interval > MOST_ROWS:
        raise InputError(
            f"these are {case.duration / interval:.3g} rows; a page holds {MOST_ROWS}: lengthen it, or use "
            "`tribodyn run`",
            key="run.output_interval",
        )


def in_words(seconds: float) -> str:
    """Return a time as a person says it."""
    if seconds < 100.0:
        return f"{max(seconds, 0.1):.2g} s"
    if seconds < 6000.0:
        return f"{math.ceil(seconds / 60.0)} minutes"
    return f"{seconds / 3600.0:.2g} hours"
