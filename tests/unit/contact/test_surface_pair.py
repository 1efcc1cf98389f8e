"""What else holds."""

import dataclasses

import pytest

from tribodyn.contact import SurfacePair


def test_equal_bodies_halve_the_modulus(table_1_pair: SurfacePair) -> None:
    pair = dataclasses.replace(table_1_pair, young_modulus=(2e11, 2e11), poisson_ratio=(0.0, 0.0))
    assert pair.composite_modulus == pytest.approx(1e11, rel=1e-15)


def test_poisson_ratio_of_the_bushing_sets_the_hardness_coefficient(table_1_pair: SurfacePair) -> None:
    assert table_1_pair.hardness_coefficient == pytest.approx(0.454 + 0.41 * 0.34, rel=1e-15)


def test_one_surface_may_be_smooth(table_1_pair: SurfacePair) -> None:
    pair = dataclasses.replace(table_1_pair, roughness=(0.0, 2e-6))
    assert pair.roughness_rms == 2e-6
