import dataclasses
import math

import pytest

from tribodyn.contact import SurfacePair
from tribodyn.core.errors import InputError


def test_equal_bodies_halve_the_modulus(table_1_pair: SurfacePair) -> None:
    pair = dataclasses.replace(table_1_pair, young_modulus=(2e11, 2e11), poisson_ratio=(0.0, 0.0))
    assert pair.composite_modulus == pytest.approx(1e11, rel=1e-15)


def test_poisson_ratio_of_the_bushing_sets_the_hardness_coefficient(table_1_pair: SurfacePair) -> None:
    assert table_1_pair.hardness_coefficient == pytest.approx(0.454 + 0.41 * 0.34, rel=1e-15)


def test_one_surface_may_be_smooth(table_1_pair: SurfacePair) -> None:
    pair = dataclasses.replace(table_1_pair, roughness=(0.0, 2e-6))
    assert pair.roughness_rms == 2e-6


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("young_modulus", (203e9, 0.0)),
        ("young_modulus", (math.nan, 7e9)),
        ("hardness", -1.0),
        ("hardness", math.inf),
        ("asperity_density", 0.0),
        ("asperity_radius", math.nan),
        ("roughness", (0.0, 0.0)),
        ("roughness", (-1e-6, 2e-6)),
        ("roughness", (1e-6, math.nan)),
        ("poisson_ratio", (0.3, 0.51)),
        ("poisson_ratio", (math.nan, 0.3)),
    ],
)
def test_impossible_surfaces_are_refused_by_key(table_1_pair: SurfacePair, key: str, value: object) -> None:
    with pytest.raises(InputError) as caught:
        dataclasses.replace(table_1_pair, **{key: value})
    assert caught.value.key == key
