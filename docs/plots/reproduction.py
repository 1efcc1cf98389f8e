"""Draw the figures of the source paper, and show what the left-out lever moment does.

python docs/plots/reproduction.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from tribodyn.papers.cheng_2022.figures import FIGURES, Runs, save_figure
from tribodyn.papers.cheng_2022.runs import CLEARANCES, FORMULATIONS, smooth

LOOKS = {"paper": ("0.55", "--"), "exact": ("#0072b2", "-")}


def draw_lever_moment(runs: Runs, target: Path) -> None:
    """Tilt, peak pressure and angle error with and without Z_S3 F_43 in the moments of the vane."""
    figure, (tilt, pressure, error) = plt.subplots(1, 3, figsize=(9.0, 2.9), layout="constrained")
    for name in FORMULATIONS:
        colour, dash = LOOKS[name]
        whole = runs.vsv(name, CLEARANCES[0])
        run = whole.sel(time=whole["time"] <= whole.attrs["cycle_period"])
        quiet = smooth(run)
        time = quiet["time"].values
        gap = np.append(np.diff(time) > 0.1, False)  # no line across the impacts
        look = {"color": colour, "linestyle": dash, "label": name}
        tilt.plot(time, np.where(gap, np.nan, quiet["phi_y"].values * 1e3), **look)
        pressure.plot(time, np.where(gap, np.nan, quiet["p_max"].values * 1e-6), **look)
        off = np.degrees(np.abs(quiet["theta_v"].values - quiet["theta_v_ideal"].values))
        error.plot(time, np.where(gap, np.nan, off), **look)
    labels = ("tilt $\\varphi_y$ [mrad]", "peak pressure [MPa]", "vane-angle error [°]")
    for axes, label in zip((tilt, pressure, error), labels, strict=True):
        axes.set_xlabel("time [s]")
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    pressure.set_ylim(bottom=0.0)
    error.set_ylim(bottom=0.0)
    tilt.legend(frameon=False)
    figure.savefig(target / "lever_moment.png", dpi=150)
    plt.close(figure)


def main() -> None:
    """Draw everything into the given directory."""
    target = Path(sys.argv[1]) / "reproduction"
    target.mkdir(parents=True, exist_ok=True)
    runs = Runs()
    for figure in FIGURES.values():
        save_figure(figure, figure.data(runs, "paper"), target)
    draw_lever_moment(runs, target)


if __name__ == "__main__":
    main()
