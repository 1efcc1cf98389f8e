"""The figure of the manual: how many times as long others take, how cost grows, and what accuracy costs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.figures.style import BLUE, GREY, INK, PALE, VERMILION

DEFAULTS: Final = {"grid": "96 × 16", "clearance": "20 µm", "cycles": "1"}
LOOKS: Final = {
    "grid": ("nodes of the grid", INK, "o", "-"),
    "clearance": ("clearance", BLUE, "s", "--"),
    "cycles": ("drive cycles", VERMILION, "^", ":"),
}
KERNEL_GRID: Final = "256 × 32"
STYLE: Final = {"svg.hashsalt": "tribodyn", "svg.fonttype": "none", "font.size": 8}


def draw(found: dict[str, Any], target: Path) -> None:
    """Draw what has been measured so far."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(8.0, 5.6), layout="constrained", facecolor="white")
        grid = figure.add_gridspec(2, 2, height_ratios=(1.25, 1.0))
        _ratios(figure.add_subplot(grid[0, :]), bars(found))
        _growth(figure.add_subplot(grid[1, 0]), found.get("growth", {}))
        _tolerances(figure.add_subplot(grid[1, 1]), found.get("vsv", {}).get("tolerances", []))
        figure.savefig(target, metadata={"Date": None} if target.suffix == ".svg" else None, dpi=150)


def bars(found: dict[str, Any]) -> list[tuple[str, float, bool]]:
    """Return name, ratio of times to ours, and whether it is a part rather than a whole simulation."""
    rows = []
    kernel = found.get("joint_kernel", {}).get(KERNEL_GRID)
    if kernel:
        rows.append((f"joint integral {KERNEL_GRID}: NumPy", kernel["numpy"] / kernel["wrench"], True))
    for name in ("no tilt", "tilt"):
        if "film" in found:
            rows.append((f"oil film, {name}: SuperLU", found["film"][name]["ratio"], True))
    for peer in found.get("vsv", {}).get("peers", []):
        rows.append((f"mechanism: {peer['name']}, {peer['setting']}", peer["ratio"], False))
    return rows


def _ratios(axes: Axes, rows: list[tuple[str, float, bool]]) -> None:
    places = np.arange(len(rows))
    for place, (_, ratio, part) in zip(places, rows, strict=True):
        axes.barh(place, ratio - 1.0, left=1.0, color=PALE if part else GREY, edgecolor=INK, linewidth=0.6)
        # Beside the bar: to the right of what is slower than ours, to the left of what is faster.
        left = min(ratio, 1.0) if ratio < 1.0 else ratio
        axes.annotate(
            f"{ratio:.3g}",
            (left, place),
            xytext=(-3 if ratio < 1.0 else 3, 0),
            textcoords="offset points",
            ha="right" if ratio < 1.0 else "left",
            va="center",
        )
    axes.axvline(1.0, color=INK, linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yticks(places, [name for name, _, _ in rows])
    axes.invert_yaxis()
    largest = max((ratio for _, ratio, _ in rows), default=10.0)
    axes.set_xlim(min(0.5, *(0.6 * ratio for _, ratio, _ in rows), 0.5), 2.0 * largest)
    axes.set_title("time over ours (light: a part of a simulation; dark: the mechanism)", fontsize=8)
    axes.grid(axis="x", alpha=0.3)
    axes.set_axisbelow(True)


def _growth(axes: Axes, found: dict[str, Any]) -> None:
    for what, default in DEFAULTS.items():
        rows = found.get(what, [])
        ours = next((row for row in rows if row["name"] == default), None)
        if ours is None:
            continue
        label, colour, marker, line = LOOKS[what]
        size = [row["size"] / ours["size"] for row in rows]
        cost = [row["seconds"] / ours["seconds"] for row in rows]
        axes.loglog(size, cost, color=colour, marker=marker, markersize=4, linestyle=line, label=label)
    span = np.array([0.25, 8.0])
    axes.loglog(span, span, color=PALE, linewidth=3, zorder=0, label="in proportion")
    axes.set(xlabel="size over the default (one cycle)", ylabel="time over that of the default")
    axes.legend(fontsize=7)
    axes.grid(alpha=0.3, which="both")


def _tolerances(axes: Axes, rows: list[dict[str, Any]]) -> None:
    for what, label, colour, marker, line in (
        ("rtol", "rtol alone", INK, "o", "-"),
        ("all", "with the absolute tolerances", BLUE, "s", "--"),
    ):
        mine = [row for row in rows if row["changed"] == what]
        x, y = [row["rtol"] for row in mine], [row["seconds"] for row in mine]
        axes.loglog(x, y, color=colour, marker=marker, markersize=4, linestyle=line, label=label)
    axes.invert_xaxis()
    axes.set(xlabel="solver.rtol", ylabel="time of two cycles [s]")
    if rows:
        axes.legend(fontsize=7)
    axes.grid(alpha=0.3, which="both")
