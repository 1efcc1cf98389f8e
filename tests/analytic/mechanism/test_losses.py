"""Losses of gears, worms, racks, threads and guides that follow force and direction."""

import math
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError

RATIO, LOAD = -0.25, 8.0


def wheels(drive: dict[str, Any], load: float, **gear: Any) -> td.Mechanism:
    """Return a pinion that turns a loaded wheel, or is turned by it."""
    drawn = td.Mechanism("Gears", run={"duration": "0.2 s"}, solver={"rtol": 1e-8})
    drawn.body("first", mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
    drawn.body("second", mass="4 kg", centre="100, 0, 0 mm", inertia="5e-3, 5e-3, 9e-3 kg m^2")
    drawn.revolute("input", "ground", "first", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("output", "ground", "second", point="100, 0, 0 mm", axis=[0, 0, 1])
    drawn.gear("mesh", joints=["input", "output"], ratio=RATIO, slip_velocity="0.1 um/s", **gear)
    drawn.load("process", body="second", moment=f"{load} N m", direction=[0, 0, 1])
    return drawn.drive("motor", "input", **drive) if drive else drawn


WORM = {"friction_coefficient": 0.05, "lead_angle": "15 deg"}
SLOPE, RHO = math.tan(math.radians(15.0)), math.atan(0.05)
FORWARD = SLOPE / math.tan(math.radians(15.0) + RHO)
BACKWARD = math.tan(math.radians(15.0) - RHO) / SLOPE


@pytest.mark.parametrize(
    ("gear", "load", "efficiency"),
    [
        ({"efficiency": 0.72}, LOAD, 1.0 / 0.72),
        ({"efficiency": 0.72}, -LOAD, 2.0 - 1.0 / 0.72),
        ({"efficiency": 0.72, "backward_efficiency": 0.38}, -LOAD, 0.38),
        (WORM, LOAD, 1.0 / FORWARD),
        (WORM, -LOAD, BACKWARD),
        ({}, LOAD, 1.0),
    ],
)
def test_torque_of_the_motor(gear: dict[str, Any], load: float, efficiency: float) -> None:
    run = td.simulate(wheels({"speed": "100 rpm"}, load, **gear).case())
    np.testing.assert_allclose(run["drive_moment"].values[:, 0], -RATIO * load * efficiency, rtol=1e-6)
    assert run.attrs["energy_residual"] < 1e-6


def test_a_worm_that_locks_itself_holds() -> None:
    keys = {"friction_coefficient": 0.3, "lead_angle": "5 deg"}
    drawn = wheels({}, LOAD, **keys)
    run = td.simulate(drawn.case().replace({"friction.rest": "true", "run.duration": "1000 s"}))
    late = run["position"].values[run["time"].values > 5.0]
    turned = run["joint_angle"].values[run["time"].values > 5.0]
    assert np.ptp(late, axis=0).max() < 1e-10
    assert np.ptp(turned, axis=0).max() < 1e-9


@pytest.mark.parametrize(
    ("gear", "words"),
    [
        ({"friction_coefficient": 0.1}, "needs its lead angle"),
        (WORM | {"efficiency": 0.5}, "leave one of them out"),
        ({"backward_efficiency": 0.5}, "give both efficiencies"),
        ({"friction_coefficient": 1.5, "lead_angle": "60 deg"}, "exceed 90 deg"),
        ({"efficiency": 0.9, "backlash": "0.1 mm"}, "need their stiffness"),
    ],
)
def test_wrong_losses_are_refused(gear: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        wheels({"speed": "100 rpm"}, LOAD, **gear).case()


PLAYS = [{}, {"backlash": "20 um", "restitution": 0.3}]


@pytest.mark.parametrize("load", [LOAD, -LOAD])
def test_teeth_with_backlash_lose_as_those_without(load: float) -> None:
    losses = {"efficiency": 0.72, "backward_efficiency": 0.38}
    stiff = PLAYS[1] | {"mesh_stiffness": "10 N/um"}
    run = td.simulate(wheels({"speed": "100 rpm"}, load, **losses, **stiff).case())
    efficiency = 1.0 / 0.72 if load > 0.0 else 0.38
    late = run["drive_moment"].values[run["time"].values > 0.15, 0]
    np.testing.assert_allclose(late, -RATIO * load * efficiency, rtol=1e-3)
    assert run.attrs["energy_residual"] < 1e-3


@pytest.mark.parametrize("play", PLAYS)
@pytest.mark.parametrize("load", [50.0, -50.0])
def test_a_rack_loses_by_direction(load: float, play: dict[str, Any]) -> None:
    drawn = td.Mechanism("Rack", run={"duration": "0.3 s"}, solver={"rtol": 1e-8})
    drawn.body("pinion", mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
    drawn.body("rack", mass="2 kg", centre="0, -20, 0 mm", inertia="1e-4, 5e-3, 5e-3 kg m^2")
    drawn.revolute("bearing", "ground", "pinion", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.prismatic("guide", "ground", "rack", point="0, -20, 0 mm", axis=[1, 0, 0])
    keys = play | ({"mesh_stiffness": "10 N/um"} if play else {})
    losses = {"efficiency": 0.8, "backward_efficiency": 0.5, "slip_velocity": "0.1 um/s"}
    drawn.rack("mesh", joints=["bearing", "guide"], radius="20 mm", **losses, **keys)
    drawn.load("process", body="rack", point="0, -20, 0 mm", force=f"{load} N", direction=[-1, 0, 0])
    drawn.drive("motor", "bearing", speed="1 rad/s")
    run = td.simulate(drawn.case())
    late = run["time"].values > 0.25
    expected = 0.02 * load * (1.0 / 0.8 if load > 0.0 else 0.5)
    np.testing.assert_allclose(run["drive_moment"].values[late, 0], expected, rtol=1e-3 if play else 1e-6)
    assert np.isfinite(run["element_force"].values[late]).all()


@pytest.mark.parametrize("play", PLAYS)
@pytest.mark.parametrize("hand", [1.0, -1.0])
@pytest.mark.parametrize("lifts", [True, False])
def test_a_screw_has_friction_by_direction(lifts: bool, hand: float, play: dict[str, Any]) -> None:
    """Lifting a weight W takes W r tan(phi + rho), lowering it W r tan(rho - phi), each with its rho."""
    weight, radius, lead, forward, backward = 200.0, 8e-3, 5e-3, 0.1, 0.2
    drawn = td.Mechanism("Screw", run={"duration": "0.3 s"}, solver={"rtol": 1e-8})
    drawn.body("screw", mass="1 kg", centre="0, 0, 50 mm", inertia="1e-3, 1e-3, 2e-4 kg m^2")
    drawn.body("nut", mass="2 kg", centre="0, 0, 30 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.prismatic("guide", "ground", "nut", point="0, 0, 30 mm", axis=[0, 0, 1])
    keys = play | ({"stiffness": "10 N/um"} if play else {})
    rubbing = {"friction_coefficient": forward, "backward_coefficient": backward, "slip_velocity": "1 um/s"}
    size = {"lead": f"{1e3 * hand * lead} mm", "radius": f"{1e3 * radius} mm"}
    drawn.screw("thread", joints=["bearing", "guide"], **size, **rubbing, **keys)
    drawn.load("weight", body="nut", point="0, 0, 30 mm", force=f"{weight} N", direction=[0, 0, -1])
    way = -hand if lifts else hand  # a right-handed screw that turns about z pulls the nut down
    drawn.drive("motor", "bearing", speed=f"{way} rad/s")
    run = td.simulate(drawn.case())
    late = run["time"].values > 0.25
    slope = math.atan(lead / (2.0 * math.pi * radius))
    angle = slope + math.atan(forward) if lifts else math.atan(backward) - slope
    expected = way * weight * radius * math.tan(angle)
    np.testing.assert_allclose(run["drive_moment"].values[late, 0], expected, rtol=2e-3 if play else 1e-6)
    np.testing.assert_allclose(run["element_force"].values[late, 0], weight, rtol=2e-3)


@pytest.mark.parametrize("rest", [True, False])
@pytest.mark.parametrize(("velocity", "coefficient"), [(0.1, 0.1), (-0.1, 0.25)])
def test_a_guide_has_friction_by_direction(velocity: float, coefficient: float, rest: bool) -> None:
    drawn = td.Mechanism("Guide", friction={"rest": rest}, run={"duration": "0.1 s"})
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=[1, 0, 0])
    drawn.load("weight", body="block", point="0, 0, 0 mm", force="50 N", direction=[0, 0, -1])
    keys = {"friction_coefficient": 0.1, "backward_coefficient": 0.25, "slip_velocity": "1 um/s"}
    drawn.friction("rubbing", joint="face", **keys)
    drawn.drive("motor", "face", velocity=f"{velocity} m/s")
    run = td.simulate(drawn.case())
    late = run["drive_force"].values[run["time"].values > 0.05, 0]
    np.testing.assert_allclose(late, math.copysign(50.0 * coefficient, velocity), rtol=1e-6)
