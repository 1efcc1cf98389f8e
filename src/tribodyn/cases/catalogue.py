"""The built-in cases, listed once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from tribodyn.cases.case import Case
from tribodyn.cases.journal import Journal
from tribodyn.cases.vsv import Vsv


@dataclass(frozen=True)
class BuiltIn:
    """A case that can be run by name.

    Attributes
    ----------
    model
        Its kind.
    summary
        One line for ``tribodyn cases``.
    given
        What differs from the defaults of the kind, by dotted path.
    """

    model: type[Case]
    summary: str
    given: Mapping[str, object] = field(default_factory=dict)


CASES: Final[dict[str, BuiltIn]] = {
    "vsv": BuiltIn(
        Vsv, "variable stator vane mechanism, dry rough trunnion joint, 20 um clearance, two drive cycles"
    ),
    "journal-dry": BuiltIn(
        Journal,
        "journal under a constant load falling into its dry bushing, contact with and without damping",
    ),
    "journal-oil": BuiltIn(
        Journal, "the same in oil: the film alone is enough damping", {"film.lubricated": True}
    ),
}

KINDS: Final[dict[str, type[Case]]] = {entry.model.kind(): entry.model for entry in CASES.values()}
"""What may stand under ``case =`` in a file."""
