"""Draw the figures of the wear page: campaigns of a million cycles at two clearances, and the worn shape.

python docs/plots/wear.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import tribodyn as td

CLEARANCES = {"20 um": ("#0072b2", "-"), "40 um": ("#d55e00", "--")}
CYCLES = 1_000_000
# Twice the default: half the stops, and a depth that differs by less than 1 %.
CHANGES = {"wear.cycles": CYCLES, "wear.jump_limit": 0.1, "run.output_interval": "20 ms"}


def campaign(clearance: str) -> xr.Dataset:
    """Return a campaign of a million cycles."""
    return td.simulate(td.load_case("vsv").replace(CHANGES | {"joint.clearance": clearance}))


def draw_history(results: dict[str, xr.Dataset], target: Path) -> None:
    """Depth, pressure and vane-angle error over the cycles; the straight line is wear without feedback."""
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.9), layout="constrained")
    for clearance, result in results.items():
        colour, dash = CLEARANCES[clearance]
        cycles = result["wear_cycles"].values[1:]
        look = {"color": colour, "linestyle": dash}
        panels[0].loglog(cycles, result["wear_depth_max"][1:] * 1e6, label=clearance, **look)
        panels[0].loglog(cycles, cycles * float(result["wear_rate"][0]) * 1e6, color=colour, linewidth=0.7)
        panels[1].loglog(cycles, result["wear_pressure_mean"][1:] / 1e6, **look)
        panels[2].semilogx(cycles, np.rad2deg(result["wear_angle_error_rms"][1:]), **look)
    labels = ("wear depth [µm]", "peak pressure, mean over a cycle [MPa]", "vane-angle error, rms [°]")
    for axes, label in zip(panels, labels, strict=True):
        axes.set(xlabel="drive cycles", ylabel=label)
        axes.grid(alpha=0.3)
    panels[0].legend(title="clearance")
    panels[0].set_title("thin: without feedback", fontsize=9)
    figure.savefig(target / "wear_history.png", dpi=130)


def draw_shape(result: xr.Dataset, target: Path) -> None:
    """Worn profile from the upper edge inwards, and around that edge, at growing numbers of cycles."""
    figure, (along, around) = plt.subplots(1, 2, figsize=(11, 3.9), layout="constrained", sharey=True)
    depth = result["stage_depth"].values * 1e6
    deepest = int(np.argmax(depth[-1, :, -1]))
    picked = np.unique(np.searchsorted(result["stage_cycles"].values, [3e4, 1e5, 3e5, CYCLES]))
    theta = np.rad2deg(result["theta"].values)
    order = np.argsort((theta - 90.0) % 360.0)
    for k, stage in enumerate(picked):
        shade = plt.get_cmap("viridis")(0.85 * k / max(picked.size - 1, 1))
        label = f"{float(result['stage_cycles'][stage]):,.0f}".replace(",", " ")
        along.plot((result["z"][-1] - result["z"]) * 1e3, depth[stage, deepest], "o-", ms=3, color=shade)
        around.plot((theta[order] - 90.0) % 360.0 + 90.0, depth[stage, order, -1], color=shade, label=label)
    along.set(xlabel="distance from the upper edge [mm]", ylabel="wear depth [µm]", xlim=(-0.2, 8.0))
    along.set_title(f"at θ = {theta[deepest]:.0f}°; points: rows of nodes", fontsize=9)
    around.set(xlabel="bushing angle θ [°]")
    around.set_xticks([90, 180, 270, 360, 450], ["90", "180", "270", "0", "90"])
    around.set_title("around the upper edge", fontsize=9)
    around.legend(title="drive cycles")
    for axes in (along, around):
        axes.grid(alpha=0.3)
    figure.savefig(target / "wear_shape.png", dpi=130)


def main() -> None:
    """Draw all figures."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    results = {clearance: campaign(clearance) for clearance in CLEARANCES}
    draw_history(results, target)
    draw_shape(results["20 um"], target)


if __name__ == "__main__":
    main()
