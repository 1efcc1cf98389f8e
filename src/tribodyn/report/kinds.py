"""What the page of each kind of result shows: listed once, here."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.contact import LAWS
from tribodyn.report.base import Chapter
from tribodyn.report.sections import (
    contact_force,
    energy,
    journal_curves,
    journal_path,
    mechanism,
    motion,
    orbit,
    pressure,
    tilt,
    vane_error,
    wear,
    wear_history,
    wear_stages,
)
from tribodyn.results.law_headlines import named

_FILM: Final = Chapter(
    "film",
    "One cycle",
    "Everything in this part shows the same moment. Move the slider, or press play.",
    (mechanism.SECTION, orbit.SECTION, pressure.SECTION),
    film=True,
)
_TIME: Final = Chapter(
    "time",
    "Over time",
    "Drag across a plot to zoom. By keyboard: go to a plot with Tab, then +, −, arrows, and 0 for the whole.",
    (
        vane_error.SECTION,
        vane_error.LOOP,
        contact_force.SECTION,
        tilt.SECTION,
        motion.SECTION,
        energy.LEDGER,
        energy.CLEARANCE_LEDGER,
    ),
)
_WEAR: Final = Chapter(
    "worn",
    "Wear",
    "What is worn off the bushing.",
    (wear.SECTION, wear_history.SECTION, wear_stages.SECTION),
)

_JOURNAL: Final = (
    Chapter("film", "The run", "Move the slider, or press play.", (journal_path.SECTION,), film=True),
    Chapter(
        "time",
        "Over time",
        _TIME.lead,
        (journal_curves.DEVIATION, journal_curves.FORCES, journal_curves.ENERGY),
    ),
)

CHAPTERS: Final[dict[str, tuple[Chapter, ...]]] = {
    "vsv": (_FILM, _TIME, _WEAR),
    "journal": _JOURNAL,
}
"""Chapters of each kind of result, in reading order. A section that a result has no data for is left out."""

KEY_NUMBERS: Final[dict[str, tuple[str, ...]]] = {
    "vsv": (
        "vane_angle_error_max_deg",
        "contact_force_mean_N",
        "contact_force_max_N",
        "peak_pressure_MPa",
        "wear_depth_rate_nm_per_1000_cycles",
        "clearance_energy_residual_percent",
    ),
    "journal": tuple(
        named(template, law)
        for template in ("settling_time_{law}_ms", "contact_force_max_{law}_N", "film_force_max_{law}_N")
        for law in LAWS
    ),
}
"""Headline numbers that a reader of each kind of result wants first."""


def kind_of(dataset: xr.Dataset) -> str:
    """Return the kind of a result: a key of :data:`CHAPTERS`."""
    kind = str(dataset.attrs.get("kind", "vsv"))
    return kind if kind in CHAPTERS else "vsv"
