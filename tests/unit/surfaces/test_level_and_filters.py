"""Levelled and filtered heights, and their amplitudes."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from tribodyn.surfaces import FILTERS, LEVELS, Scan, analyse
from tribodyn.surfaces.parameters import arithmetic_mean, mean_total_height, numbers
from tribodyn.surfaces.treatment import filled, filtered, levelled


@pytest.mark.parametrize(("level", "degree"), LEVELS.items())
@pytest.mark.parametrize("is_map", [False, True])
def test_a_level_takes_its_polynomial_off_and_leaves_the_rest(level, degree, is_map, rough):
    scan = rough(60, 50) if is_map else rough(200)
    heights = scan.heights.copy()
    heights.flat[::17] = np.nan
    scan = scan.with_heights(heights)
    x = np.arange(scan.heights.shape[-1])
    y = np.arange(scan.heights.shape[0])[:, None] if is_map else 0.0
    shape = sum(1e-8 * (x - 3.0 + 2.0 * y) ** n for n in range(degree + 1))
    level_of_both = levelled(scan.with_heights(scan.heights + shape), level).heights
    np.testing.assert_allclose(level_of_both, levelled(scan, level).heights, atol=1e-15)
    np.testing.assert_array_equal(np.isnan(level_of_both), np.isnan(heights))


@pytest.mark.parametrize("wave", [10.0, 20.0, 40.0])
def test_the_gaussian_filter_passes_what_iso_16610_says(wave: float) -> None:
    x = np.arange(4000.0)
    profile = Scan(np.cos(2 * np.pi * x / wave), (1.0,))
    smooth = FILTERS["gaussian"](profile, 20.0)
    amplitude = np.abs(smooth[1000:3000]).max()
    alpha = math.sqrt(math.log(2) / math.pi)
    expected = math.exp(-math.pi * (alpha * 20.0 / wave) ** 2)
    # Every wave has a point on its crest; the border is far away.
    assert amplitude == pytest.approx(expected, rel=1e-9)
    assert expected == pytest.approx({10.0: 0.0625, 20.0: 0.5, 40.0: 0.5**0.25}[wave], rel=1e-12)


def test_the_gaussian_filter_of_a_map_is_the_same_in_all_directions() -> None:
    y, x = np.mgrid[:200, :300] * 1.0
    for qx, qy in ((1.0, 0.0), (0.0, 1.0), (0.6, 0.8)):
        waves = np.cos(2 * np.pi / 20.0 * (qx * (x - 150) + qy * (y - 100)))
        smooth = FILTERS["gaussian"](Scan(waves, (1.0, 1.0)), 20.0)
        assert smooth[100, 150] == pytest.approx(0.5, rel=1e-6)


def test_the_spectral_filter_parts_waves_sharply() -> None:
    x = (np.arange(1000) + 0.5) / 1000
    long, short = np.cos(20 * np.pi * x), np.cos(200 * np.pi * x)
    scan = Scan(long + short, (1e-3,))
    np.testing.assert_allclose(filtered(scan, "spectral", 0.05, None).heights, long, atol=1e-12)
    np.testing.assert_allclose(filtered(scan, "spectral", None, 0.05).heights, short, atol=1e-12)


SINE = np.sin(2.0 * np.pi * np.arange(10_000) / 1000.0)


def test_a_sine_has_the_known_ratios() -> None:
    # Ra = 2a/π, Rz = 2a; ten waves of a thousand points leave 1e-5.
    assert arithmetic_mean(3.0 + SINE) == pytest.approx(2.0 / math.pi, rel=1e-4)
    assert mean_total_height(SINE) == pytest.approx(2.0, rel=1e-4)


def test_missing_heights_have_no_say() -> None:
    holed = SINE.copy()
    holed[100:120] = np.nan
    assert arithmetic_mean(holed) == pytest.approx(arithmetic_mean(SINE), rel=1e-2)


def test_profiles_and_maps_have_names_of_their_own(rough: Callable[..., Scan]) -> None:
    profile, area = (numbers(analyse(rough(*shape))) for shape in ((512,), (64, 80)))
    assert {"Ra_um", "Rq_um", "Rz_um"} <= profile.keys()
    assert {"Sa_um", "Sq_um"} <= area.keys()
    assert not {"Sa_um", "Sq_um"} & profile.keys()
    assert not {"Ra_um", "Rz_um"} & area.keys()
    assert profile["Rq_um"] == profile["sigma_um"]
    # Of Gaussian heights σ = √(π/2) Ra; a few hundred points scatter by some per cent.
    assert profile["Rq_um"] / profile["Ra_um"] == pytest.approx(math.sqrt(math.pi / 2.0), rel=0.1)
    assert profile["Ra_um"] < profile["Rz_um"]


@pytest.mark.parametrize("name", FILTERS)
def test_filters_keep_constants_and_holes(name: str) -> None:
    heights = np.full((50, 60), 3.0)
    heights[10:13, 20:25] = np.nan
    smooth = FILTERS[name](Scan(heights, (1.0, 2.0)), 10.0)
    np.testing.assert_allclose(smooth[~np.isnan(heights)], 3.0, rtol=1e-12)
    np.testing.assert_array_equal(np.isnan(smooth), np.isnan(heights))


def test_holes_are_filled_from_around() -> None:
    heights = np.full((40, 40), 2.0)
    heights[:, 20:] = 4.0
    heights[5:8, 5:8] = np.nan
    heights[20:35, 25:40] = np.nan
    whole = filled(heights)
    np.testing.assert_allclose(whole[5:8, 5:8], 2.0, rtol=1e-12)
    assert np.all((whole >= 2.0 - 1e-12) & (whole <= 4.0 + 1e-12))
