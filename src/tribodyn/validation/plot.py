"""The plot of a validation set: measured values with their intervals, computed values, null model."""

from __future__ import annotations

from itertools import count
from pathlib import Path
from typing import Any, Final

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from tribodyn.figures.style import BLUE, DPI, GREEN, GREY, INK, PURPLE, SMALL, VERMILION
from tribodyn.validation.base import Plot

_COLOURS: Final = {"measured": (INK, GREY), "computed": (BLUE, VERMILION, GREEN, PURPLE), "null": (GREY, INK)}
_MARKERS: Final = "os^Dv"


def save_plot(plot: Plot, title: str, path: Path) -> None:
    """Write the plot of a set as PNG."""
    figure = Figure(figsize=(7.6, 3.8), dpi=DPI, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    seen = {kind: count() for kind in _COLOURS}
    for curve in plot.curves:
        place = next(seen[curve.kind])
        colour = _COLOURS[curve.kind][place % len(_COLOURS[curve.kind])]
        look: dict[str, Any] = {"color": colour, "label": curve.label}
        if curve.kind == "measured":
            marker = _MARKERS[place % len(_MARKERS)]
            axes.errorbar(curve.x, curve.y, curve.half_width, fmt=marker, markersize=4, capsize=2, **look)
        else:
            axes.plot(curve.x, curve.y, linestyle="--" if curve.kind == "null" else "-", marker=".", **look)
    axes.set(xlabel=plot.x_label, ylabel=plot.y_label)
    axes.set_title(title, fontsize=SMALL, loc="left")
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=SMALL)
    figure.savefig(path)
