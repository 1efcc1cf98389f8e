"""Moments of surfaces that are known in closed form, and what Nayak's theory makes of them."""

import math

import numpy as np
import pytest
from scipy import integrate

from tribodyn.surfaces import Scan, SelfAffine, analyse, asperities, generate, moments

WAVE = 16e-6
Q = 2.0 * math.pi / WAVE
STEP = 1e-6
# The seven-point rule at sixteen points to the wave: (2π/16)⁶/140 of a slope, /560 of a curvature, twice that
# of their squares. The rest is rounding of heights before they are differenced twice.
SLOPE = 2.1 * (2.0 * math.pi / 16) ** 6 / 140.0
CURVATURE = 2.1 * (2.0 * math.pi / 16) ** 6 / 560.0


def test_a_sine() -> None:
    # Whole waves inside the points that the rule reaches, so that the means are those over a period.
    x = np.arange(16 * 40 + 6) * STEP
    found = moments(Scan(1e-6 * np.sin(Q * x), (STEP,)))
    assert found.m0 == pytest.approx(0.5e-12, rel=0.02)  # six points more than whole waves
    assert found.m2 == pytest.approx(0.5e-12 * Q**2, rel=SLOPE)
    assert found.m4 == pytest.approx(0.5e-12 * Q**4, rel=CURVATURE)


def test_crossed_sines() -> None:
    y, x = np.mgrid[: 16 * 8 + 6, : 16 * 10 + 6] * STEP
    scan = Scan(1e-6 * np.sin(Q * x) + 0.5e-6 * np.sin(Q * y), (STEP, STEP))
    found = moments(scan)
    x_part, y_part = 0.5e-12, 0.5 * 0.25e-12
    assert found.directional.m2_x == pytest.approx(x_part * Q**2, rel=SLOPE)
    assert found.directional.m2_y == pytest.approx(y_part * Q**2, rel=SLOPE)
    assert found.directional.m4_x == pytest.approx(x_part * Q**4, rel=CURVATURE)
    assert found.directional.m4_y == pytest.approx(y_part * Q**4, rel=CURVATURE)
    assert abs(found.directional.lay) == pytest.approx(math.pi / 2.0, abs=1e-6)
    assert found.directional.texture == pytest.approx(0.5, rel=SLOPE)
    assert found.m2 == pytest.approx(0.5 * (x_part + y_part) * Q**2, rel=SLOPE)
    assert found.m4 == pytest.approx(0.375 * (x_part + y_part) * Q**4, rel=CURVATURE)


@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0, 90.0, 130.0])
def test_the_means_over_directions_do_not_know_the_axes(angle: float) -> None:
    y, x = np.mgrid[:512, :512] * STEP
    along = math.cos(math.radians(angle)) * x + math.sin(math.radians(angle)) * y
    found = moments(Scan(1e-6 * np.cos(Q * along), (STEP, STEP)))
    # The map holds no whole number of waves: 1/(2·512/16·2π) of a mean, from each of two borders.
    assert found.m2 == pytest.approx(0.25e-12 * Q**2, rel=1e-2)
    assert found.m4 == pytest.approx(0.375 * 0.5e-12 * Q**4, rel=1e-2)
    across = (np.degrees(found.directional.lay) + 90.0 - angle) % 180.0
    assert min(across, 180.0 - across) < 0.1


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8])
@pytest.mark.parametrize("dimension", [1, 2])
def test_the_moments_of_a_spectrum_are_integrals_over_it(hurst: float, dimension: int) -> None:
    spectrum = SelfAffine(0.7e-6, hurst, roll_off=50e-6, shortest=5e-6)
    measure = {1: lambda q: 1.0 / math.pi, 2: lambda q: q / (2.0 * math.pi)}[dimension]
    first, last = 2.0 * math.pi / 50e-6, 2.0 * math.pi / 5e-6

    def integral(order: int) -> float:
        def density(q: float) -> float:
            return q**order * measure(q) * float(spectrum.density(np.array(q), dimension))

        parts = [integrate.quad(density, *ends, epsrel=1e-11) for ends in ((0.0, first), (first, last))]
        return sum(part[0] for part in parts)

    exact = spectrum.moments(dimension)
    share = {1: (1.0, 1.0), 2: (0.5, 0.375)}[dimension]
    assert exact.m0 == pytest.approx(0.49e-12, rel=1e-12)
    assert integral(0) == pytest.approx(exact.m0, rel=1e-9)
    assert share[0] * integral(2) == pytest.approx(exact.m2, rel=1e-9)
    assert share[1] * integral(4) == pytest.approx(exact.m4, rel=1e-9)


@pytest.mark.parametrize("hurst", [0.3, 0.8])
@pytest.mark.parametrize("seed", [1, 2])
def test_moments_of_a_map_with_a_known_spectrum_are_recovered(hurst: float, seed: int) -> None:
    spectrum = SelfAffine(1e-6, hurst, roll_off=64e-6, shortest=8e-6)
    found = analyse(generate(spectrum, (512, 768), 1e-6, seed)).moments
    _within_two_percent(found, spectrum.moments(2))


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_moments_of_a_profile_with_a_known_spectrum_are_recovered(hurst: float) -> None:
    spectrum = SelfAffine(1e-6, hurst, roll_off=100e-6, shortest=8e-6)
    found = analyse(generate(spectrum, (20_000,), 1e-6, 1)).moments
    _within_two_percent(found, spectrum.moments(1))


def _within_two_percent(found: object, exact: object) -> None:
    """The asked bound: what is lost is the waves as long as the scan, which its level takes off."""
    for name in ("m0", "m2", "m4"):
        assert getattr(found, name) == pytest.approx(getattr(exact, name), rel=0.02), name


def test_the_theory_counts_the_summits_there_are() -> None:
    """Nayak's density, mean curvature, height and spread of summits against those of a fine map."""
    spectrum = SelfAffine(1e-6, 0.8, roll_off=64e-6, shortest=16e-6)
    scan = generate(spectrum, (1024, 1024), 1e-6, 1)
    z, inside = scan.heights, scan.heights[1:-1, 1:-1]
    around = [z[1 + i : 1023 + i, 1 + j : 1023 + j] for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
    summits = np.all([inside > other for other in around], axis=0)
    laplacian = sum(around[k] for k in (1, 3, 4, 6)) - 4.0 * inside
    expected = asperities(spectrum.moments(2))
    # Some thousand summits: a scatter of 3 % of their number and of 2 % of their spread. The grid, with
    # sixteen points to the shortest wave, takes 1 % of the curvature.
    assert summits.sum() / (1022e-6) ** 2 == pytest.approx(expected.density, rel=0.05)
    assert -2.0 * STEP**2 / laplacian[summits].mean() == pytest.approx(expected.radius, rel=0.05)
    assert inside[summits].std() == pytest.approx(expected.summit_rms, rel=0.05)
    assert inside[summits].mean() == pytest.approx(expected.summit_offset, rel=0.05)


def test_the_sum_of_two_surfaces_has_the_sum_of_their_moments() -> None:
    one = generate(SelfAffine(1e-6, 0.8, 48e-6, 8e-6), (512, 512), 1e-6, 1)
    other = generate(SelfAffine(0.6e-6, 0.4, 30e-6, 10e-6), (512, 512), 1e-6, 2)
    gap = moments(one.with_heights(one.heights - other.heights))
    total = moments(one) + moments(other)
    for name in ("m0", "m2", "m4", "resolved"):
        # Two surfaces of some hundred waves each correlate by chance by a few percent.
        assert getattr(gap, name) == pytest.approx(getattr(total, name), rel=0.04), name


def test_laws_with_the_mean_plane_of_the_surface_use_the_same_summits() -> None:
    """The contact laws know y_s and σ_s from ξβσ alone; so does the spectrum."""
    from tribodyn.contact import SurfacePair, law

    spectrum = SelfAffine(1e-6, 0.8, roll_off=64e-6, shortest=8e-6)
    found = asperities(spectrum.moments(2))
    pair = SurfacePair((1e9, 1e9), (0.3, 0.3), (0.0, spectrum.sigma), 1e9, found.density, found.radius)
    contact = law("gw", pair, separation_from="surface")
    # The published constants have four to five digits.
    assert contact.summits.roughness_rms == pytest.approx(found.summit_rms, rel=1e-3)
    middle = found.summit_offset / spectrum.sigma
    assert float(contact.above_summits(np.array(middle))) == pytest.approx(0.0, abs=1e-3)


def test_profiles_cut_from_a_map_have_its_moments() -> None:
    """The isotropic conversion: m2 and m4 of a profile are those of the surface in every direction."""
    spectrum = SelfAffine(1e-6, 0.6, roll_off=48e-6, shortest=8e-6)
    whole = generate(spectrum, (512, 512), 1e-6, 5)
    lines = [moments(Scan(line, (1e-6,))) for line in (*whole.heights[::8], *whole.heights.T[::8])]
    exact = spectrum.moments(2)
    for name in ("m2", "m4"):
        # 128 lines, some 500 of them independent stretches of a wave: a scatter of about 1 %.
        assert np.mean([getattr(m, name) for m in lines]) == pytest.approx(getattr(exact, name), rel=0.03)
