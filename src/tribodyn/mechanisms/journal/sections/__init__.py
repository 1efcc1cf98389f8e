"""What the report shows of the journal: its chapters, and what a comparison lays over each other."""

from __future__ import annotations

from typing import Final

from tribodyn.mechanisms.journal.sections import path
from tribodyn.mechanisms.journal.sections.charts import DEVIATION, ENERGY, FORCES
from tribodyn.views import overlay
from tribodyn.views.overlay import Overlay, scaled
from tribodyn.views.section import OVER_TIME, Chapter

CHAPTERS: Final = (
    Chapter("playback", "The run", "Move the slider, or press play.", (path.SECTION,), playback=True),
    Chapter("time", "Over time", OVER_TIME, (DEVIATION.section, FORCES.section, ENERGY.section)),
)
"""Chapters in reading order."""

OVERLAYS: Final = (
    *overlay.BUSHING,
    Overlay("film", "Film force", (scaled("F_ox", "along X [N]", 1.0), scaled("F_oy", "along Y [N]", 1.0))),
)
"""What a comparison of runs shows."""
