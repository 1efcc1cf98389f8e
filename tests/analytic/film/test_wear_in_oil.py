"""Wear of a journal that runs in oil, against that of a dry one and against the work of its friction."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError

RATE, PARTNER, FRICTION = 1e-13, 5e-14, 0.1
TURN = 20e-3  #: Time of a turn of the journal [s].


def journal(load: float, viscosity: float | None, **changes: Any) -> td.Case:
    """Return a journal that turns in its bearing under a load [N]; dry without a viscosity [Pa s]."""
    drawn = td.Mechanism(
        "Journal",
        run={"cycles": 1, "period": f"{TURN} s", "output_interval": "0.2 ms"},
        wear={"specific_wear_rate": f"{RATE} m^2/N", "partner_wear_rate": f"{PARTNER} m^2/N"},
    )
    drawn.body("journal", mass="0.25 kg", centre="0, 0, 0 mm", inertia=["5e-4 kg m^2"] * 3)
    drawn.revolute("main", "ground", "journal", point="0, 0, 0 mm", axis=[0, 0, 1])
    sizes = {"radius": "6 mm", "radial": "20 um", "length": "20 mm", "axial": "50 um"}
    drawn.clearance("main", **sizes, friction_coefficient=FRICTION, nodes_around=48, nodes_along=4)
    if viscosity is not None:
        drawn.film("main", viscosity=f"{viscosity} Pa s", grid={"theta": 48, "z": 4})
    drawn.load("weight", "journal", direction=[0.8, 0.6, 0], force=f"{load} N")
    case: td.Case = drawn.drive("motor", "main", speed=f"{2.0 * np.pi / TURN!r} rad/s").case()
    return case.replace({key.replace("__", "."): value for key, value in changes.items()})


@cache
def campaign(viscosity: float | None, **changes: Any) -> xr.Dataset:
    """Return a campaign that wears off two roughnesses of the surfaces of a loaded journal."""
    result = td.simulate(journal(2000.0, viscosity, wear__cycles=30, wear__jump_depth=0.5, **changes))
    assert not result.attrs["failure"]
    return result


@pytest.mark.parametrize("load", [200.0, 2000.0])
def test_the_worn_volume_is_the_work_of_friction_between_the_surfaces_alone(load: float) -> None:
    """V = k ∫∬ p |s| dA dt of both partners, and μ ∫∬ p |s| dA dt is their heat; oil wears nothing."""
    result = td.simulate(journal(load, 0.01))
    friction, oil = (float(result[name].values[-1]) for name in ("energy_friction", "energy_film"))
    assert oil > 0.01 * friction > 0.0
    volume = (RATE + PARTNER) * friction / FRICTION
    # Sliding loads are summed by the trapezoidal rule, heat by parabolas.
    assert result.attrs["worn_volume"] == pytest.approx(volume, rel=2e-3)
    share = result["partner_wear_depth"].values / np.maximum(result["wear_depth"].values, 1e-300)
    assert share[result["wear_depth"].values > 0.0] == pytest.approx(PARTNER / (RATE + PARTNER), rel=1e-12)


def test_thin_oil_wears_as_none_and_thick_oil_keeps_surfaces_apart() -> None:
    dry, thin, oiled = campaign(None), campaign(1e-7), campaign(3e-3)
    depths = [float(run["wear_depth"].max()) for run in (dry, thin, oiled)]
    assert min(run.sizes["jump"] for run in (dry, thin, oiled)) >= 4
    assert depths[0] > 1.5e-6
    assert depths[1] == pytest.approx(depths[0], rel=2e-3)
    assert thin.attrs["worn_volume"] == pytest.approx(dry.attrs["worn_volume"], rel=2e-3)
    assert 0.1 * depths[0] < depths[2] < 0.95 * depths[0]
    thick = td.simulate(journal(20.0, 0.05, wear__cycles=1000, wear__depth_limit="5 um"))
    assert not thick["wear_depth"].values.any()
    assert "wear_life_cycles" not in thick.attrs
    assert thick.attrs["wear_cycles_reached"] == 1000


def test_film_and_asperities_are_in_the_same_worn_gap() -> None:
    """The bore is worn on the loaded side, and both gaps are least there."""
    last = campaign(3e-3).isel(time=-1)
    place = last["displacement"].values[0]
    assert np.hypot(*place[:2]) > 20e-6
    assert last["film_thickness_min"].values[0] == pytest.approx(last["gap_min"].values[0], abs=0.05e-6)


def test_a_campaign_in_oil_ends_at_its_depth_limit() -> None:
    result = td.simulate(journal(2000.0, 3e-3, wear__cycles=10**6, wear__depth_limit="1 um"))
    life = result.attrs["wear_life_cycles"]
    assert life <= result.attrs["wear_cycles_reached"] < life + 1.0
    long = campaign(3e-3)
    assert life == pytest.approx(
        float(np.interp(1e-6, long["wear_depth_max"], long["wear_cycles"])), rel=0.05
    )


def test_a_film_with_a_groove_is_refused_in_a_campaign_before_it_runs() -> None:
    groove = {"joints__main__film__boundary": "groove", "wear__cycles": 10}
    with pytest.raises(InputError, match="periodic") as caught:
        journal(2000.0, 0.01, **groove)
    assert caught.value.key == "joints.main.film.boundary"
    assert journal(2000.0, 0.01, **groove, wear__feedback=False)
