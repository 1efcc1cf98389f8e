"""Variables of one of many parts: the same numbers, read alone or for all parts at once."""

import numpy as np
import pytest
import xarray as xr

from tribodyn.mechanism.results.readings import lengths
from tribodyn.results.reading import column, of_part, reading_once


@pytest.fixture
def result() -> xr.Dataset:
    """Views into rows, as a run leaves them."""
    rows = np.random.default_rng(4).normal(size=(50, 40))
    return xr.Dataset(
        {
            "force": (("time", "joint", "axis"), rows[:, 4:25].reshape(50, 7, 3)),
            "pressure": (("time", "joint"), rows[:, 30:37]),
        },
        {"time": np.linspace(0.0, 1.0, 50), "joint": [f"j{k}" for k in range(7)]},
    )


def test_parts_are_the_same_however_they_are_read(result: xr.Dataset) -> None:
    alone = [(of_part(result, "force", k, lengths), of_part(result, "pressure", k)) for k in range(7)]
    with reading_once():
        together = [(of_part(result, "force", k, lengths), of_part(result, "pressure", k)) for k in range(7)]
    assert np.array_equal(alone, together)
    assert np.array_equal(alone[2][0], np.linalg.norm(result["force"].values[:, 2], axis=-1))


def test_results_are_told_apart_and_forgotten(result: xr.Dataset) -> None:
    other = result.isel(joint=slice(None, None, -1))
    with reading_once():
        assert np.array_equal(of_part(result, "pressure", 0), of_part(other, "pressure", 6))
        for number in range(5):  # each may get the place in memory of the one before
            part = result.isel(time=slice(number, None))
            assert of_part(part, "pressure", 1).size == column(part, "time").size == 50 - number
    result["pressure"].values[:] = 1.0
    assert np.all(of_part(result, "pressure", 3) == 1.0)
