"""Tables of the page on what a run costs: coefficients of the estimate, and runs that were measured."""

from __future__ import annotations

from typing import Final

from tables.benchmarks import SOURCE, verdict
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


def options(found: Found) -> Lines:
    """Give what elastic bodies and friction at rest cost."""
    yield from head("case", "option", "time", "aim", "steps")
    for one in found["options"]["rows"]:
        time = verdict(f"{one['time']:.2f}", one["time"] <= one["aim"])
        yield row(one["case"], one["option"], time, f"{one['aim']:g}", f"{one['steps']:.2f}")


def rings(found: Found) -> Lines:
    """Give what rings of vanes take over a cycle of the drive."""
    yield from head("levers", "vanes", "start", "integration", "times real time", "memory", "whole run")
    for levers in ("rigid", "elastic"):
        for number, one in found["ring"][levers]["rings"].items():
            start = sum(one[part]["seconds"] for part in ("case", "assembly", "start"))
            steps, whole = one["integration"]["seconds"], one["whole"]["seconds"]
            faster = one["whole"]["simulated [s]"] / steps
            memory = f"{one['integration']['peak [MB]']:.0f} MB"
            yield row(levers, number, seconds(start), seconds(steps), f"{faster:.2f}", memory, seconds(whole))


#: Tables by name.
TABLES: Final[dict[str, Table]] = {
    "coefficients": coefficients,
    "costs": stored(SOURCE, costs),
    "options": stored(SOURCE, options),
    "rings": stored(SOURCE, rings),
}
