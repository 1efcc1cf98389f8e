"""Figures of the disc."""

from __future__ import annotations

from falling_disc.sections import HEIGHT

from tribodyn.figures import chart

FIGURES = {"height": chart.family(HEIGHT)}
