"""The figure of the manual: how many times as long others take, how cost grows, and what accuracy costs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final, Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

from tribodyn.figures.style import BLUE, GREY, INK, PALE, VERMILION

DEFAULTS: Final = {"grid": "64 × 16", "clearance": "20 µm", "cycles": "1"}
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
        figure = Figure(figsize=(7.6, 5.6), layout="constrained", facecolor="white")
        upper, lower = figure.subfigures(2, 1, height_ratios=(1.2, 1.0))
        left, right = lower.subplots(1, 2)
        _ratios(upper.subplots(), bars(found))
        _growth(left, found.get("growth", {}))
        _tolerances(right, found.get("vsv", {}).get("tolerances", []))
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
        rows.append((f"{peer['name']}, {peer['setting']}", peer["ratio"], False))
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
    axes.set_xlim(min([0.7, *(0.6 * ratio for _, ratio, _ in rows)]), 1.6 * largest)
    axes.set_title("time over ours: parts (light) and the vane mechanism as a whole (dark)", fontsize=8)
    _plain(axes, "x", (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500))
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
    axes.set(xlabel="size over the default", ylabel="time over that of the default")
    _plain(axes, "x", (0.25, 0.5, 1, 2, 4, 8))
    _plain(axes, "y", (0.25, 0.5, 1, 2, 4, 8))
    axes.legend(fontsize=7)
    axes.grid(alpha=0.3)


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
    _plain(axes, "y", (0.05, 0.1, 0.2, 0.5, 1, 2, 5))
    if rows:
        axes.legend(fontsize=7, loc="upper left")
    axes.grid(alpha=0.3)


def _plain(axes: Axes, which: Literal["x", "y"], places: tuple[float, ...]) -> None:
    """Put plain numbers at some places of a logarithmic axis, as far as it reaches."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    low, high = sorted(axis.get_view_interval())
    inside = [place for place in places if low <= place <= high]
    axis.set_major_locator(FixedLocator(inside))
    axis.set_major_formatter(FixedFormatter([f"{place:g}" for place in inside]))
    axis.set_minor_locator(NullLocator())
