"""Inputs and outputs of every runner."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from tribodyn.studies.plan import Point
from tribodyn.studies.work import PointOutcome

Finished: TypeAlias = Iterator[tuple[Point, PointOutcome]]

LISTEN: Final = 0.1
"""Time between two looks at whether to stop [s]."""
_SOON: Final = 5.0
"""Time after which a user reads why workers are not ready [s]."""
_PREPARING: Final = "preparing the workers"


@dataclass(frozen=True)
class SweepJob:
    """Points to be computed.

    Attributes
    ----------
    points
        One or more.
    keep_result
        Whether outcomes hold the whole result beside the key results.
    staging
        Path beside which workers of this machine leave it instead; empty for none.
    stop
        Asked several times a second; when true, what is still to be done is called off.
    note
        Called with what a user should know.
    """

    points: Sequence[Point]
    keep_result: bool
    staging: str
    stop: Callable[[], bool]
    note: Callable[[str], None]


def stop_while_preparing(job: SweepJob) -> Callable[[], bool]:
    """Return a check for a stop that reports after a while why there are no points yet."""
    began, news = time.monotonic(), [_PREPARING]

    def stop() -> bool:
        if news and time.monotonic() - began > _SOON:
            job.note(news.pop())
        return job.stop()

    return stop
