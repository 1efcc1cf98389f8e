"""Draw the pressure of an oil film with each cavitation model for the manual.

python docs/plots/film.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from tribodyn.lubrication import Film, FilmGrid, film_state

CLEARANCE, RADIUS, OMEGA = 20e-6, 5e-3, 200.0
LEVEL = np.array([0.7 * CLEARANCE] + [0.0] * 7)
TILTED = np.array([1e-6, 2e-6, 9e-4, -6e-4, 0.0, 0.0, 0.0, 0.0])
STYLES = {
    ("none", "periodic"): ("none (full Sommerfeld)", "0.6", ":"),
    ("half-sommerfeld", "periodic"): ("half-sommerfeld", "#e69f00", "-."),
    ("reynolds", "periodic"): ("reynolds, periodic", "#0072b2", "-"),
    ("reynolds", "groove"): ("reynolds, groove", "#56b4e9", "--"),
    ("jfo", "groove"): ("jfo, groove", "#d55e00", ":"),
}


def film(cavitation: str, boundary: str) -> Film:
    """Return the film of the figures: length over diameter 1."""
    grid = FilmGrid(256, 32)
    return Film(0.01, CLEARANCE, RADIUS, 2.0 * RADIUS, cavitation=cavitation, boundary=boundary, grid=grid)


def draw_middle(axes: Axes) -> None:
    """Draw the pressure in the middle row with every model, at ε = 0.7."""
    for (cavitation, boundary), (label, colour, line) in STYLES.items():
        one = film(cavitation, boundary)
        pressure = film_state(one, LEVEL, omega=OMEGA).pressure[16]
        width = 3.0 if cavitation == "jfo" else 1.6
        axes.plot(np.rad2deg(one.theta), pressure / 1e6, line, color=colour, label=label, linewidth=width)
    axes.axvline(180.0, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="θ from the widest gap [°]", ylabel="pressure [MPa]", xlim=(0.0, 360.0))
    axes.set_title("no tilt, ε = 0.7, middle of the film")
    axes.set_xticks(range(0, 361, 60))
    axes.legend(fontsize=8)


def draw_fill(axes: Axes) -> None:
    """Draw the filled fraction of a tilted film with `jfo`, and where it presses."""
    one = film("jfo", "groove")
    memory = one.memory()
    pressure = film_state(one, TILTED, omega=OMEGA, memory=memory).pressure
    theta, z = np.rad2deg(one.theta), 1e3 * one.z
    shown = axes.pcolormesh(
        theta, z[1:-1], memory.fill.T, cmap="Blues", vmin=0.0, vmax=1.0, shading="nearest"
    )
    levels = np.linspace(0.1, 0.9, 5) * pressure.max() / 1e6
    axes.contour(theta, z, pressure / 1e6, levels=levels, colors="#d55e00", linewidths=1.0)
    axes.set(
        xlabel="θ from the groove [°]",
        ylabel="z [mm]",
        title="tilted, jfo: filled fraction, pressure (lines)",
    )
    axes.set_xticks(range(0, 361, 60))
    axes.figure.colorbar(shown, ax=axes, label="filled fraction of the gap")


def main() -> None:
    """Draw the figure."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    plt.switch_backend("agg")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.0), layout="constrained")
    draw_middle(left)
    draw_fill(right)
    figure.savefig(target / "film_cavitation.png", dpi=130)


if __name__ == "__main__":
    main()
