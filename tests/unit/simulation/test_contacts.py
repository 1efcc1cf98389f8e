"""Mechanism and journal run under every contact law, damped, and under every contact of the joint."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.contact import LAWS
from tribodyn.joints import CONTACTS, SURFACE

WEIGHT = 18.0  #: Force [N] that the loads of the vane mechanism lay on the trunnion at the start, about.


def run(name: str, **changes: object) -> xr.Dataset:
    return td.simulate(td.load_case(name).replace(changes))


def check(result: xr.Dataset, kind: str) -> None:
    assert not result.attrs["failure"]
    # The mechanism moves slowly for 20 ms from its equilibrium: its force is that of the loads.
    force = np.hypot(result["F_cx"], result["F_cy"])
    assert float(force.median()) == pytest.approx(WEIGHT, rel=0.25), kind
    # The bound above which a user is warned; the clearance has hardly moved yet.
    assert result.attrs["energy_residual"] < 0.01


@pytest.mark.parametrize("law", LAWS)
def test_vane_mechanism_under_every_law(law: str) -> None:
    changes = {"contact.law": law, "contact.damping_factor": "calibrated", "contact.restitution": 0.7}
    result = run("vsv", **{"run.duration": "20 ms", **changes})
    check(result, law)
    assert float(result["p_max"].min()) > 1e6


@pytest.mark.parametrize("contact", [name for name in CONTACTS if name != SURFACE])
def test_vane_mechanism_touching_at_points(contact: str) -> None:
    result = run("vsv", **{"run.duration": "20 ms", "joint.contact": contact})
    check(result, contact)
    assert not result["p_max"].any()
    assert "no pressure field" in result.attrs["warnings"]


@pytest.mark.parametrize("contact", CONTACTS)
def test_journal_settles_where_its_load_is_carried(contact: str) -> None:
    changes = {"joints.bearing.clearance.contact": contact, "contact.restitution": 0.5}
    result = run("journal-dry", **changes).isel(time=-1, joint=0)
    # The load of the built-in case: (200, 100) N, carried along the line of centres.
    assert float(result["contact_force"][0]) == pytest.approx(-200.0, rel=0.02)
    assert float(result["contact_force"][1]) == pytest.approx(-100.0, rel=0.02)
    x, y, _ = result["displacement"].values
    assert y / x == pytest.approx(0.5, rel=1e-3)
    far = np.hypot(x, y)
    assert (far > 20e-6) == (contact != SURFACE)
