"""Journals at rest and sliding: forces, moments and friction against quadrature of the contact law itself."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from mebdf.arrays import FloatArray
from tribodyn.contact import RSDC, SurfacePair
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.joint import pressure_field, wrench, wrench_and_jacobian
from tribodyn.kernels.joints.surface.memory import new_memory

MakeClearance = Callable[..., Clearance]
Pressure = Callable[[FloatArray], FloatArray]
FINE = (512, 32)  #: Nodes around and across.
QUADRATURE = 1e-6  #: Relative difference that the table (1e-7) and the grid may make.
MU = 0.1


@pytest.fixture(scope="module")
def pressure(table_1_pair: SurfacePair) -> Pressure:
    """The pressure of the contact law over the gap [m], not the table's."""
    chosen, reach = RSDC(table_1_pair), 8.0 * table_1_pair.roughness_rms

    def over(gap: FloatArray) -> FloatArray:
        pressures, near = np.zeros_like(gap), gap < reach
        pressures[near] = chosen.pressure(gap[near])
        return pressures

    return over


def gauss(first: float, last: float, n: int) -> tuple[FloatArray, FloatArray]:
    """Return points and weights of Gauss and Legendre."""
    points, weights = np.polynomial.legendre.leggauss(n)
    half = 0.5 * (last - first)
    return first + half * (1.0 + points), half * weights


def settle(data: SurfaceData, load: FloatArray, start: FloatArray, free: list[int]) -> FloatArray:
    """Return the displacement at which the joint carries ``load`` [N], by Newton on ``free`` components."""
    memory, d = new_memory(data), start.astype(float)
    out, jacobian = np.empty(6), np.empty((6, 12))
    for _ in range(60):
        wrench_and_jacobian(data, memory, 0, pose_at(d), out, jacobian)
        step = np.linalg.solve(jacobian[np.ix_(free, free)], -(out[free] + load[free]))
        d[free] += step * min(1.0, 1e-6 / np.abs(step).max())
        if np.abs(step).max() < 1e-16:
            return d
    raise AssertionError("did not settle")


def field(data: SurfaceData, d: FloatArray) -> FloatArray:
    """Return the pressures at all nodes at rest [Pa]."""
    pressures = np.empty(data.nodes.shape[1])
    pressure_field(data, new_memory(data), 0, pose_at(d), pressures)
    return pressures


def spinning(data: SurfaceData, d: FloatArray, speed: float) -> FloatArray:
    """Return the wrench on a journal that turns about its axis."""
    out = np.empty(6)
    wrench(data, new_memory(data), 0, pose_at(d, None, (0.0, 0.0, 0.0), (0.0, 0.0, speed)), out)
    return out


def test_a_pin_under_a_load(make_clearance: MakeClearance, pressure: Pressure) -> None:
    # F(e) = l r_b ∫ p(c − e cos θ) cos θ dθ towards the loaded side.
    c, r_b, length, load = 20e-6, 6.02e-3, 20e-3, 300.0

    theta, weight = gauss(0.0, 1.2, 300)

    def force(e: float) -> float:
        return float(2.0 * length * r_b * (weight * np.cos(theta)) @ pressure(c - e * np.cos(theta)))

    expected = brentq(lambda e: force(e) - load, 14e-6, 21e-6, xtol=1e-16)
    data = assemble([make_clearance("cylinder", grid=FINE)])
    found = settle(data, np.array([load * 0.6, load * 0.8, 0.0]), np.array([10e-6, 14e-6, 0.0]), [0, 1])
    np.testing.assert_allclose(found[:2], expected * np.array([0.6, 0.8]), rtol=QUADRATURE)


def test_a_collar_under_a_load_and_leaning(make_clearance: MakeClearance, pressure: Pressure) -> None:
    # Flat faces: W = p A. Leaning by φ about X, a collar is back at M = ∫ p(h + φ ρ sin θ) ρ sin θ ρ dρ dθ.
    area, load, lean = math.pi * (9e-3**2 - 6e-3**2), 150.0, 1e-4
    gap = brentq(lambda h: area * pressure(np.array([h]))[0] - load, 0.0, 10e-6, xtol=1e-16)
    data = assemble([make_clearance("annulus", grid=FINE)])
    found = settle(data, np.array([0.0, 0.0, -load]), np.array([0.0, 0.0, -16e-6]), [2])
    assert 20e-6 + found[2] == pytest.approx(gap, rel=QUADRATURE)

    theta, around = gauss(0.0, 2.0 * math.pi, 200)
    rho, across = gauss(6e-3, 9e-3, 40)
    height = np.outer(rho, np.sin(theta))
    expected = (across * rho) @ (pressure(gap + lean * height) * height) @ around
    out, leaning = np.empty(6), Rotation.from_rotvec([lean, 0.0, 0.0]).as_matrix()
    wrench(data, new_memory(data), 0, pose_at(found, leaning), out)
    # The angle is its own tangent to 3e-9.
    assert out[3] == pytest.approx(expected, rel=QUADRATURE)
    assert out[3] < 0.0


@pytest.mark.parametrize("latitude", [0.0, 0.5])
def test_a_ball_under_a_load(latitude: float, make_clearance: MakeClearance, pressure: Pressure) -> None:
    # F(d) = R² ∫∫ p(c − n·d) n dΩ over the band of the race.
    c, radius, band = 20e-6, 8.02e-3, 0.8
    d = 19.5e-6 * np.array([math.cos(latitude), 0.0, math.sin(latitude)])

    theta, around = gauss(-1.5, 1.5, 300)
    sine, across = gauss(-math.sin(band), math.sin(band), 150)
    n_x, n_z = np.outer(np.sqrt(1.0 - sine**2), np.cos(theta)), np.outer(sine, np.ones(300))
    pressures = radius**2 * pressure(c - n_x * d[0] - n_z * d[2])
    load = np.array([across @ (pressures * n_x) @ around, 0.0, across @ (pressures * n_z) @ around])
    data = assemble([make_clearance("sphere", grid=FINE)])
    found = settle(data, load, 0.99 * d, [0, 2])
    # QUADRATURE of a load that changes by e over less than a micrometre.
    np.testing.assert_allclose(found, d, rtol=0.0, atol=QUADRATURE * 1e-6)


def test_a_turning_pin_rubs_at_its_radius(make_clearance: MakeClearance) -> None:
    data, d = assemble([make_clearance("cylinder", coefficient=MU)]), np.array([19e-6, 0.0, 0.0])
    pushed = data.nodes[6] @ field(data, d)  # more than the load: pressures are not parallel
    load = -spinning(data, d, 0.0)[0]
    out = spinning(data, d, 5.0)
    # u_s is 1e-5 m/s, the slip 3e-2 m/s: 5e-8 of the traction is missing.
    assert out[5] == pytest.approx(-MU * 6e-3 * pushed, rel=1e-6)
    # Pressed to +X and turning about +Z, its surface moves along +Y there and is held back.
    assert out[1] == pytest.approx(-MU * load, rel=1e-6)


def test_a_ball_drills_under_an_axial_load(make_clearance: MakeClearance) -> None:
    # Turning about the load, a ball slides at R cos λ: M = −μ Σ A p R cos λ, and no force across.
    data = assemble([make_clearance("sphere", coefficient=MU, band=0.5 * math.pi, grid=(64, 64))])
    d = np.array([0.0, 0.0, 19e-6])
    out = spinning(data, d, 5.0)
    expected = -MU * np.sum(data.nodes[6] * field(data, d) * np.hypot(*data.nodes[:2]))
    # The patch reaches down to slips of 1e-3 m/s near the pole, where 5e-5 of the traction is missing.
    assert out[5] == pytest.approx(expected, rel=1e-4)
    # All around the pole the rest cancels, to rounding.
    np.testing.assert_allclose(out[[0, 1, 3, 4]], 0.0, rtol=0.0, atol=1e-11 * np.abs(out).max())


def test_sliding_takes_its_friction_from_turning(make_clearance: MakeClearance) -> None:
    # A collar that slides across much faster than it turns has the force of sliding and hardly any moment
    # left: traction follows the direction of slip, not each motion for itself.
    data = assemble([make_clearance("annulus", coefficient=MU)])
    d, out = np.array([0.0, 0.0, -16e-6]), np.empty(6)
    wrench(data, new_memory(data), 0, pose_at(d, None, (1.0, 0.0, 0.0), (0.0, 0.0, 0.1)), out)
    # The turning part of the slip is below 1e-3 of the sliding one.
    assert out[0] == pytest.approx(-MU * out[2], rel=1e-5)
    assert 0.0 < out[5] / spinning(data, d, 0.1)[5] < 2e-3


def test_a_turning_collar_rubs_at_its_mean_radius(make_clearance: MakeClearance) -> None:
    data = assemble([make_clearance("annulus", coefficient=MU)])
    out = spinning(data, np.array([0.0, 0.0, -16e-6]), 5.0)
    mean = 2.0 / 3.0 * (9e-3**3 - 6e-3**3) / (9e-3**2 - 6e-3**2)
    assert out[2] > 0.0
    # As for the pin.
    assert out[5] == pytest.approx(-MU * out[2] * mean, rel=1e-6)
