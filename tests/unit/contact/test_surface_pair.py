import dataclasses
import math

import pytest

from tribodyn.contact import SurfacePair
from tribodyn.core.errors import InputError


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
