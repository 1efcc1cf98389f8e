"""Names of tables that other keys give."""

from __future__ import annotations

from collections.abc import Collection

from tribodyn.cases.case import demand
from tribodyn.core.quoting import meant


def demand_known(given: str, names: Collection[str], key: str, what: str) -> None:
    """Refuse a name that no table has."""
    if given in names:
        return
    there = f"known: {', '.join(names)}" if names else "there is none"
    demand(False, key, f'"{given}" is no {what}; {there}{meant(given, names)}')
