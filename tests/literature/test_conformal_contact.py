"""A pin in an elastic bore against solutions without a foundation: Fourier modes, Persson, boundary elements.

Lengths are in radii, pressures in the composite modulus. A pressure p cos nθ moves the wall of a hole
outwards by C p, 2 G C = (κ + n − 1)/2(n − 1) − n/2(n + 1), and the rim of a disc inwards by
(κ − n − 1)/2(n + 1) + n/2(n − 1); n = 1 is a rigid displacement. Persson's closed form, for two bodies of one
material: Ciavarella and Decuzzi (2001), Int. J. Solids Struct. 38, 4507.
"""

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from mebdf.arrays import FloatArray
from tribodyn.contact import SurfacePair, law, tabulate
from tribodyn.contact.bulk import Bulk
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.joint import pressure_field, report
from tribodyn.kernels.joints.surface.memory import new_memory

NU = 0.3
KAPPA = 3.0 - 4.0 * NU
RADIUS, ROOM, LENGTH, MODULUS = 10e-3, 40e-6, 20e-3, 8e9
#: Over these the load grows by three and a half decades.
HALF_ANGLES = (4.0, 8.0, 15.0, 30.0, 45.0, 60.0, 70.0)


def pressed(degrees: float, *, rigid_pin: bool) -> tuple[float, float, float]:
    """Return half angle [rad], force over E c and largest pressure over E c/R, by Fourier modes."""
    m = int(min(4 * max(720 * 15 / degrees, 360), 5760)) // 4 * 4
    n, step = np.arange(m // 2, dtype=float), 2.0 * math.pi / m
    less, more = np.maximum(n - 1.0, 1e-9), n + 1.0
    hole = np.where(n > 1.0, (KAPPA + n - 1.0) / (2.0 * less) - n / (2.0 * more), 0.0)
    disc = np.where(n > 1.0, (KAPPA - n - 1.0) / (2.0 * more) + n / (2.0 * less), 0.0)
    hole[0], disc[0] = 1.0, 0.5 * (KAPPA - 1.0)
    weight = np.zeros(m)
    weight[: n.size] = hole if rigid_pin else 0.5 * (hole + disc)
    weight *= np.where(np.arange(m) > 0, step / math.pi, step / (2.0 * math.pi)) / (1.0 - NU)
    kernel, half = np.real(np.fft.fft(weight)), round(math.radians(degrees) / step)
    theta = (np.arange(-half, half) + 0.5) * step
    across = np.arange(2 * half)
    matrix = kernel[np.abs(across[:, None] - across[None, :])]
    turned, flat = np.linalg.solve(matrix, np.stack([np.cos(theta), np.ones(2 * half)], axis=1)).T
    pressure = flat[0] / turned[0] * turned - flat  # zero at the edge
    return (half - 0.5) * step, float(pressure @ np.cos(theta)) * step, float(pressure.max())


def persson(angle: float) -> float:
    """Return force over E c at a half angle [rad], two bodies of one material."""
    b = math.tan(0.5 * angle)

    def inside(t: float) -> float:
        far, near = math.sqrt(b * b + 1.0), math.sqrt(b * b - t * t)
        return math.log((far + near) / (far - near)) / (1.0 + t * t)

    seventh = quad(inside, -b, b)[0]
    of_one = 2.0 * (1.0 - b * b) / (math.pi * b * b) - seventh / (math.pi**2 * b * b * (1.0 + b * b))
    return 2.0 / of_one


class Bore:
    """A long smooth pin in its bore, at rest."""

    def __init__(
        self, make: Callable[..., Clearance], pair: SurfacePair, sigma: float = 1e-9, **sizes: float
    ) -> None:
        tips = {"asperity_radius": 5e3 * sigma, "asperity_density": 1e-4 / sigma**2}
        smooth = dataclasses.replace(pair, roughness=(0.0, sigma), **tips)
        table = tabulate(law("gw", smooth))
        sizes = {"radius": RADIUS, "clearance": ROOM, "length": LENGTH} | sizes
        made = make("cylinder", grid=(2048, 4), coefficient=0.0, table=table, **sizes)
        bulk = Bulk(table, sigma, MODULUS, made.shape.bore_radius)
        self.clearance = dataclasses.replace(made, roughness=sigma, bulk=bulk, hardness=math.inf)
        self.data = assemble([self.clearance])
        self.memory = new_memory(self.data)

    def report(self, off: float, rotation: FloatArray | None = None) -> Record:
        report(self.data, self.memory, 0, pose_at([off, 0.0, 0.0], rotation))
        return self.memory.reports[0]

    def under(self, force: float) -> tuple[float, float]:
        """Return half angle [rad] and largest pressure over E c/R under a force over E c."""
        size = MODULUS * LENGTH * ROOM
        off = brentq(
            lambda off: -self.report(off)["F_cx"] / size - force, 0.99 * ROOM, 40.0 * ROOM, xtol=1e-15
        )
        largest = float(self.report(off)["p_max"]) * RADIUS / (MODULUS * ROOM)
        field = np.empty(self.memory.entry_velocity.size)
        pressure_field(self.data, self.memory, 0, pose_at([off, 0.0, 0.0]), field)
        around = field.reshape(-1, 2048)[2]
        theta = 2.0 * math.pi * np.arange(2048) / 2048
        # Of a parabola: less than a hundredth of its largest pressure is not a contact.
        pressing = np.abs(np.where(theta > math.pi, theta - 2.0 * math.pi, theta))[
            around > 0.01 * around.max()
        ]
        return float(pressing.max()) / math.sqrt(0.99), largest


@pytest.fixture(scope="module")
def bore(make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair) -> Bore:
    return Bore(make_clearance, table_1_pair)


@pytest.mark.parametrize("degrees", HALF_ANGLES[1:6])
def test_fourier_modes_agree_with_persson(degrees: float) -> None:
    angle, force, _ = pressed(degrees, rigid_pin=False)
    assert force == pytest.approx(persson(angle), rel=0.02)


@pytest.mark.parametrize("rigid_pin", [True, False])
@pytest.mark.parametrize("degrees", HALF_ANGLES)
def test_angle_and_largest_pressure_under_a_load(bore: Bore, degrees: float, rigid_pin: bool) -> None:
    angle, force, largest = pressed(degrees, rigid_pin=rigid_pin)
    found, pressure = bore.under(force)
    assert found == pytest.approx(angle, rel=0.05)
    assert pressure == pytest.approx(largest, rel=0.05)


def test_hertz(make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair) -> None:
    """F' = π E a² c/4R², p₀ = 2F'/πa: Johnson (1985), section 4.2(c)."""
    angle = math.radians(2.0)
    force = 0.25 * math.pi * angle**2
    found, pressure = Bore(make_clearance, table_1_pair, 1e-10).under(force)
    assert pressure == pytest.approx(2.0 * force / (math.pi * angle), rel=0.01)
    assert found == pytest.approx(angle, abs=math.pi / 2048)  # as fine as nodes are


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("slope", [0.003, 0.03, 0.3])
def test_sections_of_a_tilted_pin_are_those_of_a_long_one(slope: float) -> None:
    """A cylinder of radius 1 leans on a half-space of modulus 1; it ends where it is deepest."""
    pytest.importorskip("ContactMechanics")
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography

    n, sizes = 128, (6.0 * math.sqrt(2.0 * slope), 1.6)
    x, z = ((np.arange(n) + 0.5) / n * size for size in sizes)
    heights = slope * (z - sizes[1])[None, :] - 0.5 * (x - 0.5 * sizes[0])[:, None] ** 2
    system = NonSmoothContactSystem(
        FreeFFTElasticHalfSpace((n, n), 1.0, sizes), Topography(heights, physical_sizes=sizes)
    )
    load = 0.25 * math.pi * slope * (2.0 * slope) ** 0.2  # so that contacts are about as long as 1
    result = system.minimize_proxy(external_force=load, pentol=1e-8 * slope, maxiter=2000)
    assert result.success
    cell = sizes[0] * sizes[1] / n**2
    pressures = np.abs(system.substrate.force[:n, :n]) / cell
    for section in (n - n // 4, n - n // 3):
        pressure = pressures[:, section]
        per_length, largest = pressure.sum() * sizes[0] / n, pressure.max()
        half = 0.5 * sizes[0] / n * np.count_nonzero(pressure > 1e-3 * largest)
        assert half == pytest.approx(math.sqrt(4.0 * per_length / math.pi), rel=0.1)
        assert largest == pytest.approx(2.0 * per_length / (math.pi * half), rel=0.1)
