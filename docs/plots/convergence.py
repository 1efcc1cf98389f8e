"""Draw the convergence figures of the manual: forces over the grid, results over the tolerance, v_min.

python docs/plots/convergence.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import tribodyn as td
from tribodyn.joints import Grid
from tribodyn.joints.bushing import joint_wrench
from tribodyn.mechanisms.bushing import grid_of
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

REVERSAL = np.pi
DURATION = "4 s"
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
REFERENCE = 1e-7
GRIDS = ((32, 8), (48, 12), (64, 16), (96, 24), (128, 32), (192, 48))
FINEST = (384, 96)
CLEARANCES = {"20 um": "o-", "40 um": "s-", "80 um": "^-", "160 um": "d-"}


def run(changes: dict[str, object]) -> xr.Dataset:
    """Simulate the built-in case with some changes."""
    return td.simulate(td.load_case("vsv").replace({"run.duration": DURATION, **changes}))


def tolerance_changes(rtol: float) -> dict[str, object]:
    """Return relative and absolute tolerances that shrink together."""
    share = rtol / 1e-4
    return {
        "solver.rtol": rtol,
        "solver.atol.position": f"{1e-11 * share} m",
        "solver.atol.tilt": f"{1e-9 * share} rad",
        "solver.atol.velocity": f"{1e-7 * share} m/s",
        "solver.atol.tilt_rate": f"{1e-5 * share} rad/s",
    }


def smooth(dataset: xr.Dataset) -> xr.Dataset:
    """Leave out 100 ms after a reversal."""
    time = dataset["time"]
    return dataset.isel(time=((time < REVERSAL) | (time > REVERSAL + 0.1)).values)


def draw_tolerance(target: Path) -> None:
    """Errors against a reference run, and energy residuals, over the relative tolerance."""
    reference = smooth(run(tolerance_changes(REFERENCE)))
    angle, force, whole, clearance = [], [], [], []
    for rtol in TOLERANCES:
        result = run(tolerance_changes(rtol))
        part = smooth(result)
        angle.append(np.rad2deg(float(abs(part["theta_v"] - reference["theta_v"]).max())))
        size = np.hypot(reference["F_cx"], reference["F_cy"])
        off = np.hypot(part["F_cx"] - reference["F_cx"], part["F_cy"] - reference["F_cy"])
        force.append(100.0 * float((off / size).max()))
        whole.append(100.0 * result.attrs["energy_residual"])
        clearance.append(100.0 * result.attrs["clearance_energy_residual"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    left.loglog(TOLERANCES, angle, "o-", label="vane angle [°]")
    left.loglog(TOLERANCES, force, "s--", label="contact force [%]")
    left.set(xlabel="solver.rtol", ylabel="largest error", title="against rtol = 1e-7")
    right.loglog(TOLERANCES, clearance, "o-", label="clearance motion")
    right.loglog(TOLERANCES, whole, "s--", label="whole mechanism")
    right.axhline(1.0, color="0.5", linewidth=0.8)
    right.set(xlabel="solver.rtol", ylabel="energy residual [%]", title="the warning comes at 1 %")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.legend()
    figure.savefig(target / "tolerance_convergence.png", dpi=130)
    for rtol, *numbers in zip(TOLERANCES, angle, force, whole, clearance, strict=True):
        print(
            f"rtol {rtol:g}: angle {numbers[0]:.2g} deg, force {numbers[1]:.2g} %, "
            f"residuals {numbers[2]:.2g} % and {numbers[3]:.2g} %"
        )


def grid_errors(case: VsvCase, result: xr.Dataset) -> list[float]:
    """Return the largest force error of each grid [%] over attitudes of a run, against the finest grid."""
    joint = vsv_of(case).joint
    rows = np.unique(np.linspace(0, result.sizes["time"] - 1, 60).astype(int))
    names = ("e_x", "e_y", "phi_x", "phi_y")
    attitudes = [np.append([float(result[name][i]) for name in names], np.zeros(4)) for i in rows]

    def forces(grid: tuple[int, int]) -> np.ndarray:
        data = replace(joint, grid=Grid(*grid)).data()
        return np.array([joint_wrench(data, attitude)[:2] for attitude in attitudes])

    exact = forces(FINEST)
    loaded = np.linalg.norm(exact, axis=1) > 1.0
    size = np.linalg.norm(exact[loaded], axis=1)
    return [
        100.0 * float((np.linalg.norm(forces(grid)[loaded] - exact[loaded], axis=1) / size).max())
        for grid in GRIDS
    ]


def draw_grid(target: Path) -> None:
    """Force errors over the number of nodes, and which grid is taken by default."""
    figure, axes = plt.subplots(figsize=(6.2, 3.8), layout="constrained")
    nodes = [theta * z for theta, z in GRIDS]
    for clearance, style in CLEARANCES.items():
        case = td.load_case("vsv").replace({"joint.clearance": clearance, "run.duration": DURATION})
        errors = grid_errors(case, td.simulate(case))
        (line,) = axes.loglog(nodes, errors, style, label=clearance.replace("um", "µm"))
        axes.axvline(math.prod(grid_of(case)), color=line.get_color(), linewidth=0.8, linestyle=":")
        for grid, error in zip(GRIDS, errors, strict=True):
            print(f"clearance {clearance}, grid {grid[0]} x {grid[1]}: force error {error:.2g} %")
    axes.axhline(0.5, color="0.5", linewidth=0.8)
    axes.set(xlabel="nodes (θ × z)", ylabel="largest force error [%]")
    axes.set_title(f"against {FINEST[0]} × {FINEST[1]}; dotted: the default of each; grey: the warning")
    axes.set_xticks(nodes, [f"{theta}×{z}" for theta, z in GRIDS], minor=False, rotation=30)
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(target / "grid_convergence.png", dpi=130)


def draw_entry_velocity(target: Path) -> None:
    """Attitude and peak force over the least entry velocity, an assumption."""
    floors = ("1 um/s", "10 um/s", "100 um/s", "1 mm/s", "10 mm/s")
    results = [run({"contact.minimum_entry_velocity": floor}) for floor in floors]
    reference = smooth(results[3])
    times = np.linspace(0.1, 3.0, 200)
    at = {name: np.interp(times, reference["time"], reference[name]) for name in ("e_x", "e_y")}
    shift = []
    for result in results:
        moved = [np.interp(times, result["time"], result[name]) - at[name] for name in ("e_x", "e_y")]
        shift.append(1e6 * float(np.hypot(*moved).max()))
    peak = [float(result["contact_force_impact"].max()) for result in results]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    left.bar(floors, shift, color="#0072b2")
    left.set(ylabel="shift of the trunnion centre [µm]", title="smooth motion, against 1 mm/s")
    right.bar(floors, peak, color="#d55e00")
    right.set(ylabel="peak contact force [N]", title="impact after the reversal")
    for axes in (left, right):
        axes.set_xlabel("contact.minimum_entry_velocity")
    figure.savefig(target / "entry_velocity.png", dpi=130)
    for floor, moved_by, force in zip(floors, shift, peak, strict=True):
        print(f"v_min {floor}: shift {moved_by:.3g} um, peak {force:.3g} N")


def main() -> None:
    """Draw all figures."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    plt.switch_backend("agg")
    draw_grid(target)
    draw_tolerance(target)
    draw_entry_velocity(target)


if __name__ == "__main__":
    main()
