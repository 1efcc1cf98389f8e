"""The journal as the rest of the program sees it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import Mechanism
from tribodyn.mechanisms.journal.case import JournalCase
from tribodyn.mechanisms.journal.headlines import HEADLINES, KEY_NUMBERS
from tribodyn.mechanisms.journal.variables import VARIABLES

if TYPE_CHECKING:
    from tribodyn.figures.base import Family
    from tribodyn.mechanisms.journal.system import JournalSystem
    from tribodyn.views.overlay import Overlay
    from tribodyn.views.section import Chapter

# What compiles or draws is imported when it is used: reading a case needs neither.


def _system(case: JournalCase) -> JournalSystem:
    from tribodyn.mechanisms.journal.system import JournalSystem

    return JournalSystem(case)


def _figures() -> Mapping[str, Family]:
    from tribodyn.mechanisms.journal.figures import FIGURES

    return FIGURES


def _chapters() -> Sequence[Chapter]:
    from tribodyn.mechanisms.journal.sections import CHAPTERS

    return CHAPTERS


def _overlays() -> Sequence[Overlay]:
    from tribodyn.mechanisms.journal.sections import OVERLAYS

    return OVERLAYS


JOURNAL: Final = Mechanism(
    case=JournalCase,
    built_in={
        "journal-dry": BuiltIn(
            JournalCase, "journal under a constant load falling into its dry bushing, with damping"
        ),
        "journal-oil": BuiltIn(JournalCase, "the same in oil", {"film.lubricated": True}),
    },
    variables=VARIABLES,
    headlines=HEADLINES,
    key_numbers=KEY_NUMBERS,
    system=_system,
    figures=_figures,
    chapters=_chapters,
    overlays=_overlays,
)
