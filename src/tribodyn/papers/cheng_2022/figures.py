"""The figures of the paper from our own runs, listed once."""

from __future__ import annotations

from typing import Final

from tribodyn.papers.cheng_2022 import clearance, drive, journal, pressure, split, trunnion, undamped, wear
from tribodyn.papers.cheng_2022.base import PaperFigure
from tribodyn.papers.cheng_2022.runs import FORMULATIONS, Runs

FIGURES: Final[dict[str, PaperFigure]] = {
    figure.name: figure
    for figure in (
        journal.DRY,
        journal.OIL,
        drive.CRANK,
        drive.VANE,
        trunnion.FORCES,
        trunnion.PATH,
        trunnion.VELOCITIES,
        pressure.PRESSURE,
        clearance.MOTION,
        clearance.FORCES,
        clearance.ATTITUDE,
        wear.WEAR,
        split.SPLIT,
        undamped.UNDAMPED,
    )
}
"""Every figure of the paper that shows results, by name, and two that its conclusions ask for."""

__all__ = ["FIGURES", "FORMULATIONS", "PaperFigure", "Runs"]
