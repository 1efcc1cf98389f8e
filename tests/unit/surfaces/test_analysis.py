from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.surfaces import (
    FILTERS,
    MeasuredSurface,
    Scan,
    SelfAffine,
    Treatment,
    analyse,
    dependence,
    generate,
)
from tribodyn.surfaces.analysis import in_bands, spectra
from tribodyn.surfaces.parameters import PARAMETERS, document, numbers

TREATMENT = Treatment(short_cutoff=6e-6, long_cutoff=60e-6)


@pytest.fixture(scope="module")
def surface(rough: Callable[..., Scan]) -> MeasuredSurface:
    return analyse(rough(), TREATMENT)


@pytest.mark.parametrize("name", FILTERS)
def test_tilt_and_offset_do_not_matter(name: str, rough: Callable[..., Scan]) -> None:
    scan, treatment = rough(), replace(TREATMENT, filter=name)
    y, x = np.indices(scan.heights.shape)
    moved = scan.with_heights(scan.heights + 5e-6 + 3e-7 * x - 2e-7 * y)
    # Rounding: the tilt is some fifty times the roughness, and curvature a difference of differences.
    assert numbers(analyse(moved, treatment)) == pytest.approx(numbers(analyse(scan, treatment)), rel=1e-9)


@pytest.mark.parametrize("name", FILTERS)
def test_swapped_axes_swap_directions_and_nothing_else(name: str, rough: Callable[..., Scan]) -> None:
    scan, treatment = replace(rough(), spacing=(1.2e-6, 1e-6)), replace(TREATMENT, filter=name)
    one, other = (numbers(analyse(s, treatment)) for s in (scan, scan.transposed()))
    other |= {"m2_x": other["m2_y"], "m2_y": other["m2_x"]}
    other |= {"m4_x_per_um2": other["m4_y_per_um2"], "m4_y_per_um2": other["m4_x_per_um2"]}
    other["lay_deg"] = 90.0 - other["lay_deg"]
    assert (one.pop("lay_deg") - other.pop("lay_deg")) % 180.0 == pytest.approx(0.0, abs=1e-6)
    assert one == pytest.approx(other, rel=1e-9)


def test_a_mirrored_or_turned_over_map_keeps_its_numbers(surface, rough):
    expected = numbers(surface)
    for heights in (rough().heights[::-1], rough().heights[:, ::-1]):
        found = numbers(analyse(rough().with_heights(heights), TREATMENT))
        assert found.pop("lay_deg") == pytest.approx(-expected["lay_deg"], rel=1e-6)
        assert found == pytest.approx({k: v for k, v in expected.items() if k != "lay_deg"}, rel=1e-9)
    over = numbers(analyse(rough().with_heights(-rough().heights), TREATMENT))
    assert over.pop("skewness") == pytest.approx(-expected["skewness"], rel=1e-9)
    assert over == pytest.approx({k: v for k, v in expected.items() if k != "skewness"}, rel=1e-9)


def test_a_few_holes_change_little(surface: MeasuredSurface, rough: Callable[..., Scan]) -> None:
    heights = rough().heights.copy()
    heights[np.random.default_rng(3).random(heights.shape) < 0.002] = np.nan
    found = analyse(rough().with_heights(heights), TREATMENT)
    # Each of some 25 holes takes a 7 x 7 neighbourhood out of the curvature: a tenth of the sample.
    assert found.sigma == pytest.approx(surface.sigma, rel=5e-3)
    assert found.asperities.radius == pytest.approx(surface.asperities.radius, rel=3e-2)
    assert any("missing" in warning for warning in found.warnings)


def test_a_lay_is_found_and_told() -> None:
    y, x = np.mgrid[:128, :128] * 1e-6
    noise = generate(SelfAffine(0.05e-6, 0.8, 24e-6, 8e-6), (128, 128), 1e-6, 2).heights
    angle = np.deg2rad(30.0)
    grooves = 1e-6 * np.sin(2 * np.pi / 16e-6 * (-np.sin(angle) * x + np.cos(angle) * y))
    found = analyse(Scan(grooves + noise, (1e-6, 1e-6)))
    assert np.rad2deg(found.moments.directional.lay) == pytest.approx(30.0, abs=0.5)
    assert found.moments.directional.texture < 0.2
    assert any("lay" in warning for warning in found.warnings)


def test_an_unresolved_curvature_is_told() -> None:
    white = Scan(1e-7 * np.random.default_rng(1).standard_normal((64, 64)), (1e-6, 1e-6))
    assert any("too far apart" in warning for warning in analyse(white).warnings)
    assert not any("too far apart" in w for w in analyse(white, Treatment(short_cutoff=8e-6)).warnings)


def test_far_from_gaussian_heights_are_told(rough: Callable[..., Scan]) -> None:
    scan = rough(128, 128)
    found = analyse(scan.with_heights(-(np.abs(scan.heights) ** 2) / 1e-6))
    assert found.skewness < -1.0
    assert any("Gaussian" in warning for warning in found.warnings)


def test_other_cut_offs(surface: MeasuredSurface, rough: Callable[..., Scan]) -> None:
    others = dependence(surface, rough())
    short = [o for o in others if o.treatment.long_cutoff == TREATMENT.long_cutoff]
    long = [o for o in others if o.treatment.short_cutoff == TREATMENT.short_cutoff]
    assert set(map(id, short)) | set(map(id, long)) == set(map(id, others))
    assert len(long) > 3
    sigmas = [o.sigma for o in long]
    assert sigmas == sorted(sigmas, reverse=True), "taking long waves off takes roughness off"
    free = dependence(analyse(rough(256, 256)), rough(256, 256))
    radii = [o.asperities.radius for o in free if o.treatment.short_cutoff is not None]
    assert len(radii) > 3
    assert radii == sorted(radii), "taking short waves off blunts the asperities"


@pytest.mark.parametrize(
    ("treatment", "key"),
    [
        ({"short_cutoff": 1e-6}, "short_cutoff"),
        ({"short_cutoff": 1.0}, "short_cutoff"),
        ({"long_cutoff": 1e-3}, "long_cutoff"),
        ({"short_cutoff": 20e-6, "long_cutoff": 10e-6}, "short_cutoff"),
        ({"short_cutoff": 70e-6}, "short_cutoff"),
        ({"level": "cubic"}, "level"),
        ({"filter": "gauss"}, "filter"),
    ],
)
def test_impossible_treatments_are_refused(treatment, key, rough):
    with pytest.raises(InputError) as caught:
        analyse(rough(), Treatment(**treatment))
    assert caught.value.key == key


def test_plasticity_index_is_that_of_greenwood_and_williamson(surface: MeasuredSurface) -> None:
    found = surface.asperities
    expected = 7.818e9 / 492e6 * (found.summit_rms / found.radius) ** 0.5
    assert found.plasticity_index(7.818e9, 492e6) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("shape", [(400,), (401,), (128, 96)])
def test_the_integral_of_a_spectrum_is_the_variance(shape, rough):
    scan = rough(*shape)
    for name, spectrum in spectra(scan).items():
        variance = np.sum(spectrum.density) * spectrum.frequency[0]
        axis = 0 if name == "y" or scan.heights.ndim == 1 else 1
        # The window weighs the middle more, so that variances differ by the scatter of the surface.
        assert variance == pytest.approx(np.mean(np.var(scan.heights, axis=axis)), rel=0.15)
        banded = in_bands(spectrum)
        assert banded.frequency.size < spectrum.frequency.size
        assert np.all(np.diff(banded.frequency) > 0.0)


@pytest.mark.parametrize("wrong", [(0.0, 0.8, 2.0, 1.0), (1.0, 1.0, 2.0, 1.0), (1.0, 0.5, 1.0, 2.0)])
def test_a_spectrum_that_is_none_is_refused(wrong: tuple[float, ...]) -> None:
    with pytest.raises(InputError):
        SelfAffine(*wrong)


def test_heights_and_lengths_scale(surface: MeasuredSurface, rough: Callable[..., Scan]) -> None:
    scan = rough()
    double = analyse(replace(scan, heights=2.0 * scan.heights), TREATMENT)
    assert double.sigma == pytest.approx(2.0 * surface.sigma, rel=1e-12)
    assert double.asperities.density == pytest.approx(surface.asperities.density, rel=1e-9)
    assert double.asperities.radius == pytest.approx(0.5 * surface.asperities.radius, rel=1e-9)


def test_borders_without_heights_are_cut_off(surface: MeasuredSurface, rough: Callable[..., Scan]) -> None:
    heights = np.full((110, 140), np.nan)
    heights[5:101, 7:135] = rough().heights
    assert numbers(analyse(rough().with_heights(heights), TREATMENT)) == numbers(surface)


def test_every_number_has_a_label_and_a_finite_value(
    surface: MeasuredSurface, rough: Callable[..., Scan]
) -> None:
    profile = numbers(analyse(rough(400)))
    for found, is_map in ((numbers(surface), True), (profile, False)):
        assert set(found) == {name for name, p in PARAMETERS.items() if p.of_maps in (None, is_map)}
    stored = document(surface, [surface])
    assert stored["short_cutoff_um"] == pytest.approx(6.0)
    assert stored["cutoffs"][0]["sigma_um"] == stored["sigma_um"]
    for name, value in numbers(surface).items():
        assert np.isfinite(value), name


def test_surfaces_of_one_seed_are_the_same(rough: Callable[..., Scan]) -> None:
    np.testing.assert_array_equal(rough().heights, rough().heights)
    assert not np.array_equal(rough().heights, rough(seed=2).heights)
