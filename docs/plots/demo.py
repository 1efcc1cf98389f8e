"""Draw the picture of the README: orbit, contact force and vane-angle error of the built-in case.

python docs/plots/demo.py docs/_static/demo.png
"""

from __future__ import annotations

import sys

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

import tribodyn as td

FORWARD, REVERSE = "#0072b2", "#d55e00"


def draw_orbit(axes: Axes, result: xr.Dataset) -> None:
    """Path of the two ends of the trunnion axis inside the clearance circle."""
    clearance = 1e6 * result.attrs["clearance"]
    half = 0.5 * result.attrs["joint_length"]
    for z, colour, label, corner in ((half, FORWARD, "top end", 0.02), (-half, REVERSE, "bottom end", 0.94)):
        x = 1e6 * (result["e_x"] - z * np.tan(result["phi_y"]))
        y = 1e6 * (result["e_y"] - z * np.tan(result["phi_x"]))
        axes.plot(x, y, color=colour, linewidth=0.9)
        axes.text(0.02, corner, label, color=colour, transform=axes.transAxes)
    axes.add_patch(plt.Circle((0, 0), clearance, fill=False, color="0.4", linewidth=1.4))
    reach = 1.15 * clearance
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="X [µm]", ylabel="Y [µm]")
    axes.set(aspect="equal", title="trunnion in its bushing")


def draw_force(axes: Axes, result: xr.Dataset) -> None:
    """Contact force along X and Y."""
    axes.plot(result["time"], result["F_cx"], color=FORWARD, label="along X")
    axes.plot(result["time"], result["F_cy"], color=REVERSE, linestyle="--", label="along Y")
    axes.set(xlabel="time [s]", ylabel="contact force [N]", title="impacts when the vane reverses")
    axes.legend(frameon=False, fontsize=8)


def draw_error(axes: Axes, result: xr.Dataset) -> None:
    """Vane-angle error."""
    axes.plot(result["time"], np.rad2deg(result["theta_v"] - result["theta_v_ideal"]), color="black")
    axes.axhline(0.0, color="0.6", linewidth=0.8)
    axes.set(xlabel="time [s]", ylabel="vane-angle error [°]", title="what the clearance costs")


def main() -> None:
    """Simulate one drive cycle and draw."""
    result = td.simulate(td.load_case("vsv").replace({"run.cycles": 1.2}))
    plt.switch_backend("agg")
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.9), layout="constrained")
    for axes, draw in zip(panels, (draw_orbit, draw_force, draw_error), strict=True):
        draw(axes, result)
        axes.grid(alpha=0.25)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
