"""Gears, racks and screws against closed forms: ratios, accelerations, reactions of all shafts by hand."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.builder.mechanism_builder import Mechanism

RUN = {"duration": "20 ms", "output_interval": "1 ms"}
G = 9.81
EXACT = 1e-9


def drawn(title: str, gravity: str = "0, 0, 0 m/s^2") -> Mechanism:
    return Mechanism(title, gravity=gravity, run=RUN, solver={"rtol": 1e-8})


def wheel(mechanism: Mechanism, name: str, mass: float, spin: float, centre: str) -> None:
    """Add a body with its moment of inertia about z [kg m²]."""
    inertia = f"{0.6 * spin}, {0.6 * spin}, {spin} kg m^2"
    mechanism.body(name, mass=f"{mass} kg", centre=centre, inertia=inertia)


def about_z(result: xr.Dataset, body: str) -> np.ndarray:
    return result["angular_velocity"].sel(body=body, axis="z").values


def of_joint(result: xr.Dataset, name: str, joint: str) -> np.ndarray:
    return result[name].sel(joint=joint).values


def gear_pair(flipped: tuple[bool, bool], against: bool, ratio: float, distance: float) -> xr.Dataset:
    """Return a run of two wheels on the ground under weight, a torque of 0.3 N m on the first."""
    mechanism = drawn("Gears", f"0, -{G}, 0 m/s^2")
    wheel(mechanism, "a", 1.0, 2e-3, "0, 0, 0 mm")
    wheel(mechanism, "b", 2.0, 5e-3, f"{distance} mm, 0 mm, 0 mm".replace(" mm", "", 2))
    bodies = [("ground", name) for name in "ab"]
    first, second = (pair[::-1] if flip else pair for pair, flip in zip(bodies, flipped, strict=True))
    mechanism.revolute("A", *first, point="0, 0, 0 mm", axis=[0, 0, 1])
    axis = [0, 0, -1 if against else 1]
    mechanism.revolute("B", *second, point=f"{distance}, 0, 7 mm", axis=axis)
    mechanism.gear("mesh", joints=["A", "B"], ratio=ratio)
    return td.simulate(mechanism.drive("motor", "A", torque=f"{-0.3 if flipped[0] else 0.3} N m").case())


@pytest.mark.parametrize("flipped", [(False, False), (True, False), (False, True), (True, True)])
@pytest.mark.parametrize("against", [False, True])
def test_a_gear_pair_turns_and_loads_both_shafts_as_newton_and_euler_say(flipped, against):
    # Wheels of 30 and 60 mm; the teeth push the second along y.
    result = gear_pair(flipped, against, -0.5, 90.0)
    rate = 0.3 / (2e-3 + 0.25 * 5e-3)
    time = result["time"].values
    assert about_z(result, "a") == pytest.approx(rate * time, rel=EXACT, abs=EXACT)
    assert about_z(result, "b") == pytest.approx(-0.5 * rate * time, rel=EXACT, abs=EXACT)
    teeth = 5e-3 * 0.5 * rate / 0.06
    assert result["element_force"].values == pytest.approx(teeth, rel=EXACT)
    assert result["element_moment"].values == pytest.approx(-teeth * 0.06, rel=EXACT)
    for joint, flip, force in (("A", flipped[0], G + teeth), ("B", flipped[1], 2.0 * G - teeth)):
        load = of_joint(result, "reaction_force_global", joint) * (-1.0 if flip else 1.0)
        assert load == pytest.approx(np.tile([0.0, force, 0.0], (time.size, 1)), rel=EXACT, abs=1e-8)
    # The joint of the second wheel is 7 mm beside the plane of the teeth, its mass centre too.
    moment = of_joint(result, "reaction_moment_global", "B") * (-1.0 if flipped[1] else 1.0)
    arm = np.cross([0.0, 0.0, 0.007], [0.0, 2.0 * G - teeth, 0.0])
    assert moment == pytest.approx(np.tile(-arm, (time.size, 1)), rel=1e-8, abs=1e-8)


@pytest.mark.parametrize(("ratio", "radius", "push"), [(0.25, 80.0, 1.0), (4.0, 20.0, 1.0)])
def test_an_internal_pair_meets_beyond_the_smaller_wheel(ratio: float, radius: float, push: float) -> None:
    # Radii 20 and 80 mm or the other way round, 60 mm apart: the teeth meet beyond the smaller wheel.
    result = gear_pair((False, False), False, ratio, 60.0)
    rate = 0.3 / (2e-3 + ratio**2 * 5e-3)
    assert about_z(result, "b")[-1] == pytest.approx(ratio * rate * 0.02, rel=EXACT)
    teeth = 5e-3 * ratio * rate / (1e-3 * radius)
    assert abs(result["element_force"].values) == pytest.approx(teeth, rel=EXACT)
    side = -1.0 if ratio < 1.0 else 1.0
    load = of_joint(result, "reaction_force_global", "A")[:, 1]
    assert load == pytest.approx(G + side * teeth * push, rel=1e-8)


def planetary(**drives: str) -> xr.Dataset:
    """Return a run of a planetary set of 30, 20 and 70 mm that turns as a whole or against its ring."""
    mechanism = drawn("Planetary set")
    for name, mass, spin, x in (("sun", 1.0, 1e-3, 0), ("carrier", 2.0, 4e-3, 0), ("planet", 0.5, 3e-4, 50)):
        wheel(mechanism, name, mass, spin, f"{x}, 0, 0 mm")
    wheel(mechanism, "ring", 3.0, 2e-2, "0, 0, 0 mm")
    for joint, bodies, x in (
        ("main", ("ground", "carrier"), 0),
        ("sun", ("carrier", "sun"), 0),
        ("planet", ("planet", "carrier"), 50),
        ("ring", ("carrier", "ring"), 0),
        ("brake", ("ground", "ring"), 0),
    ):
        if joint != "brake" or "ring" not in drives:
            kind = "revolute" if joint != "brake" else "fixed"
            mechanism.joint(joint, kind, *bodies, point=f"{x}, 0, 0 mm", axis=[0, 0, 1])
    mechanism.gear("inner", joints=["sun", "planet"], ratio=-1.5)
    mechanism.gear("outer", joints=["ring", "planet"], ratio=3.5)
    for joint, speed in drives.items():
        mechanism.drive(f"of {joint}".replace(" ", "-"), joint, speed=speed)
    return td.simulate(mechanism.case())


def test_ratios_of_a_planetary_set_whose_ring_is_held_are_those_of_willis() -> None:
    result = planetary(main="30 rad/s")
    assert about_z(result, "sun") == pytest.approx(30.0 * (1.0 + 70.0 / 30.0), rel=EXACT)
    assert about_z(result, "planet") == pytest.approx(30.0 * (1.0 - 70.0 / 20.0), rel=EXACT)
    assert about_z(result, "ring") == pytest.approx(0.0, abs=EXACT)
    centre = result["position"].sel(body="planet").values
    turned = 30.0 * result["time"].values
    assert centre[:, :2] == pytest.approx(0.05 * np.stack([np.cos(turned), np.sin(turned)], 1), abs=1e-12)


def test_a_planetary_set_adds_the_speeds_of_two_drives_as_a_differential() -> None:
    # Carrier against the ground, ring against the carrier.
    result = planetary(main="20 rad/s", ring="-5 rad/s")
    ring, carrier = about_z(result, "ring"), about_z(result, "carrier")
    assert carrier == pytest.approx(20.0, rel=EXACT)
    assert ring == pytest.approx(15.0, rel=EXACT)
    assert 30.0 * about_z(result, "sun") + 70.0 * ring == pytest.approx(100.0 * carrier, rel=EXACT)


def test_bevel_gears_turn_in_their_ratio_and_transmit_the_torque() -> None:
    mechanism = drawn("Bevel gears")
    mechanism.body("a", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    mechanism.body("b", mass="1 kg", centre="50, 0, 50 mm", inertia="2e-3, 2e-3, 2e-3 kg m^2")
    mechanism.revolute("A", "ground", "a", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("B", "ground", "b", point="50, 0, 50 mm", axis=[1, 0, 0])
    mechanism.gear("mesh", joints=["A", "B"], ratio=2.0)
    result = td.simulate(mechanism.drive("motor", "A", torque="0.1 N m").case())
    rate = 0.1 / (1e-3 + 4.0 * 2e-3)
    assert about_z(result, "a")[-1] == pytest.approx(rate * 0.02, rel=EXACT)
    assert result["angular_velocity"].sel(body="b", axis="x").values[-1] == pytest.approx(
        0.04 * rate, rel=EXACT
    )
    assert result["element_moment"].values == pytest.approx(2e-3 * 2.0 * rate, rel=EXACT)
    assert np.isnan(result["element_force"].values).all()


@pytest.mark.parametrize("radius", [20.0, -20.0])
def test_a_rack_moves_by_the_pitch_radius_and_loads_the_pinion(radius: float) -> None:
    mechanism = drawn("Rack", f"0, -{G}, 0 m/s^2")
    wheel(mechanism, "pinion", 1.0, 5e-4, "0, 0, 0 mm")
    mechanism.body("rack", mass="2 kg", centre="0, -20, 0 mm", inertia="1e-4, 5e-3, 5e-3 kg m^2")
    mechanism.revolute("bearing", "pinion", "ground", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.prismatic("guide", "rack", "ground", point="0, -20, 0 mm", axis=[1, 0, 0])
    mechanism.rack("mesh", joints=["bearing", "guide"], radius=f"{radius} mm")
    result = td.simulate(mechanism.drive("motor", "bearing", torque="-0.3 N m").case())
    r, time = 1e-3 * radius, result["time"].values
    rate = 0.3 / (5e-4 + 2.0 * r**2)
    assert about_z(result, "pinion") == pytest.approx(rate * time, rel=EXACT, abs=EXACT)
    assert result["position"].sel(body="rack", axis="x").values == pytest.approx(
        0.5 * r * rate * time**2, rel=EXACT, abs=1e-12
    )
    teeth = 2.0 * r * rate
    assert result["element_force"].values == pytest.approx(teeth, rel=EXACT)
    assert result["element_moment"].values == pytest.approx(-teeth * r, rel=EXACT)
    # Reactions are those on the second body, the ground.
    load = -of_joint(result, "reaction_force_global", "bearing")
    assert load == pytest.approx(np.tile([teeth, G, 0.0], (time.size, 1)), rel=EXACT, abs=1e-8)
    # About the place of the guide in the ground: teeth in the pitch line, weight where the rack has moved.
    moment = -of_joint(result, "reaction_moment_global", "guide")[:, 2]
    arm, gone = 0.02 - r, result["position"].sel(body="rack", axis="x").values
    assert moment == pytest.approx(arm * teeth + 2.0 * G * gone, rel=1e-8, abs=1e-8)


def jack(torque: float, axis: int, lead: float = 5.0, kind: str = "two") -> xr.Dataset:
    """Return a run of a screw that lifts a nut of 20 kg against its weight along z."""
    mechanism = drawn("Screw jack", f"0, 0, -{G} m/s^2")
    wheel(mechanism, "screw", 1.0, 2e-4, "0, 0, 0 mm")
    mechanism.body("nut", mass="20 kg", centre="0, 0, 30 mm", inertia="0.1, 0.1, 0.1 kg m^2")
    mechanism.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, axis])
    if kind == "two":
        mechanism.prismatic("guide", "nut", "ground", point="40, 0, 30 mm", axis=[0, 0, 1])
        mechanism.screw("thread", joints=["bearing", "guide"], lead=f"{lead} mm")
    else:
        mechanism.cylindrical("nut", "nut", "screw", point="0, 0, 30 mm", axis=[0, 0, -1])
        mechanism.screw("thread", joints=["nut"], lead=f"{lead} mm")
        mechanism.joint("guide", "pin-slot", "ground", "nut", point="40, 0, 30 mm", axis=[0, 0, 1])
    return td.simulate(mechanism.drive("motor", "bearing", torque=f"{axis * torque} N m").case())


@pytest.mark.parametrize("axis", [1, -1])
@pytest.mark.parametrize("lead", [5.0, -5.0])
@pytest.mark.parametrize("kind", ["two", "one"])
def test_a_screw_jack_without_friction_holds_and_lifts_as_its_lead_says(axis, lead, kind):
    # A right-handed screw that turns about z pulls its nut down; the torque −W lead/2π holds that.
    pitch = 1e-3 * lead / (2.0 * math.pi)
    hold = -20.0 * G * pitch
    still = jack(hold, axis, lead, kind)
    assert float(abs(still["velocity"]).max()) < 1e-9
    assert abs(still["element_force"].values) == pytest.approx(20.0 * G, rel=EXACT)
    assert of_joint(still, "reaction_force_global", "bearing")[:, 2] == pytest.approx(21.0 * G, rel=EXACT)
    moving = jack(hold + 0.1, axis, lead, kind)
    rate = 0.1 / (2e-4 + 20.0 * pitch**2)
    assert about_z(moving, "screw")[-1] == pytest.approx(rate * 0.02, rel=EXACT)
    assert moving["velocity"].sel(body="nut", axis="z").values[-1] == pytest.approx(
        -pitch * rate * 0.02, rel=EXACT
    )
    lifted = 20.0 * (G - pitch * rate)
    assert abs(moving["element_force"].values) == pytest.approx(lifted, rel=EXACT)
    assert abs(moving["element_moment"].values) == pytest.approx(lifted * abs(pitch), rel=EXACT)
    assert of_joint(moving, "reaction_force_global", "bearing")[:, 2] == pytest.approx(lifted + G, rel=EXACT)


MEAN = 8e-3  #: Mean radius of a thread with friction [m].


def rubbing_jack(
    speed: float | None, friction: float, lead: float, axis: int = 1, kind: str = "two", **given: object
) -> td.Case:
    """Return a screw jack with friction in its thread, driven at a speed [rad/s] or left alone."""
    mechanism = drawn("Screw jack", f"0, 0, -{G} m/s^2")
    wheel(mechanism, "screw", 1.0, 2e-4, "0, 0, 0 mm")
    mechanism.body("nut", mass="20 kg", centre="0, 0, 30 mm", inertia="0.1, 0.1, 0.1 kg m^2")
    mechanism.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, axis])
    thread = {"lead": f"{lead} mm", "friction_coefficient": friction, "radius": f"{1e3 * MEAN} mm", **given}
    if kind == "two":
        mechanism.prismatic("guide", "nut", "ground", point="40, 0, 30 mm", axis=[0, 0, 1])
        mechanism.screw("thread", joints=["bearing", "guide"], **thread)
    else:
        mechanism.cylindrical("nut", "nut", "screw", point="0, 0, 30 mm", axis=[0, 0, -1])
        mechanism.screw("thread", joints=["nut"], **thread)
        mechanism.joint("guide", "pin-slot", "ground", "nut", point="40, 0, 30 mm", axis=[0, 0, 1])
    if speed is not None:
        mechanism.drive("motor", "bearing", speed=f"{axis * speed!r} rad/s")
    return mechanism.case()


@pytest.mark.parametrize(("axis", "lead", "kind"), [(1, 5.0, "two"), (-1, 5.0, "one"), (1, -20.0, "two")])
@pytest.mark.parametrize("friction", [0.05, 0.15])
def test_the_efficiency_of_a_screw_jack_is_that_of_its_lead_angle_and_friction_angle(
    axis: int, lead: float, kind: str, friction: float
) -> None:
    """Raising takes W r tan(φ + ρ), lowering is helped by W r tan(φ − ρ)."""
    weight, pitch = 20.0 * G, 1e-3 * lead / (2.0 * math.pi)
    angle, rho = math.atan(abs(pitch) / MEAN), math.atan(friction)
    # Sliding is so fast that friction is developed to 1e-9.
    for rising in (True, False):
        speed = (-40.0 if rising else 40.0) * math.copysign(1.0, lead)
        run = td.simulate(rubbing_jack(speed, friction, lead, axis, kind, slip_velocity="1e-5 m/s"))
        moved = run["velocity"].sel(body="nut", axis="z").values
        assert moved == pytest.approx(-pitch * speed, rel=1e-8)
        wanted = weight * MEAN * math.tan(angle + rho if rising else angle - rho)
        assert abs(run["element_moment"].values) == pytest.approx(abs(wanted), rel=1e-8)
        assert abs(run["element_force"].values) == pytest.approx(weight, rel=1e-8)
        gone = abs(moved[-1]) * float(run["time"].values[-1])
        work = {
            name: float(run[name].values[-1]) for name in ("energy_in", "energy_friction", "energy_gravity")
        }
        assert abs(work["energy_gravity"]) == pytest.approx(weight * gone, rel=1e-8)
        if rising:
            efficiency = math.tan(angle) / math.tan(angle + rho)
            assert work["energy_gravity"] / work["energy_in"] == pytest.approx(efficiency, rel=1e-7)
        side = 1.0 if rising else -1.0
        across = weight / (math.cos(angle) - side * friction * math.sin(angle))
        slid = 40.0 * 0.02 * MEAN / math.cos(angle)
        assert work["energy_friction"] == pytest.approx(friction * across * slid, rel=1e-6)


@pytest.mark.parametrize(
    ("given", "words", "key"),
    [
        ({}, "needs the mean radius", "screws.second.radius"),
        ({"radius": "8 mm"}, "the force of screw first is not unique", "screws.first.friction_coefficient"),
    ],
)
def test_friction_of_a_thread_needs_its_radius_and_a_force_that_is_unique(given, words, key):
    mechanism = drawn("Two threads")
    wheel(mechanism, "screw", 1.0, 2e-4, "0, 0, 0 mm")
    mechanism.body("nut", mass="20 kg", centre="0, 0, 30 mm", inertia="0.1, 0.1, 0.1 kg m^2")
    mechanism.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.prismatic("guide", "nut", "ground", point="40, 0, 30 mm", axis=[0, 0, 1])
    thread = {"joints": ["bearing", "guide"], "lead": "5 mm", "friction_coefficient": 0.1}
    mechanism.screw("first", **thread, radius="8 mm").screw("second", **thread, **given)
    with pytest.raises(InputError, match=words) as caught:
        td.check(mechanism.case())
    assert caught.value.key == key


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_a_screw_locks_itself_from_a_friction_angle_above_its_lead_angle(share: float) -> None:
    """What sticks creeps, at the speed at which so much friction is developed; else W drives the screw."""
    lead, pitch = 20.0, 20e-3 / (2.0 * math.pi)
    angle = math.atan(pitch / MEAN)
    friction = share * math.tan(angle)
    run = td.simulate(rubbing_jack(None, friction, lead, slip_velocity="1e-4 m/s"))
    turning = about_z(run, "screw")
    if share > 1.0:
        developed = 1.0 / share
        creep = 1e-4 * developed / math.sqrt(1.0 - developed**2)
        assert abs(turning[-1]) * MEAN / math.cos(angle) == pytest.approx(creep, rel=1e-3)
    else:
        # N of the flanks lifts the nut and turns the screw: 20 kg p α = W − N axial, 2e-4 kg m² α = N torque.
        axial = math.cos(angle) + friction * math.sin(angle)
        torque = MEAN * (math.sin(angle) - friction * math.cos(angle))
        pushed = 20.0 * G / (axial + 20.0 * pitch * torque / 2e-4)
        assert abs(turning[-1]) == pytest.approx(pushed * torque / 2e-4 * 0.02, rel=0.02)


@pytest.mark.parametrize("spin", [2e-5, 2e-6, 1e-7])
def test_a_light_screw_holds_a_heavy_nut_by_its_friction(spin: float) -> None:
    """The load of the thread changes by more than the friction that it makes: plain rounds would diverge."""
    mechanism = drawn("Screw jack", f"0, 0, -{G} m/s^2")
    wheel(mechanism, "screw", 1.0, spin, "0, 0, 0 mm")
    mechanism.body("nut", mass="20 kg", centre="0, 0, 30 mm", inertia="0.1, 0.1, 0.1 kg m^2")
    mechanism.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.prismatic("guide", "nut", "ground", point="40, 0, 30 mm", axis=[0, 0, 1])
    thread = {"lead": "5 mm", "friction_coefficient": 0.15, "radius": "8 mm"}
    run = td.simulate(mechanism.screw("thread", joints=["bearing", "guide"], **thread).case())
    assert not run.attrs["failure"]
    slope = 5e-3 / (2.0 * math.pi * 8e-3)
    developed = slope / 0.15
    creep = 1e-3 * developed / math.sqrt(1.0 - developed**2) * math.cos(math.atan(slope)) / 8e-3
    assert abs(about_z(run, "screw")[-1]) == pytest.approx(creep, rel=1e-4)
    assert abs(run["element_force"].values[-1]) == pytest.approx(20.0 * G, rel=1e-6)
    # Derivatives know of the changing load: without, steps would be some thousand.
    assert json.loads(run.attrs["solver"])["steps"] < 200


def test_the_efficiency_of_a_gear_with_friction_in_its_bearings_is_that_of_its_tooth_force() -> None:
    """Bearings carry F/cos α and turn at different radii: friction follows the load that is transmitted."""
    first, second, journal, friction, angle, torque = 0.02, 0.05, 4e-3, 0.1, math.radians(20.0), 3.0
    mechanism = drawn("Gears", "0, 0, 0 m/s^2")
    for name, x in (("pinion", 0.0), ("wheel", first + second)):
        wheel(mechanism, name, 1.0, 1e-4, f"{1e3 * x}, 0, 0 mm")
        mechanism.revolute(f"{name}-bearing", "ground", name, point=f"{1e3 * x}, 0, 0 mm", axis=[0, 0, 1])
        mechanism.friction(
            f"{name}-friction",
            joint=f"{name}-bearing",
            radius=f"{1e3 * journal} mm",
            friction_coefficient=friction,
            slip_velocity="1e-5 m/s",
        )
    bearings = ["pinion-bearing", "wheel-bearing"]
    mechanism.gear("mesh", joints=bearings, ratio=-first / second, pressure_angle="20 deg")
    mechanism.load("brake", "wheel", direction=[0, 0, 1], moment=f"{torque} N m")
    run = td.simulate(mechanism.drive("motor", "pinion-bearing", speed="100 rad/s").case())
    rubbed = friction * journal / math.cos(angle)
    efficiency = (1.0 - rubbed / second) / (1.0 + rubbed / first)
    into, out = (abs(float(run[name].values[-1])) for name in ("energy_in", "energy_friction"))
    lifted = torque * 100.0 * first / second * float(run["time"].values[-1])
    assert out / lifted == pytest.approx(1.0 / efficiency - 1.0, rel=1e-7)
    assert into == pytest.approx(out, rel=1e-9)


def test_a_geared_five_bar_is_led_through_turns_that_its_angles_do_not_fit_in() -> None:
    # Two cranks in the ratio −0.5 and two rods: a loop, which the program first leads through its cycle.
    mechanism = drawn("Geared five-bar").body(
        "left", mass="1 kg", centre="10, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2"
    )
    mechanism.body("right", mass="1 kg", centre="110, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    top = np.array([60.0, math.sqrt(80.0**2 - 40.0**2)])
    for name, x in (("first", 20.0), ("second", 100.0)):
        x = x if name == "first" else 120.0
        middle = 0.5 * (np.array([x, 0.0]) + top)
        mechanism.body(
            name, mass="0.5 kg", centre=f"{middle[0]}, {middle[1]}, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2"
        )
    point = f"{top[0]}, {top[1]}, 0 mm"
    for name, bodies, where in (
        ("A", ("ground", "left"), "0, 0, 0 mm"),
        ("B", ("ground", "right"), "100, 0, 0 mm"),
        ("C", ("left", "first"), "20, 0, 0 mm"),
        ("D", ("right", "second"), "120, 0, 0 mm"),
        ("E", ("first", "second"), point),
    ):
        mechanism.revolute(name, *bodies, point=where, axis=[0, 0, 1])
    mechanism.gear("mesh", joints=["A", "B"], ratio=-0.5)
    mechanism.drive("motor", "A", speed="400 rad/s")
    case = mechanism.case().replace({"run.duration": "40 ms"})
    result = td.simulate(case)
    assert about_z(result, "right") == pytest.approx(-200.0, rel=1e-8)
    assert of_joint(result, "joint_angle", "B")[-1] == pytest.approx(-8.0, rel=1e-9)
    assert float(result["gap"].max()) < 1e-12


def test_two_drives_of_geared_wheels_drive_one_freedom() -> None:
    mechanism = drawn("Gears")
    wheel(mechanism, "a", 1.0, 2e-3, "0, 0, 0 mm")
    wheel(mechanism, "b", 2.0, 5e-3, "90, 0, 0 mm")
    mechanism.revolute("A", "ground", "a", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("B", "ground", "b", point="90, 0, 0 mm", axis=[0, 0, 1])
    mechanism.gear("mesh", joints=["A", "B"], ratio=-0.5).drive("one", "A", speed="1 rad/s")
    with pytest.raises(InputError, match="drives one and two drive one freedom"):
        td.simulate(mechanism.drive("two", "B", speed="1 rad/s").case())


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"B": ("a", "b")}, None),
        ({"joints": ["A", "A"]}, "twice the joint A"),
        ({"joints": ["A", "C"]}, "A and C share no body"),
        ({"joints": ["A", "D"]}, "A and D join the same two bodies"),
        ({"ratio": 1.0}, "have no pitch point"),
    ],
)
def test_misdescribed_gears_are_refused_with_the_reason(change, reason):
    mechanism = drawn("Gears")
    for name, x in (("a", 0), ("b", 90), ("c", 0)):
        wheel(mechanism, name, 1.0, 2e-3, f"{x}, 0, 0 mm")
    bodies = {"A": ("ground", "a"), "B": ("ground", "b"), "C": ("b", "c"), "D": ("a", "ground")}
    bodies |= {name: change[name] for name in bodies if name in change}
    for name, (first, second) in bodies.items():
        mechanism.revolute(name, first, second, point=f"{90 * (name == 'B')}, 0, 0 mm", axis=[0, 0, 1])
    keys = {"joints": ["A", "B"], "ratio": -0.5, **{k: v for k, v in change.items() if k not in bodies}}
    mechanism.gear("mesh", **keys)
    if reason is None:
        # A common body that moves is a carrier.
        assert mechanism.case().gears["mesh"].ratio == -0.5
        return
    with pytest.raises(InputError, match=rf"gears\.mesh\..*{re.escape(reason)}"):
        mechanism.case()


def test_the_teeth_press_the_pin_of_a_real_bearing_into_its_bore() -> None:
    # At rest: 0.3 N m on 30 mm, the other wheel held.
    mechanism = drawn("Gears")
    wheel(mechanism, "a", 1.0, 2e-3, "0, 0, 0 mm")
    wheel(mechanism, "b", 2.0, 5e-3, "90, 0, 0 mm")
    mechanism.revolute("A", "ground", "a", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("B", "ground", "b", point="90, 0, 0 mm", axis=[0, 0, 1])
    mechanism.gear("mesh", joints=["A", "B"], ratio=-0.5)
    mechanism.clearance("A", radius="10 mm", radial="20 um", length="20 mm", friction_coefficient=0.0)
    mechanism.drive("motor", "A", torque="0.3 N m").drive("hold", "B", angle="0 deg")
    result = td.simulate(mechanism.case())
    assert result.attrs["start"] == "equilibrium"
    assert result["element_force"].values == pytest.approx(10.0, rel=1e-6)
    contact = result["contact_force"].sel(joint="A").values
    assert contact == pytest.approx(np.tile([0.0, 10.0, 0.0], (len(contact), 1)), rel=1e-6, abs=1e-5)
    # The pin rests in its bore, so the pinion has turned by its displacement over the pitch radius.
    shift = result["displacement"].sel(joint="A", axis="y").values
    assert float(abs(shift).max()) > 10e-6
    assert of_joint(result, "joint_angle", "A") == pytest.approx(-shift / 0.03, rel=1e-6)


def test_the_thread_of_a_real_nut_carries_its_weight_by_the_angle_of_its_tilted_joint() -> None:
    # The nut lies in a bore with clearance; a pin at 40 mm takes the torque of the thread, W lead/2π.
    mechanism = drawn("Screw", f"0, 0, -{G} m/s^2")
    wheel(mechanism, "screw", 1.0, 2e-4, "0, 0, 0 mm")
    mechanism.body("nut", mass="20 kg", centre="0, 0, 30 mm", inertia="0.1, 0.1, 0.1 kg m^2")
    mechanism.fixed("bearing", "ground", "screw", point="0, 0, 0 mm")
    mechanism.cylindrical("nut", "screw", "nut", point="0, 0, 30 mm", axis=[0, 0, 1])
    mechanism.clearance("nut", radius="10 mm", radial="20 um", length="40 mm", friction_coefficient=0.0)
    mechanism.screw("thread", joints=["nut"], lead="5 mm")
    mechanism.joint("guide", "pin-slot", "ground", "nut", point="40, 0, 30 mm", axis=[0, 0, 1])
    result = td.simulate(mechanism.case())
    assert result.attrs["start"] == "equilibrium"
    assert result["element_force"].values == pytest.approx(20.0 * G, rel=1e-6)
    side = 20.0 * G * 5e-3 / (2.0 * math.pi) / 0.04
    contact = result["contact_force"].sel(joint="nut").values
    assert np.linalg.norm(contact, axis=1) == pytest.approx(side, rel=1e-4)
    gone, angle = result["displacement"].sel(joint="nut", axis="z"), result["joint_angle"].sel(joint="nut")
    assert gone.values == pytest.approx(5e-3 / (2.0 * math.pi) * angle.values, rel=1e-9)


def test_gears_that_transmit_a_torque_alone_take_no_bearing_with_clearance() -> None:
    mechanism = drawn("Coaxial")
    for name in ("a", "b"):
        wheel(mechanism, name, 1.0, 2e-3, "0, 0, 0 mm")
        mechanism.revolute(name, "ground", name, point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.gear("box", joints=["a", "b"], ratio=3.0)
    mechanism.clearance("b", radius="10 mm", radial="20 um", length="20 mm")
    with pytest.raises(
        InputError, match=r"gears\.box\.joints: .*b has clearance, .* lack the force of the teeth"
    ):
        mechanism.case()


def test_three_planets_share_the_load_and_say_so() -> None:
    # Each planet but the first has an equation that follows from the others.
    mechanism = drawn("Planetary set of three")
    wheel(mechanism, "sun", 1.0, 1e-3, "0, 0, 0 mm")
    wheel(mechanism, "carrier", 2.0, 4e-3, "0, 0, 0 mm")
    mechanism.revolute("main", "ground", "carrier", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("sun", "carrier", "sun", point="0, 0, 0 mm", axis=[0, 0, 1])
    for k in range(3):
        x, y = 50.0 * math.cos(2.0 * math.pi * k / 3.0), 50.0 * math.sin(2.0 * math.pi * k / 3.0)
        wheel(mechanism, f"planet-{k}", 0.5, 3e-4, f"{x}, {y}, 0 mm")
        mechanism.revolute(f"pin-{k}", "carrier", f"planet-{k}", point=f"{x}, {y}, 0 mm", axis=[0, 0, 1])
        mechanism.gear(f"inner-{k}", joints=["sun", f"pin-{k}"], ratio=-1.5)
        mechanism.gear(f"outer-{k}", joints=["main", f"pin-{k}"], ratio=3.5)
    mechanism.load("input", "sun", direction=[0, 0, 1], moment="0.3 N m")
    result = td.simulate(mechanism.case())
    assert "2 constraints more than are independent" in result.attrs["warnings"]
    # The carrier turns at 0.3 of the speed of the sun, the planets at −0.75 of it.
    mass = 1e-3 + 0.3**2 * (4e-3 + 3.0 * 0.5 * 0.05**2) + 3.0 * 0.75**2 * 3e-4
    assert about_z(result, "sun") == pytest.approx(0.3 / mass * result["time"].values, rel=1e-9, abs=1e-9)
    inner = result["element_force"].sel(element=[f"inner-{k}" for k in range(3)]).values
    total = (0.3 - 1e-3 * 0.3 / mass) / 0.03
    assert abs(inner.sum(axis=1)) == pytest.approx(total, rel=1e-7)
    # Shares are not unique: the norm weighs components of the pins, whose axes do not follow the planets.
    assert abs(inner) == pytest.approx(total / 3.0, rel=0.02)


def test_wheels_begin_where_a_drive_of_several_turns_puts_them() -> None:
    mechanism = drawn("Gears")
    wheel(mechanism, "a", 1.0, 2e-3, "0, 0, 0 mm")
    wheel(mechanism, "b", 2.0, 5e-3, "90, 0, 0 mm")
    mechanism.revolute("A", "ground", "a", point="0, 0, 0 mm", axis=[0, 0, 1])
    mechanism.revolute("B", "ground", "b", point="90, 0, 0 mm", axis=[0, 0, 1])
    mechanism.gear("mesh", joints=["A", "B"], ratio=-0.3)
    result = td.simulate(mechanism.drive("motor", "A", angle="800 deg").case())
    turned = math.radians(-240.0)
    expected = math.cos(0.5 * turned), math.sin(0.5 * turned)
    found = result["orientation"].sel(body="b", entry=["w", "z"]).values
    assert abs(found @ expected) == pytest.approx(1.0, rel=1e-12)
    assert float(result["gap"].max()) < 1e-12


def test_a_linkage_that_its_gears_do_not_let_move_is_refused_with_a_reason() -> None:
    # A parallelogram whose cranks are to turn in another ratio than 1.
    mechanism = drawn("Parallelogram")
    for name, x, y in (("left", 0, 20), ("right", 100, 20), ("rod", 50, 40)):
        wheel(mechanism, name, 1.0, 1e-3, f"{x}, {y}, 0 mm")
    for name, bodies, where in (
        ("A", ("ground", "left"), "0, 0, 0 mm"),
        ("B", ("ground", "right"), "100, 0, 0 mm"),
        ("C", ("left", "rod"), "0, 40, 0 mm"),
        ("D", ("right", "rod"), "100, 40, 0 mm"),
    ):
        mechanism.revolute(name, *bodies, point=where, axis=[0, 0, 1])
    mechanism.gear("mesh", joints=["A", "B"], ratio=0.5).drive("motor", "A", angle="30 deg")
    with pytest.raises(InputError, match=r"does not (close|hold)"):
        td.simulate(mechanism.case())
