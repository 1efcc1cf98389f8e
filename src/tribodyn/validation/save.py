"""Files of validation results: a page and a plot for each set, and all numbers as JSON."""

import json
from collections.abc import Sequence
from itertools import count
from pathlib import Path
from typing import Any, Final

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from tribodyn.figures.style import BLUE, DPI, GREEN, GREY, INK, PURPLE, SMALL, VERMILION
from tribodyn.validation.base import Plot
from tribodyn.validation.report import Judged, as_json, as_page

_COLOURS: Final = {"measured": (INK, GREY), "computed": (BLUE, VERMILION, GREEN, PURPLE), "null": (GREY, INK)}
_MARKERS: Final = "os^Dv"


def _save_plot(plot: Plot, title: str, path: Path) -> None:
    """Write measured values with their intervals, computed values and null model as PNG."""
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


def save(all_judged: Sequence[Judged], folder: Path) -> None:
    """Write ``NAME.md`` and ``NAME.png`` of each set, and ``validation.json`` with all numbers."""
    for one in all_judged:
        (folder / f"{one.set.name}.md").write_text(as_page(one), encoding="utf-8")
        if one.outcome.plot is not None:
            _save_plot(one.outcome.plot, one.set.title, folder / f"{one.set.name}.png")
    document = json.dumps([as_json(one) for one in all_judged], indent=2, ensure_ascii=False)
    (folder / "validation.json").write_text(document + "\n", encoding="utf-8")
