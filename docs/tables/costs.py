"""Tables of the page on what a run costs: coefficients of the estimate, and runs that were measured."""

from __future__ import annotations

from typing import Final

from tables.benchmarks import SOURCE
from tables.markdown import Found, Lines, Table, head, row, seconds, stored
from tribodyn.simulation.costs import COEFFICIENTS

MB: Final = 1e6


def coefficients() -> Lines:
    """Give the coefficients of the estimate."""
    yield from head("symbol", "value", "of each")
    for symbol, one in COEFFICIENTS.items():
        unit = "" if one.unit == "1" else f" {one.unit}"
        yield row(f"${symbol}$", f"{one:.3g}{unit}", one.meaning)


def costs(found: Found) -> Lines:
    """Give what runs took and what they were estimated to take."""
    yield from head(
        *("case", "cycles", "states", "joints with clearance", "nodes", "steps"),
        *("memory", "estimated", "processor time", "estimated"),
    )
    for name, one in found["costs"]["runs"].items():
        counts = (f"{one[key]:.0f}" for key in ("states", "joints", "nodes", "steps"))
        memory = (f"{one[key] / MB:.0f} MB" for key in ("memory", "expected memory"))
        times = (seconds(one[key]) for key in ("seconds", "expected seconds"))
        yield row(f"`{name}`", f"{one['cycles']:g}", *counts, *memory, *times)


#: Tables by name.
TABLES: Final[dict[str, Table]] = {"coefficients": coefficients, "costs": stored(SOURCE, costs)}
