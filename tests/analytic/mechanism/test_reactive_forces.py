"""Forces that follow reactions: friction by the reaction of an ideal joint, teeth that push wheels apart."""

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError

MU, RADIUS, MASS, ARM, INERTIA = 0.2, 0.02, 2.0, 0.1, 1e-3


def arm(**friction: Any) -> td.Mechanism:
    """Return an arm that spins down in a pivot, without gravity: its mass centre loads the pivot."""
    drawn = td.Mechanism("Arm", run={"duration": "0.5 s"}, solver={"rtol": 1e-8})
    tensor = f"{INERTIA}, {INERTIA}, {INERTIA} kg m^2"
    drawn.body("arm", mass=f"{MASS} kg", centre=f"{ARM * 1e3}, 0, 0 mm", inertia=tensor)
    axis = {"point": "0, 0, 0 mm", "axis": [0, 0, 1], "start_speed": "30 rad/s"}
    drawn.revolute("pivot", "ground", "arm", **axis)
    keys = {"radius": f"{RADIUS * 1e3} mm", "friction_coefficient": MU, "slip_velocity": "1 um/s"}
    drawn.friction("bearing", joint="pivot", **keys, **friction)
    return drawn


def test_an_arm_spins_down_by_its_own_centrifugal_force() -> None:
    # J ω̇ = −μ r N, N² = (m a)² (ω⁴ + ω̇²): ω̇ = −k ω²/√(1 − k²), k = μ r m a/J.
    run = td.simulate(arm().case())
    k = MU * RADIUS * MASS * ARM / (INERTIA + MASS * ARM**2)
    c = k / math.sqrt(1.0 - k * k)
    speed = run["relative_rate"].values[:, 0, 2]
    np.testing.assert_allclose(speed, 30.0 / (1.0 + 30.0 * c * run["time"].values), rtol=1e-6)
    rate = -c * speed**2
    normal = MASS * ARM * np.hypot(speed**2, rate)
    np.testing.assert_allclose(run["element_moment"].values[:, 0], -MU * RADIUS * normal, rtol=1e-6)
    reaction = np.linalg.norm(run["reaction_force"].values[:, 0, :2], axis=1)
    np.testing.assert_allclose(reaction, normal, rtol=1e-6)
    assert run.attrs["energy_residual"] < 1e-5


def test_a_stated_load_is_what_it_was() -> None:
    run = td.simulate(arm(normal_load="40 N").case())
    torque = -MU * RADIUS * 40.0
    np.testing.assert_allclose(run["element_moment"].values[:, 0], torque, rtol=1e-6)


def test_a_sliding_block_slows_down_by_its_weight() -> None:
    drawn = td.Mechanism("Block", gravity="0, 0, -9.81 m/s^2", run={"duration": "0.2 s"})
    drawn.body("block", mass="3 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    axis = {"point": "0, 0, 0 mm", "axis": [1, 0, 0], "start_velocity": "1 m/s"}
    drawn.prismatic("guide", "ground", "block", **axis)
    drawn.friction("rail", joint="guide", friction_coefficient=0.3, slip_velocity="1 um/s")
    run = td.simulate(drawn.case())
    expected = 1.0 - 0.3 * 9.81 * run["time"].values
    np.testing.assert_allclose(run["relative_velocity"].values[:, 0, 2], expected, rtol=1e-6)


def test_friction_without_a_unique_reaction_is_refused() -> None:
    drawn = arm()
    drawn.revolute("other", "ground", "arm", point="0, 0, 50 mm", axis=[0, 0, 1])
    with pytest.raises(InputError, match="the reaction of pivot is not unique") as caught:
        td.simulate(drawn.case())
    assert caught.value.key == "frictions.bearing.normal_load"


def test_friction_beside_that_of_a_clearance_is_refused() -> None:
    drawn = arm().clearance("pivot", radius="6 mm", radial="20 um", length="20 mm")
    with pytest.raises(InputError, match="friction of its own") as caught:
        drawn.case()
    assert caught.value.key == "frictions.bearing.joint"


def wheels(ratio: float, distance: float, **gear: Any) -> xr.Dataset:
    """Return a gear pair under a torque on the first wheel; mass centres lie on the axes."""
    drawn = td.Mechanism("Gears", run={"duration": "20 ms"}, solver={"rtol": 1e-8})
    drawn.body("first", mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
    drawn.body("second", mass="4 kg", centre=f"{distance}, 0, 0 mm", inertia="5e-3, 5e-3, 9e-3 kg m^2")
    drawn.revolute("input", "ground", "first", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("output", "ground", "second", point=f"{distance}, 0, 0 mm", axis=[0, 0, 1])
    drawn.gear("mesh", joints=["input", "output"], ratio=ratio, **gear)
    drawn.drive("motor", "input", torque="0.2 N m")
    return td.simulate(drawn.case())


@pytest.mark.parametrize(("ratio", "distance"), [(-0.5, 90.0), (0.4, 60.0)])
def test_rigid_teeth_push_the_wheels_apart(ratio: float, distance: float) -> None:
    # Statics of both wheels: the bearing carries the tooth force, tangential and F tan α along the centres.
    pushed = wheels(ratio, distance, pressure_angle="25 deg")
    plain = wheels(ratio, distance)
    tooth = np.abs(pushed["element_force"].values[:, 0])
    assert tooth.min() > 1.0
    np.testing.assert_allclose(tooth, np.abs(plain["element_force"].values[:, 0]), rtol=1e-9)
    apart = math.tan(math.radians(25.0)) * tooth
    for joint, sign in ((0, 1.0), (1, -1.0)):
        force = pushed["reaction_force_global"].values[:, joint]
        np.testing.assert_allclose(np.linalg.norm(force[:, :2], axis=1), np.hypot(tooth, apart), rtol=1e-9)
        # External wheels are pushed apart, so their bearings hold them together; an internal pair likewise.
        inside = 1.0 if ratio < 0.0 else -1.0
        np.testing.assert_allclose(force[:, 0], sign * inside * apart, rtol=1e-8)
    reaction = plain["reaction_force_global"].values
    np.testing.assert_allclose(reaction[:, :, 0], 0.0, atol=1e-9 * tooth.max())


def test_a_pressure_angle_needs_pitch_circles() -> None:
    drawn = td.Mechanism("Gears", run={"duration": "20 ms"})
    for name, axis in (("first", [0, 0, 1]), ("second", [1, 0, 0])):
        drawn.body(name, mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
        drawn.revolute(f"of-{name}", "ground", name, point="0, 0, 0 mm", axis=axis)
    drawn.gear("mesh", joints=["of-first", "of-second"], ratio=-1.0, pressure_angle="20 deg")
    with pytest.raises(InputError, match="no pitch circles"):
        drawn.case()
