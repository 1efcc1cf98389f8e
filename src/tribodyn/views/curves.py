"""Curves and the panels they are drawn in, whatever draws them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from tribodyn.core.arrays import FloatArray

LOOKS: Final = (
    ("ink", "solid"),
    ("blue", "dash"),
    ("vermilion", "dashdot"),
    ("green", "dot"),
    ("orange", "solid"),
    ("purple", "dash"),
    ("grey", "longdash"),
)
"""Colour and dash of curves that have no look of their own; told apart in grey by the dash."""


@dataclass(frozen=True)
class ChartCurve:
    """One curve.

    Attributes
    ----------
    name
        For the legend.
    values
        What is drawn, in the unit of its panel, shape (n,).
    colour
        Name of a colour of the page's style sheet.
    dash
        Dash pattern: solid, dash, dashdot, dot or longdash.
    width
        Line width [px].
    x
        Its own abscissa, shape (n,); by default that of the figure.
    """

    name: str
    values: FloatArray
    colour: str = "ink"
    dash: str = "solid"
    width: float = 1.6
    x: FloatArray | None = None


@dataclass(frozen=True)
class ChartMarks:
    """Points with a letter each.

    Attributes
    ----------
    times
        When [s], shape (n,).
    values
        Where, in the unit of the panel, shape (n,).
    labels
        Their letters.
    """

    times: FloatArray
    values: FloatArray
    labels: tuple[str, ...]


@dataclass(frozen=True)
class Panel:
    """Curves with a common ordinate.

    Attributes
    ----------
    label
        Quantity and unit.
    curves
        Drawn in this order.
    smooth
        Whether the panel opens on the smooth motion, where impacts would flatten it.
    unit
        Unit for the note that says so.
    level
        A value to compare with, drawn as a fine line; none by default.
    marks
        Points to mark in the figure; none by default.
    """

    label: str
    curves: Sequence[ChartCurve]
    smooth: bool = False
    unit: str = ""
    level: float | None = None
    marks: ChartMarks | None = None
