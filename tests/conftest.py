from __future__ import annotations

import pytest

from tribodyn.contact import SurfacePair


@pytest.fixture(scope="session")
def table_1_pair() -> SurfacePair:
    """The surfaces of Table 1 of the source paper."""
    return SurfacePair(
        young_modulus=(203e9, 7.17e9),
        poisson_ratio=(0.27, 0.34),
        roughness=(0.392e-6, 1.586e-6),
        hardness=492e6,
        asperity_density=0.038e12,
        asperity_radius=8.17e-6,
    )
