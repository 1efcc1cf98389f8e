"""Draw the Greenwood-Williamson law of generated surfaces beside boundary elements on the same surfaces.

python docs/plots/bem.py OUTPUT_DIRECTORY

Two surfaces, one with few wavelengths and one with many, are pressed elastically on a rigid plane. The solver
is that of the package ContactMechanics: a periodic half-space by FFT, constrained conjugate gradients. The
law has no free parameter: density, radius and roughness follow from the known spectrum.
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

from tribodyn.contact import ContactLaw, SurfacePair, law
from tribodyn.surfaces import SelfAffine, asperities, generate

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography

POINTS = 512
SPACING = 1e-6
SEEDS = (1, 2, 3)
MODULUS = 1e9
SURFACES = {
    "few wavelengths": SelfAffine(1e-6, 0.8, roll_off=16e-6, shortest=8e-6),
    "many wavelengths": SelfAffine(1e-6, 0.8, roll_off=64e-6, shortest=6e-6),
}
LOADS = np.geomspace(3e-4, 0.2, 8)  #: Pressure over composite modulus and root-mean-square gradient.


class Solution(NamedTuple):
    """What the boundary elements give at each load, means over the seeds, shape (loads,)."""

    pressure: np.ndarray
    separation: np.ndarray
    area: np.ndarray


def solve(spectrum: SelfAffine, points: int = POINTS, seeds: tuple[int, ...] = SEEDS) -> Solution:
    """Press surfaces of a spectrum on a plane: pressure over modulus, mean gap over σ, share of real area."""
    gradient = (2.0 * spectrum.moments(2).m2) ** 0.5
    runs = [press(generate(spectrum, (points, points), SPACING, seed).heights, gradient) for seed in seeds]
    return Solution(gradient * LOADS, *np.mean(runs, axis=0) / np.array([[spectrum.sigma], [1.0]]))


def press(heights: np.ndarray, gradient: float) -> np.ndarray:
    """Return mean gap [m] and share of real area of one surface at each load, shape (2, loads)."""
    size = tuple(n * SPACING for n in heights.shape)
    half_space = PeriodicFFTElasticHalfSpace(heights.shape, MODULUS, size)
    system = NonSmoothContactSystem(half_space, Topography(heights, size, periodic=True))
    found, displacements = [], None
    # From the largest load on: less touches each time, which takes two thirds of the iterations.
    for load in LOADS[::-1]:
        force = load * gradient * MODULUS * size[0] * size[1]
        result = system.minimize_proxy(
            external_force=force,
            initial_displacements=displacements,
            pentol=3e-3 * heights.std(),
            maxiter=3000,
        )
        if not result.success:
            raise RuntimeError(f"the boundary elements did not converge at the load {load:.3g}")
        displacements = result.x
        found.append((np.mean(result.x - heights - result.offset), np.mean(result.jac > 0.0)))
    return np.transpose(found[::-1])


def statistical_law(spectrum: SelfAffine, separation_from: str = "surface") -> ContactLaw:
    """Return the Greenwood-Williamson law of a spectrum, with the modulus of the boundary elements."""
    found = asperities(spectrum.moments(2))
    pair = SurfacePair((1e30, MODULUS), (0.0, 0.0), (0.0, spectrum.sigma), 1e9, found.density, found.radius)
    return law("gw", pair, separation_from=separation_from)


def draw(target: Path) -> None:
    """Draw pressure over separation, its ratio over the real area, and the area over the load."""
    figure, axes = plt.subplots(2, 2, figsize=(9, 7), layout="constrained")
    ratios: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    h = np.linspace(0.0, 4.0, 200)
    for curve, (name, spectrum), marker, colour in zip(
        axes[0], SURFACES.items(), "os", ("C0", "C1"), strict=True
    ):
        solution, summits = solve(spectrum), statistical_law(spectrum)
        alpha = asperities(spectrum.moments(2)).bandwidth
        curve.semilogy(solution.separation, solution.pressure, marker + colour, label="boundary elements")
        for label, dash, choice in (
            ("summits of the spectrum", "-", "surface"),
            ("summits around the mean plane", ":", "asperities"),
        ):
            values = statistical_law(spectrum, choice).stiffness_pressure(h) / MODULUS
            curve.semilogy(h, values, dash + "k", label=f"law, {label}")
        curve.set(
            xlabel="separation h/σ", ylabel="pressure / E", title=f"{name}: α = {alpha:.1f}", ylim=(1e-6, 0.3)
        )
        ratio = summits.stiffness_pressure(solution.separation) / (MODULUS * solution.pressure)
        axes[1, 0].semilogx(solution.area, ratio, f"{marker}-{colour}", label=name)
        axes[1, 1].loglog(LOADS, solution.area, marker + colour, label=name)
        area = summits.real_area_fraction(h)
        load = summits.stiffness_pressure(h) / MODULUS / (2.0 * spectrum.moments(2).m2) ** 0.5
        axes[1, 1].loglog(load, area, "-" + colour, linewidth=0.8, label=f"law, {name}")
        ratios[name] = solution.area, ratio
    axes[1, 0].axhline(1.0, color="k", linewidth=0.8)
    axes[1, 0].axhspan(0.8, 1.25, color="0.9")
    axes[1, 0].set(
        xlabel="real contact area, share", ylabel="pressure of the law / boundary elements", ylim=(0, 1.4)
    )
    axes[1, 1].set(
        xlabel="pressure / (E · rms gradient)",
        ylabel="real contact area, share",
        xlim=(5e-5, 0.5),
        ylim=(1e-4, 1),
    )
    for axis in axes.flat:
        axis.grid(True, which="major", color="0.9")
        axis.legend(fontsize="small")
    figure.savefig(target / "bem.png", dpi=150)
    (target / "bem.md").write_text(table(ratios), encoding="utf-8")


def table(ratios: dict[str, tuple[np.ndarray, np.ndarray]]) -> str:
    """Return real areas and pressures of the law over those of the boundary elements as a table."""
    lines = [f"| {' | '.join(f'{name}: real area | law over elements' for name in ratios)} |"]
    lines.append("|---" * (2 * len(ratios)) + "|")
    for row in zip(*(zip(*pair, strict=True) for pair in ratios.values()), strict=True):
        lines.append(f"| {' | '.join(f'{100.0 * area:.2g} % | {ratio:.2f}' for area, ratio in row)} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    draw(folder)
