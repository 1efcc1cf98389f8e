"""Names of peaks in results: of a whole run, and of each reversal with its impacts apart from the rest."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import Table
from tribodyn.results.variables import REVERSAL, Variable

PARTS: Final = {
    "impact": "in the impacts after the reversal",
    "outside": "from these impacts to the next reversal",
}
"""Parts of the time from one reversal to the next, in the order of the kernels."""


def of_run_described(table: Table) -> dict[str, Variable]:
    """Return the descriptions of the peaks of a run, by name."""
    described = {}
    for quantity in table:
        meaning = f"largest {quantity.meaning}"
        described[f"{quantity.name}_peak"] = Variable(quantity.unit, meaning, ())
        described[f"{quantity.name}_peak_time"] = Variable("s", f"time of the {meaning}", ())
    return described


def of_reversals_described(table: Table, part_of: tuple[str, ...] = ()) -> dict[str, Variable]:
    """Return the descriptions of the peaks of each reversal, and of each part of a mechanism, by name."""
    described = {}
    for quantity in table:
        for part, where in PARTS.items():
            meaning = f"largest {quantity.meaning} {where}"
            described[f"{quantity.name}_{part}"] = Variable(quantity.unit, meaning, (*REVERSAL, *part_of))
            described[f"{quantity.name}_{part}_time"] = Variable(
                "s", f"time of the {meaning}", (*REVERSAL, *part_of)
            )
    return described
