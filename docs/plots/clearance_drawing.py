"""Draw what the keys of a clearance measure, and what a sustained maximum is.

python docs/plots/clearance_drawing.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Final

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle

import tribodyn as td
from tribodyn.figures.style import BLUE, GREY, INK, VERMILION
from tribodyn.results.reading import sustained

STEEL: Final = "#c9d3dd"
BORE: Final = "#e3d9c8"
SMALL: Final = 9


def line(colour: str) -> dict[str, Any]:
    """Return the look of a line from a label to what it names."""
    return {"arrowstyle": "-", "color": colour}


def arrow(colour: str) -> dict[str, Any]:
    """Return the look of a force or displacement."""
    return {"arrowstyle": "-|>", "color": colour, "lw": 2, "shrinkA": 0, "shrinkB": 0}


def measure(axes: Axes, start: tuple[float, float], end: tuple[float, float], label: str) -> None:
    """Draw a dimension line with its label to the right of its middle."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "<->", "color": BLUE, "shrinkA": 0, "shrinkB": 0})
    x, y = (0.5 * (a + b) for a, b in zip(start, end, strict=True))
    axes.text(x + 0.1, y, label, color=BLUE, size=SMALL, va="center")


def draw_section(axes: Axes) -> None:
    """Draw pin, bore and end faces in a section along the axis, gaps much too large."""
    for x in (-2.6, 1.3):
        axes.add_patch(Rectangle((x, -2.0), 1.3, 4.0, facecolor=BORE, edgecolor=INK))
    axes.add_patch(Rectangle((-1.0, -3.0), 2.0, 6.0, facecolor=STEEL, edgecolor=INK))
    for y in (2.5, -3.2):
        axes.add_patch(Rectangle((-2.1, y), 4.2, 0.7, facecolor=STEEL, edgecolor=INK))
    axes.annotate("", (0.0, 4.7), (0.0, -4.2), arrowprops={"arrowstyle": "-|>", "color": INK, "ls": "-."})
    axes.text(0.15, 4.4, "axis", size=SMALL)
    measure(axes, (3.1, -2.0), (3.1, 2.0), "length")
    measure(axes, (-2.0, 2.0), (-2.0, 2.5), "")
    axes.text(-2.9, 2.25, "axial_upper", color=BLUE, size=SMALL, ha="right", va="center")
    measure(axes, (-2.0, -2.5), (-2.0, -2.0), "")
    axes.text(-2.9, -2.25, "axial_lower", color=BLUE, size=SMALL, ha="right", va="center")
    measure(axes, (1.0, 1.2), (1.3, 1.2), "")
    axes.annotate("radial", (1.15, 1.2), (2.75, 2.9), color=BLUE, size=SMALL, arrowprops=line(BLUE))
    measure(axes, (0.0, -0.6), (1.0, -0.6), "")
    axes.text(0.5, -0.95, "radius", color=BLUE, size=SMALL, ha="center")
    measure(axes, (0.0, -3.55), (2.1, -3.55), "")
    axes.text(1.05, -3.9, "flange", color=BLUE, size=SMALL, ha="center")
    axes.annotate("", (-0.5, 2.9), (-0.5, 4.4), arrowprops=arrow(VERMILION))
    words = "a load on the pin\nagainst the axis\ncloses axial_upper"
    axes.text(-0.8, 4.0, words, color=VERMILION, size=SMALL, ha="right", va="center")
    axes.text(-0.5, 0.6, "pin", size=SMALL, ha="center")
    axes.text(-1.95, 0.0, "bore", size=SMALL, ha="center")
    axes.set(xlim=(-5.2, 4.8), ylim=(-4.4, 5.2), aspect="equal")


def draw_across(axes: Axes) -> None:
    """Draw pin and bore across the axis, with the displacement of the pin."""
    axes.add_patch(Circle((0.0, 0.0), 2.4, facecolor=BORE, edgecolor=INK))
    axes.add_patch(Circle((0.0, 0.0), 1.8, facecolor="white", edgecolor=INK))
    x, y = 0.45, -0.3
    axes.add_patch(Circle((x, y), 1.25, facecolor=STEEL, edgecolor=INK))
    axes.plot(0.0, 0.0, "+", color=INK, ms=10)
    axes.plot(x, y, "+", color=INK, ms=10)
    axes.annotate("", (x, y), (0.0, 0.0), arrowprops=arrow(VERMILION))
    look = {"color": VERMILION, "size": SMALL, "ha": "center", "arrowprops": line(VERMILION)}
    axes.annotate("displacement", (0.2, -0.15), (0.3, 1.95), **look)
    words = "bore radius = radius + radial\nplay on the diameter = 2 · radial"
    axes.text(0.0, -2.75, words, size=SMALL, ha="center", va="top")
    axes.set(xlim=(-2.8, 2.8), ylim=(-3.9, 2.8), aspect="equal")


def draw_sustained(axes: Axes) -> None:
    """Draw the force in a pivot over time, with its sustained maximum and its peak."""
    result = td.simulate(td.load_case("four-bar").replace({"run.cycles": 1}))
    force = (result["reaction_force"].sel(joint="coupler-pin") ** 2).sum("axis") ** 0.5
    held = sustained(result, force.values)
    time = 1e3 * result["time"]
    axes.plot(time, force, color=INK, linewidth=0.9)
    axes.axhline(held, color=BLUE)
    axes.axhline(float(force.max()), color=VERMILION)
    most = float(force.max())
    axes.text(2.0, held + 0.02 * most, "sustained maximum", color=BLUE, size=SMALL)
    axes.text(2.0, 0.95 * most, "peak, impacts included", color=VERMILION, size=SMALL)
    axes.set(xlabel="time [ms]", ylabel="force in the pin [N]", ylim=(0.0, 1.05 * most))
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(colors=GREY)


def main() -> None:
    """Write the figure into the given directory."""
    plt.switch_backend("agg")
    figure = plt.figure(figsize=(12.5, 4.4), layout="constrained")
    panels = figure.subplots(1, 3, width_ratios=(1.25, 0.85, 1.2))
    for axes, draw, title in zip(
        panels,
        (draw_section, draw_across, draw_sustained),
        ("along the axis", "across the axis", "a force over time"),
        strict=True,
    ):
        draw(axes)
        axes.set_title(title, loc="left", size=SMALL + 1, color=GREY)
    for axes in panels[:2]:
        axes.axis("off")
    figure.savefig(Path(sys.argv[1]) / "clearance_drawing.png", dpi=110)


if __name__ == "__main__":
    main()
