"""Loads of the journal from tables, as terms for kernels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from tribodyn.kernels.journal.data import TIME, TURNED
from tribodyn.mechanisms.actions import Term

if TYPE_CHECKING:
    from tribodyn.mechanisms.journal.case import JournalCase

TARGETS: Final = ("force_x", "force_y", "moment_x", "moment_y")
"""In the order of the loads in ``kernels/journal``."""


def terms_of(case: JournalCase) -> Iterator[Term]:
    """Yield the loads of a case from tables."""
    for load in case.loads.more.values():
        for key, signal in load.given.items():
            for product in signal.products():
                factors = tuple((found, TIME if over == "times" else TURNED) for found, over in product)
                yield Term(TARGETS.index(key), factors)
