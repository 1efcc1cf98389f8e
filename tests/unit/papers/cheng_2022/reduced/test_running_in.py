"""A campaign in which the bushing runs in, and one in which both surfaces wear."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError

QUICK = {
    "run.cycles": 1.0,
    "run.output_interval": "50 ms",
    "run.impact_window": "0 s",
    "wear.specific_wear_rate": "1.1e-12 m^2/N",
    "wear.cycles": 60,
    "wear.jump_limit": 0.5,
    "solver.grid.theta": 48,
    "solver.grid.z": 8,
}


def campaign(**changes: object) -> xr.Dataset:
    return td.simulate(td.load_case("vsv").replace({**QUICK, **changes}))


def test_the_bushing_runs_in_to_the_roughness_of_its_trunnion() -> None:
    worn = campaign(**{"wear.running_in": True})
    assert not worn.attrs["failure"]
    sigma = worn["wear_roughness"].values
    trunnion, bushing = 0.392e-6, 1.586e-6
    assert sigma[0] == pytest.approx(np.hypot(trunnion, bushing), rel=1e-12)
    assert np.all(np.diff(sigma) <= 0.0)
    assert sigma[-1] < 0.9 * sigma[0]
    assert sigma[-1] >= np.hypot(trunnion, trunnion) * (1.0 - 1e-12)
    # The smoother joint carries the same load, closer.
    force = worn["wear_force_mean"].values
    assert force[-1] == pytest.approx(force[0], rel=0.05)
    assert worn.attrs["clearance_energy_residual"] < 0.01


def test_both_wear_in_proportion() -> None:
    both = campaign(**{"wear.specific_wear_rate": "0.8e-12 m^2/N", "wear.partner_wear_rate": "0.3e-12 m^2/N"})
    one = campaign()
    np.testing.assert_allclose(both["wear_depth"], one["wear_depth"], rtol=1e-9)
    assert "27.3 % are worn off the partner" in str(both.attrs["notes"])
    assert "partner" not in str(one.attrs["notes"])
    np.testing.assert_array_equal(one["wear_roughness"], one["wear_roughness"][0])


def test_a_smooth_trunnion_leaves_nothing_to_run_in_to() -> None:
    with pytest.raises(InputError, match="say what the bushing runs in to"):
        td.load_case("vsv").replace({"surfaces.trunnion.roughness": "0 um", "wear.running_in": True})
