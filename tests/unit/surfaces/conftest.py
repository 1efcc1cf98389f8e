from collections.abc import Callable

import pytest

from tribodyn.surfaces import Scan, SelfAffine, generate

SPECTRUM = SelfAffine(1e-6, 0.8, roll_off=24e-6, shortest=8e-6)


@pytest.fixture(scope="session")
def rough() -> Callable[..., Scan]:
    """Return a maker of generated surfaces of one micrometre roughness with points 1 µm apart."""

    def make(*shape: int, seed: int = 1) -> Scan:
        return generate(SPECTRUM, shape or (96, 128), 1e-6, seed)

    return make
