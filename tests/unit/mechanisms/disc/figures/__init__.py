"""Figures of the disc."""

from __future__ import annotations

from tribodyn.figures import chart
from tribodyn.mechanisms.disc.sections import HEIGHT

FIGURES = {"height": chart.family(HEIGHT)}
