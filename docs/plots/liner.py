"""Draw the thin elastic layer beside layers of any thickness, and what a liner does to the vane mechanism.

python docs/plots/liner.py OUTPUT_DIRECTORY

The reference is a layer bonded to a rigid base in plane strain: a wave e^{ikx} of pressure sinks by
u/p = (2(1 − ν²)/E) L(kt)/k with L of Meijers (1968), Appl. Sci. Res. 18, 353. A rigid parabola is pressed
into it on a grid, and points that would be pulled are let go.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from scipy.linalg import toeplitz

import tribodyn as td
from tribodyn.contact import Liner

POISSON = 0.34
RATIOS = (10.0, 1.0)  #: Half width of the contact over the thickness.
THICKNESSES = (0.0, 0.25, 0.5, 1.0, 1.5, 2.0)  #: Of the liner of the vane's bushing [mm].
POINTS = 200
CYCLES = 2


class Pressed(NamedTuple):
    """A rigid parabola x²/2R in a layer, E = R = 1: places and pressures, shape (n,)."""

    x: np.ndarray
    pressure: np.ndarray

    @property
    def load(self) -> float:
        """Load per length."""
        return float(self.pressure.sum() * (self.x[1] - self.x[0]))


def compliance(wave: np.ndarray, thickness: float, poisson: float) -> np.ndarray:
    """Return u/p for each wave number k, shape of ``wave``, E = 1."""
    kappa = 3.0 - 4.0 * poisson
    a = np.minimum(np.maximum(wave * thickness, 1e-9), 50.0)
    top = 2.0 * kappa * np.sinh(2.0 * a) - 4.0 * a
    ratio = top / (2.0 * kappa * np.cosh(2.0 * a) + 4.0 * a**2 + 1.0 + kappa**2)
    return 2.0 * (1.0 - poisson**2) * ratio * thickness / np.maximum(wave * thickness, 1e-9)


def press(depth: float, thickness: float, poisson: float, points: int = POINTS) -> Pressed:
    """Press the parabola ``depth`` deep into a layer."""
    half = 1.5 * np.sqrt(2.0 * depth)
    x, spacing = np.linspace(-half, half, 2 * points + 1, retstep=True)
    period = 1 << int(np.ceil(np.log2(2.0 * (2.0 * half + 20.0 * thickness) / spacing)))
    wave = 2.0 * np.pi * np.fft.rfftfreq(period, spacing)
    influence = np.fft.irfft(compliance(wave, thickness, poisson), period)[: x.size]
    matrix = toeplitz(influence)
    touching = np.ones(x.size, dtype=bool)
    pressure = np.zeros(x.size)
    while True:
        pressure[:] = 0.0
        pressure[touching] = np.linalg.solve(
            matrix[np.ix_(touching, touching)], depth - 0.5 * x[touching] ** 2
        )
        if (pressure >= 0.0).all():
            return Pressed(x, pressure)
        touching &= pressure > 0.0


def of_thin_layer(load: float, thickness: float, poisson: float) -> tuple[float, float]:
    """Return half width and peak pressure of a thin layer under a load: p = k_w(a² − x²)/2."""
    stiffness = Liner(thickness, 1.0, poisson).stiffness
    half_width = (1.5 * load / stiffness) ** (1.0 / 3.0)
    return half_width, 0.5 * stiffness * half_width**2


def of_vane(thickness: float) -> tuple[float, float, float]:
    """Return peak pressure [MPa] and gap [µm] in the middle of a stroke, and the wear of 1000 cycles [nm]."""
    changes = {"joint.liner.thickness": f"{thickness} mm"} if thickness else {}
    run = td.simulate(td.load_case("vsv").replace(changes | {"run.cycles": CYCLES}))
    middle = run.sel(time=1.25 * run.attrs["cycle_period"], method="nearest")
    return (
        float(middle.p_max) * 1e-6,
        float(middle.separation_min) * 1e6,
        float(run.wear_depth.max()) / CYCLES * 1e12,
    )


def draw(target: Path) -> None:
    """Draw pressures under a parabola, and the vane mechanism over the thickness of its liner."""
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
    for axis, ratio in zip(axes, RATIOS, strict=False):
        depth = 0.5e-4
        thickness = np.sqrt(2.0 * depth) / ratio
        exact = press(depth, thickness, POISSON)
        half_width, peak = of_thin_layer(exact.load, thickness, POISSON)
        place = exact.x / half_width
        axis.plot(place, exact.pressure / peak, "C0", label="layer, exact")
        axis.plot(place, np.maximum(1.0 - place**2, 0.0), "k--", label="thin layer")
        axis.set(xlabel="x / a", ylabel="pressure / peak of the thin layer", title=f"a = {ratio:g} t")
        axis.legend(fontsize="small")
    found = np.transpose([of_vane(t) for t in THICKNESSES])
    axes[2].plot(THICKNESSES, found[0], "o-", label="largest pressure at mid-stroke [MPa]")
    axes[2].plot(THICKNESSES, found[2], "s-", label="wear [nm / 1000 cycles]")
    axes[2].set(xlabel="thickness of the liner [mm]", title="vane mechanism", ylim=(0, None))
    axes[2].legend(fontsize="small")
    for row in zip(THICKNESSES, *found, strict=True):
        print("  " + "".join(f"{value:10.4g}" for value in row))
    for axis in axes:
        axis.grid(True, color="0.9")
    figure.savefig(target / "liner.png", dpi=150)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    draw(folder)
