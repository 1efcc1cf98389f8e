"""The variable stator vane mechanism as the rest of the program sees it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import Mechanism
from tribodyn.mechanisms.vsv.case import VsvCase
from tribodyn.mechanisms.vsv.headlines import HEADLINES, KEY_NUMBERS
from tribodyn.mechanisms.vsv.variables import OF_CYCLE, VARIABLES

if TYPE_CHECKING:
    from tribodyn.figures.base import Family
    from tribodyn.mechanisms.vsv.system import VsvSystem
    from tribodyn.views.overlay import Overlay
    from tribodyn.views.section import Chapter

# What compiles or draws is imported when it is used: reading a case needs neither.


def _system(case: VsvCase) -> VsvSystem:
    from tribodyn.mechanisms.vsv.system import VsvSystem

    return VsvSystem(case)


def _figures() -> Mapping[str, Family]:
    from tribodyn.mechanisms.vsv.figures import FIGURES

    return FIGURES


def _chapters() -> Sequence[Chapter]:
    from tribodyn.mechanisms.vsv.sections import CHAPTERS

    return CHAPTERS


def _overlays() -> Sequence[Overlay]:
    from tribodyn.mechanisms.vsv.sections import OVERLAYS

    return OVERLAYS


VSV: Final = Mechanism(
    case=VsvCase,
    built_in={
        "vsv": BuiltIn(
            VsvCase,
            "variable stator vane mechanism, dry rough trunnion joint, 20 um clearance, two drive cycles",
        )
    },
    variables=VARIABLES | OF_CYCLE,
    headlines=HEADLINES,
    key_numbers=KEY_NUMBERS,
    system=_system,
    figures=_figures,
    chapters=_chapters,
    overlays=_overlays,
    of_cycle=OF_CYCLE,
)
