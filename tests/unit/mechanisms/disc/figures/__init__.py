"""Figures of the disc."""

from falling_disc.sections import HEIGHT

from tribodyn.figures import chart

FIGURES = {"height": chart.family(HEIGHT)}
