"""Draw the figures of the journal page: dry, too coarse, oil, Stribeck curve.

python docs/plots/journal.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import tribodyn as td
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.system import MechanismSystem
from tribodyn.papers.cheng_2022.figures import FIGURES, Runs

BLUE, VERMILION, GREY = "#0072b2", "#d55e00", "#767676"
COARSE, FINE = 2e-6, 1e-7  #: Fixed steps of the explicit run [s].


def fixed_step(
    case: MechanismCase, step: float, duration: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Walk a journal by Euler's explicit method with a fixed step, as no solver of tribodyn does.

    Returns times [s] and eccentricities [m].
    """
    problem = MechanismSystem(case).problem(duration)
    call, data, memory = problem.functions, problem.data, problem.memory
    y, rate = problem.y0.copy(), np.empty(problem.y0.size)
    times, eccentricities = [], []
    for t in np.arange(0.0, duration, step):
        times.append(t)
        eccentricities.append(np.hypot(y[0], y[1]))
        call.rhs(t, y, data, memory, rate)
        if not np.isfinite(rate).all():
            break
        y += step * rate
        call.advance(t, t + step, y, data, memory)
        call.accept(t + step, y, data, memory)
    return np.array(times), np.array(eccentricities)


def draw_coarse(target: Path) -> None:
    """Eccentricity of the undamped dry journal: MEBDF, and explicit Euler with two fixed steps."""
    case = td.load_case("journal-dry").replace(
        {"contact.law": "ke", "run.duration": "4 ms", "run.output_interval": "2 us"}
    )
    result = td.simulate(case)
    figure, axes = plt.subplots(figsize=(7.6, 3.4), layout="constrained")
    e = np.linalg.norm(result["displacement"].sel(joint="bearing"), axis=1)
    for step, colour in ((COARSE, VERMILION), (FINE, GREY)):
        t, coarse = fixed_step(case, step, 4e-3)
        label = f"explicit Euler, {step * 1e6:g} µs"
        axes.plot(t * 1e3, coarse * 1e6, color=colour, linewidth=0.9, label=label)
    axes.plot(result["time"] * 1e3, e * 1e6, color=BLUE, linewidth=1.1, label="MEBDF")
    axes.axhline(20.0, color="black", linewidth=0.8, dashes=(4, 2), label="clearance")
    axes.set(xlabel="time [ms]", ylabel="eccentricity [µm]", ylim=(0.0, 30.0))
    axes.legend(frameon=False, fontsize=8, ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    save(figure, axes, target / "journal_coarse.png")


def draw_stribeck(target: Path) -> None:
    """Friction coefficient, and shares of the load, over the speed of rotation."""
    case = td.load_case("journal-oil").replace({"joints.bearing.clearance.friction_coefficient": 0.1})
    curve = td.stribeck(case, np.geomspace(0.5, 3000.0, 60)).isel(viscosity=0)
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.6, 5.0), sharex=True, layout="constrained")
    least = int(curve.friction_coefficient.argmin("speed"))
    top.loglog(curve.speed, curve.friction_coefficient, color="black")
    top.plot(curve.speed[least], curve.friction_coefficient[least], "o", mfc="white", mec="black")
    top.set(ylabel="friction coefficient [1]")
    bottom.semilogx(curve.speed, curve.film_share, color=BLUE, label="oil film")
    bottom.semilogx(curve.speed, curve.contact_share, color=VERMILION, linestyle="--", label="asperities")
    bottom.set(xlabel="speed of rotation [rad/s]", ylabel="share of the load [1]")
    bottom.legend(frameon=False, fontsize=8)
    top.grid(alpha=0.25)
    save(figure, bottom, target / "journal_stribeck.png")


def save(figure: plt.Figure, axes: plt.Axes, path: Path) -> None:
    """Write a figure."""
    axes.grid(alpha=0.25)
    for part in figure.axes:
        part.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Draw all figures."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    plt.switch_backend("agg")
    runs = Runs()
    for name, drawn in (("journal_dry", FIGURES["fig8"]), ("journal_oil", FIGURES["fig9"])):
        drawn.draw(drawn.data(runs, "exact")).savefig(target / f"{name}.png", dpi=110)
    draw_coarse(target)
    draw_stribeck(target)


if __name__ == "__main__":
    main()
