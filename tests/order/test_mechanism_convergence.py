"""Errors of mechanisms fall with the tolerance, although every step ends on the constraints."""

from collections.abc import Callable

import numpy as np
import pytest
from tests.unit.mechanism.drawings import bricard, run, spatial_slider_crank

from tribodyn.mechanism.assembly.parts_by_number import Model

RTOL = np.array([1e-4, 1e-5, 1e-6, 1e-7, 1e-8])


@pytest.mark.parametrize("make", [spatial_slider_crank, bricard], ids=["spatial", "Bricard"])
def test_error_is_in_proportion_to_the_tolerance(make: Callable[[], Model]) -> None:
    times = np.linspace(0.0, 2.0, 21)
    exact = run(make(), times, 1e-11)

    def error(rtol: float) -> float:
        result = run(make(), times, rtol)
        return float(
            np.sqrt(np.mean((result.body(2, "position", "x") - exact.body(2, "position", "x")) ** 2))
        )

    errors = np.array([error(rtol) for rtol in RTOL])
    slope = np.polyfit(np.log(RTOL), np.log(errors), 1)[0]
    # Measured: 1.00 and 1.14.
    assert 0.8 < slope < 1.3, errors
