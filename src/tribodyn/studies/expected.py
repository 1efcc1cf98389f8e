"""Expected time of a sweep."""

from statistics import fmean
from typing import Final

from tribodyn.core.platforms import processors
from tribodyn.simulation import estimate
from tribodyn.simulation.costs import MOST_MEMORY, MOST_TIME, PROGRAM, in_bytes, in_time
from tribodyn.studies.plan import SweepPlan
from tribodyn.studies.variation import SOURCE

_LOOKED_AT: Final = 16
"""Points whose estimates stand for all."""


def warnings_of(plan: SweepPlan, to_do: int, workers: int | None) -> list[str]:
    """Return warnings that the points of a sweep take long, or together much memory.

    Parameters
    ----------
    plan
        The sweep.
    to_do
        How many of its points are to be computed.
    workers
        Processes of this machine, as :class:`~tribodyn.studies.sweep.Means` has them.
    """
    n_workers = min(max(processors() if workers is None else workers, 1), max(to_do, 1))
    places = {round(k * (len(plan.points) - 1) / (_LOOKED_AT - 1)) for k in range(_LOOKED_AT)}
    looked_at = [estimate(plan.case.replace(plan.points[i].changes, source=SOURCE)) for i in sorted(places)]
    seconds = to_do * fmean(one.seconds for one in looked_at) / n_workers
    largest = max(looked_at, key=lambda one: one.memory)
    found = []
    if to_do and seconds > MOST_TIME:
        found.append(
            f"{to_do} points in {n_workers} processes are estimated to take {in_time(seconds)}, more than "
            f"{in_time(MOST_TIME)}: give fewer values, or change {looked_at[-1].time_key}"
        )
    # Workers share the program.
    memory = PROGRAM + n_workers * (largest.memory - PROGRAM)
    if to_do and memory > MOST_MEMORY:
        found.append(
            f"{n_workers} points at once are estimated to take {in_bytes(memory)} of memory, more than "
            f"{in_bytes(MOST_MEMORY)}: give fewer --workers, or change {largest.memory_key}"
        )
    return found
