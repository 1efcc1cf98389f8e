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
        self,
        make: Callable[..., Clearance],
        pair: SurfacePair,
        sigma: float = 1e-9,
        along: int = 4,
        **sizes: float,
    ) -> None:
        tips = {"asperity_radius": 5e3 * sigma, "asperity_density": 1e-4 / sigma**2}
        smooth = dataclasses.replace(pair, roughness=(0.0, sigma), **tips)
        table = tabulate(law("gw", smooth))
        sizes = {"radius": RADIUS, "clearance": ROOM, "length": LENGTH} | sizes
        made = make("cylinder", grid=(2048, along), coefficient=0.0, table=table, **sizes)
        bulk = Bulk(table, sigma, MODULUS, made.shape.bore_radius)
        self.clearance = dataclasses.replace(made, roughness=sigma, bulk=bulk, hardness=math.inf)
        self.data = assemble([self.clearance])
        self.memory = new_memory(self.data)

    def report(self, off: float, rotation: FloatArray | None = None) -> Record:
        report(self.data, self.memory, 0, pose_at([off, 0.0, 0.0], rotation))
        return self.memory.reports[0]

    def under(self, force: float) -> tuple[float, float]:
        """Return half angle [rad] and largest pressure over E c/R under a force over E c."""
        room = self.clearance.shape.clearance
        size = MODULUS * LENGTH * room
        off = brentq(
            lambda off: -self.report(off)["F_cx"] / size - force, 0.99 * room, 40.0 * room, xtol=1e-15
        )
        largest = float(self.report(off)["p_max"]) * RADIUS / (MODULUS * room)
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
@pytest.mark.parametrize("room", [20e-6, 40e-6, 80e-6])
def test_sections_of_a_tilted_pin_are_those_of_a_long_one(
    make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair, room: float
) -> None:
    """It leans on an elastic half-space as curved as the clearance, and touches over 8° at its end."""
    pytest.importorskip("ContactMechanics")
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography

    n, width, depth = 128, 0.45 * RADIUS, 0.5 * math.radians(8.0) ** 2 * room
    x, z = ((np.arange(n) + 0.5) / n * size for size in (width, LENGTH))
    tilt = depth / (0.6 * LENGTH)
    tilted = tilt * (z - LENGTH)[None, :]
    heights = tilted - 0.5 * room * ((x - 0.5 * width)[:, None] / RADIUS) ** 2
    system = NonSmoothContactSystem(
        FreeFFTElasticHalfSpace((n, n), MODULUS, (width, LENGTH)),
        Topography(heights, physical_sizes=(width, LENGTH)),
    )
    load = 0.4 * MODULUS * LENGTH * depth
    result = system.minimize_proxy(external_force=load, pentol=1e-5 * depth, maxiter=2000)
    assert result.success
    pressures = np.abs(system.substrate.force[:n, :n]) * n**2 / (width * LENGTH)
    assert np.sum(pressures) * width * LENGTH / n**2 == pytest.approx(load, rel=1e-3)
    bore = Bore(make_clearance, table_1_pair, clearance=room)
    for section in (n - n // 8, n - n // 4, n - n // 3):
        pressure = pressures[:, section]
        half = 0.5 * width / n * np.count_nonzero(pressure > 1e-3 * pressure.max())
        angle, largest = bore.under(pressure.sum() * width / n / (MODULUS * room))
        assert half == pytest.approx(angle * RADIUS, rel=0.1)
        assert pressure.max() == pytest.approx(largest * MODULUS * room / RADIUS, rel=0.1)
    # The half-space goes on beyond the edge: the edge of the pin carries more, and the load acts further in.
    tilted_bore, turned = Bore(make_clearance, table_1_pair, along=32, clearance=room), np.eye(3)
    turned[0, 2], turned[2, 0] = tilt, -tilt
    off = brentq(lambda off: -tilted_bore.report(off, turned)["F_cx"] - load, 0.99 * room, 2.0 * room)
    found = tilted_bore.report(off, turned)
    within = np.sum(pressures, axis=0) @ (z - 0.5 * LENGTH) / np.sum(pressures)
    assert 0.6 < within / (found["M_cy"] / found["F_cx"]) < 0.75
