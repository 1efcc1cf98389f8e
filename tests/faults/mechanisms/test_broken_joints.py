"""Runs in which the model of a joint no longer holds stop, with the time and the joint in the message."""

import re

import pytest
import xarray as xr
from tests.unit.mechanism.slider_crank import IDEAL, parsed

import tribodyn as td
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.mechanism_case import MechanismCase

SIZES = {"radius": "6 mm", "radial": "50 um", "length": "20 mm", "nodes_around": 24, "nodes_along": 4}
TIME = r"stopped at t = (\S+) s: "


def door() -> MechanismCase:
    """Return a door on two pins without end faces: nothing holds it up."""
    drawn = Mechanism("Door", gravity="0, 0, -9.81 m/s^2", run={"duration": "0.2 s"})
    drawn.body("door", mass="5 kg", centre="300, 0, 500 mm", inertia="0.5, 0.5, 0.2 kg m^2")
    for name, height in (("lower", 100), ("upper", 900)):
        drawn.revolute(name, "ground", "door", point=f"0, 0, {height} mm", axis=[0, 0, 1])
        drawn.clearance(name, **SIZES, friction_coefficient=0)
    return drawn.case()


def pendulum(contact: str = "surface", **keys: object) -> MechanismCase:
    """Return a pendulum on a pin that a force of 3 MN hits."""
    drawn = Mechanism("Pendulum", run={"duration": "50 ms", "start": "centred"}, **keys)
    drawn.body("bob", mass="1 kg", centre="100, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("pivot", "ground", "bob", point="0, 0, 0 mm", axis=[0, 1, 0])
    drawn.clearance("pivot", **SIZES, contact=contact, bulk="none")
    return drawn.load("blow", "bob", direction=[0, 0, -1], force="3 MN").case()


def isolated() -> MechanismCase:
    """Return a slider-crank whose guide stands across: it can only be where it is drawn."""
    guide = 'point = ["170 mm", "0 mm", "0 mm"]\naxis = [1, 0, 0]'
    text = IDEAL.replace(guide, guide.replace("[1, 0, 0]", '[0, 1, 0]\nstart_velocity = "1 m/s"'))
    text = re.sub(r"\[drives.motor\].*?(?=\[loads)", "", text, flags=re.DOTALL)
    return parsed(text.replace("cycles = 2", 'duration = "20 ms"'))


def stopped(result: xr.Dataset, words: str) -> float:
    """Return when a run stopped, which says so in these words."""
    found = re.match(TIME + words, str(result.attrs["failure"]))
    assert found is not None, result.attrs["failure"]
    assert float(found[1]) == pytest.approx(result.attrs["time_reached"], rel=1e-5)
    return float(found[1])


def test_a_pin_that_leaves_its_bore_stops_the_run() -> None:
    words = r"the pin of door has left its bore in ground, joint (lower|upper): it is displaced by .* along"
    # 20 mm of free fall take 64 ms; steps are long where nothing happens.
    assert 0.063 < stopped(td.simulate(door()), words) < 0.15


@pytest.mark.parametrize("solver", ["mebdf", "bdf"])
@pytest.mark.parametrize("contact", ["surface", "point-johnson"])
def test_surfaces_beyond_their_contact_law_stop_the_run(contact: str, solver: str) -> None:
    result = td.simulate(pendulum(contact, solver={"name": solver}))
    words = r"the surfaces of joint pivot \(barrel\) came closer than the contact law reaches"
    assert ("joints.pivot.clearance.bulk" in result.attrs["failure"]) == (contact == "surface")
    # 3 MN take 1 kg through 50 µm in 6 µs.
    assert 5e-6 < stopped(result, words) < 1e-4


def test_an_ideal_joint_that_comes_apart_stops_the_run() -> None:
    stopped(td.simulate(isolated()), r"joint \w+ between \w+ and \w+, which is ideal, came apart by")


def overhung(rings: int) -> MechanismCase:
    """Return a shaft at rest whose weight acts beside its only bearing, on so many rings of nodes."""
    drawn = Mechanism("Overhung", gravity="0, 0, -9.81 m/s^2", run={"duration": "20 ms"})
    drawn.body("shaft", mass="4 kg", centre="0, 60, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("bearing", "ground", "shaft", point="0, 0, 0 mm", axis=[0, 1, 0])
    sizes = SIZES | {"radial": "200 um", "nodes_along": rings, "axial": "1 mm", "bulk": "none"}
    return drawn.clearance("bearing", **sizes).case()


def test_an_edge_without_area_counts_and_a_grid_that_resolves_it_carries_the_load() -> None:
    words = r"the surfaces of joint bearing \(barrel\) came closer .* along the axis show which; joints\."
    # On four rings the outermost is 1.4 mm from the edge, which is some 28 um deeper than on finer grids: the
    # shaft has no place of rest within the law, falls through its clearance and stops.
    coarse = td.simulate(overhung(4))
    assert coarse.attrs["start"] == "centred"
    assert "balance within the range of the contact law" in coarse.attrs["warnings"]
    assert stopped(coarse, words) > 5e-3
    fine, finer = (td.simulate(overhung(rings)) for rings in (16, 32))
    for result in (fine, finer):
        assert not result.attrs["failure"]
    # There, the edge is about one roughness deep, and hardly depends on the grid.
    depths = [float(result["gap_min"].isel(time=0).max()) for result in (fine, finer)]
    assert depths[0] == pytest.approx(depths[1], abs=0.5e-6)
