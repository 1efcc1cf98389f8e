"""What a result must be like to be worked with."""

from collections.abc import Callable

import pytest
import xarray as xr

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results.schema import check

KINDS = {kind: mechanism.variables for kind, mechanism in MECHANISMS.items()}


@pytest.mark.parametrize("pictures", ["snapshot", "frame"])
def test_pictures_of_a_motion_without_times_are_refused(
    pictures: str, make_result: Callable[..., xr.Dataset]
) -> None:
    whole = make_result(1.0)
    check(whole, KINDS)
    with pytest.raises(ValueError, match=f"values of {pictures}, but none of time"):
        check(
            whole.isel(time=slice(0, 0), **{"snapshot": slice(0, 0), "frame": slice(0, 0), pictures: [0]}),
            KINDS,
        )
    check(whole.isel(time=slice(0, 0), snapshot=slice(0, 0), frame=slice(0, 0)), KINDS)
