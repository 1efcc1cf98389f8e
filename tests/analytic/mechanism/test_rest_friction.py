"""Friction that holds at rest: closed forms, passivity, and what must not creep."""

import json
import math
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.surface.memory import NORMAL
from tribodyn.kernels.mechanism.data import Law
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.bristle import bristle
from tribodyn.mechanism.mechanism_case import MechanismCase

GRAVITY, SIZE = 9.81, 0.1
STEEP = math.atan(0.2)
HELD = {"rest": True}


def block(coefficient: float, **changes: Any) -> td.Mechanism:
    """Return a block on an incline."""
    drawn = td.Mechanism("Block", gravity=f"0, 0, -{GRAVITY} m/s^2", **({"friction": HELD} | changes))
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    axis = [math.cos(STEEP), 0.0, -math.sin(STEEP)]
    drawn.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=axis)
    drawn.friction("rubbing", joint="face", friction_coefficient=coefficient)
    return drawn


def moved(run: Any, after: float) -> float:
    """Return how far bodies move after a time [m]."""
    late = run["position"].values[run["time"].values > after]
    return float(np.ptp(late, axis=0).max())


def test_a_block_holds_on_an_incline() -> None:
    run = td.simulate(block(0.25, run={"duration": "1000 s"}).case())
    assert moved(run, 1.0) < 1e-9 * SIZE
    assert moved(run, -1.0) < 2e-6  # from no load to that of the weight: less than the presliding
    assert run.attrs["energy_residual"] < 1e-3


def test_a_block_slides_by_the_law_of_coulomb() -> None:
    run = td.simulate(block(0.15, run={"duration": "1 s"}, solver={"rtol": 1e-7}).case())
    expected = GRAVITY * (math.sin(STEEP) - 0.15 * math.cos(STEEP))
    late = run["time"].values > 0.1
    found = np.linalg.norm(run["acceleration"].values[late, 0], axis=1)
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_stick_slip() -> None:
    """A mass on a spring whose end moves at V: y'' = −ω² y from y = (μ_s − μ) N/k, y' = V, until y' = V."""
    mass, stiffness, load, drive = 2.0, 2000.0, 100.0, 0.02
    drawn = td.Mechanism("Stick-slip", friction=HELD | {"presliding": "0.1 um"}, run={"duration": "3 s"})
    for name, x in (("driver", -200.0), ("mass", 0.0)):
        drawn.body(name, mass=f"{mass} kg", centre=f"{x}, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        drawn.prismatic(f"guide-{name}", "ground", name, point=f"{x}, 0, 0 mm", axis=[1, 0, 0])
    drawn.drive("motor", joint="guide-driver", velocity=f"{drive} m/s")
    ends = {"first_point": "-200, 0, 0 mm", "second_point": "0, 0, 0 mm"}
    drawn.spring("pull", "driver", "mass", stiffness=f"{stiffness} N/m", **ends)
    coefficients = {"friction_coefficient": 0.2, "static_coefficient": 0.3, "stribeck_velocity": "0.1 mm/s"}
    drawn.friction("rubbing", joint="guide-mass", normal_load=f"{load} N", **coefficients)
    run = td.simulate(drawn.case().replace({"run.output_interval": "0.2 ms"}))
    omega, excess = math.sqrt(stiffness / mass), 0.1 * load / stiffness
    period = 2.0 * excess / drive + (2.0 * math.pi - 2.0 * math.atan(excess * omega / drive)) / omega
    speed, times = run["velocity"].sel(body="mass").values[:, 0], run["time"].values
    fast = speed > 0.5 * speed.max()
    begins = times[1:][fast[1:] & ~fast[:-1]]
    assert len(begins) > 3
    assert np.mean(np.diff(begins[1:])) == pytest.approx(period, rel=0.005)


def test_a_screw_holds_under_vibration() -> None:
    """tan φ = lead/(2π r) = 0.1 < μ. The nut carries 200 N and shakes by 15 %."""
    drawn = td.Mechanism("Screw", friction=HELD, run={"duration": "1000 s"})
    drawn.body("screw", mass="1 kg", centre="0, 0, 50 mm", inertia="1e-3, 1e-3, 2e-4 kg m^2")
    drawn.body("nut", mass="2 kg", centre="0, 0, 30 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.prismatic("guide", "ground", "nut", point="0, 0, 30 mm", axis=[0, 0, 1])
    thread = {"lead": f"{0.2 * math.pi * 8.0} mm", "radius": "8 mm", "friction_coefficient": 0.15}
    drawn.screw("thread", joints=["bearing", "guide"], **thread)
    where = {"body": "nut", "point": "0, 0, 30 mm", "direction": [0, 0, -1]}
    drawn.load("weight", **where, force="200 N")
    drawn.load("shaking", **where, force={"amplitude": "30 N", "angular_frequency": f"{math.pi} rad/s"})
    run = td.simulate(drawn.case())
    times, height = run["time"].values, run["position"].sel(body="nut").values[:, 2]
    # One period apart, so that what is elastic is not counted.
    first = np.interp(np.arange(10.0, 20.0, 0.25), times, height)
    last = np.interp(np.arange(980.0, 990.0, 0.25), times, height)
    assert np.abs(last - first).max() < 1e-9 * SIZE


def law(**changes: float) -> tuple[Record, Record]:
    """Return parameters and arguments of the law of the bristle."""
    given = {"normal_load": 10.0, "friction_coefficient": 0.2, "stribeck_velocity": 1.0}
    given |= {"presliding": 1e-6, "reverse": 1.0}
    joint = new_record(bristle.fields)
    for name, value in (given | changes).items():
        setattr(joint, name, value)
    return joint, new_record(Law)


@pytest.mark.parametrize("steps", [2_000, pytest.param(100_000, marks=pytest.mark.long(minutes=0.8))])
def test_friction_is_passive_under_any_load(steps: int) -> None:
    """What it takes in is never less than what it stores more, under loads with lift-off."""
    random, (joint, now) = np.random.default_rng(60), law(breakaway=0.1)
    loads = np.maximum(10.0 * random.normal(size=steps), 0.0)
    ways = 5e-7 * random.standard_t(2.0, size=steps)
    taken = stored = 0.0
    for load, way in zip(loads, ways, strict=True):
        joint.normal_load, now.rate = load, way / 1e-4
        bristle(joint, now)
        before, kept = now.force, now.next_elastic**2 / max(now.next_stiffness, 1e-300)
        assert 0.5 * kept <= stored * (1.0 + 1e-12)  # a change of the load at rest gives nothing
        now.position = now.anchor + way
        bristle(joint, now)
        taken -= 0.5 * (before + now.force) * way
        stored = 0.5 * now.next_elastic**2 / max(now.next_stiffness, 1e-300)
        now.anchor, now.elastic, now.stiffness = now.position, now.next_elastic, now.next_stiffness
        assert taken >= stored - 1e-12
    assert taken > 10.0 * stored


def test_loops_of_presliding_follow_masing() -> None:
    """Back from a displacement the force is twice the first loading at half the way; then comes the limit."""
    joint, now = law()
    limit, ways = 0.2 * 10.0, 1e-6 * np.array([0.3, 0.6, 0.2, -0.4, -0.9, -1.3, -1.5, 0.1])
    found = []
    for way in ways:
        now.position = way
        bristle(joint, now)
        found.append(-now.force / limit)
        now.anchor, now.elastic, now.stiffness = way, now.next_elastic, now.next_stiffness
    # A spring of 2 N/um that yields at 2 N, at -1 um for the first time.
    np.testing.assert_allclose(found, [0.3, 0.6, 0.2, -0.4, -0.9, -1.0, -1.0, 0.6], rtol=1e-12)


def test_a_parked_four_bar_holds() -> None:
    drawn = td.Mechanism(
        "Four-bar", gravity=f"0, -{GRAVITY}, 0 m/s^2", friction=HELD, run={"duration": "1000 s"}
    )
    points = {"main": (0, 0), "pin": (30, 0), "top": (60, 70), "pivot": (90, 0)}
    bodies = {"crank": ("main", "pin"), "coupler": ("pin", "top"), "rocker": ("top", "pivot")}
    for name, ends in bodies.items():
        x, y = (sum(points[end][k] for end in ends) / 2.0 for k in range(2))
        drawn.body(name, mass="0.3 kg", centre=f"{x}, {y}, 0 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    kinds = {"main": "revolute", "pin": "spherical", "top": "cylindrical", "pivot": "revolute"}
    for first, second, name in zip(("ground", *bodies), (*bodies, "ground"), points, strict=True):
        axis = {} if name == "pin" else {"axis": [0, 0, 1]}
        x, y = points[name]
        getattr(drawn, kinds[name])(name, first, second, point=f"{x}, {y}, 0 mm", **axis)
    for name, load in (("main", {"normal_load": "100 N"}), ("pivot", {})):
        drawn.friction(f"rubbing-{name}", joint=name, radius="10 mm", friction_coefficient=0.2, **load)
    run = td.simulate(drawn.case())
    assert moved(run, 10.0) < 1e-9 * SIZE
    free = td.simulate(drawn.case().replace({"friction.rest": False, "run.duration": "10 s"}))
    assert moved(free, 5.0) > 1e-4 * SIZE


def pin(offset: float, **changes: Any) -> td.Mechanism:
    """Return an arm on a pin with clearance, whose mass centre lies beside the pin [mm]."""
    gravity = f"0, -{GRAVITY}, 0 m/s^2"
    drawn = td.Mechanism(
        "Pin", gravity=gravity, **({"friction": HELD, "run": {"duration": "100 s"}} | changes)
    )
    drawn.body("arm", mass="1 kg", centre=f"{offset}, 0, 0 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    drawn.revolute("pivot", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    sizes = {"radius": "10 mm", "radial": "20 um", "length": "20 mm", "axial": "50 um"}
    return drawn.clearance("pivot", **sizes, friction_coefficient=0.1, nodes_around=48, nodes_along=4)


def test_a_pin_holds_in_its_bore() -> None:
    """The weight beside the pin has the arm 0.5 mm, friction μ R = 1 mm."""
    run = td.simulate(pin(0.5).case())
    assert moved(run, 5.0) < 1e-9 * 0.02
    free = td.simulate(pin(0.5).case().replace({"friction.rest": "false", "run.duration": "10 s"}))
    assert moved(free, 5.0) > 1e-6


SHAPES: dict[str, dict[str, Any]] = {
    "square": {"width": "30 mm", "height": "20 mm", "length": "60 mm"},
    "dovetail": {
        "shape": "dovetail",
        "width": "30 mm",
        "height": "10 mm",
        "flank_angle": "60 deg",
        "length": "60 mm",
    },
    "cylinder": {"shape": "cylinder", "radius": "10 mm", "length": "60 mm"},
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_block_holds_in_a_guide_with_play(shape: str) -> None:
    drawn = td.Mechanism("Block", gravity=f"0, 0, -{GRAVITY} m/s^2", friction=HELD, run={"duration": "100 s"})
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    axis = [math.cos(STEEP), 0.0, -math.sin(STEEP)]
    drawn.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=axis, second_axis=[0, 1, 0])
    drawn.clearance("face", radial="20 um", friction_coefficient=0.3, **SHAPES[shape])
    run = td.simulate(drawn.case())
    assert run.attrs["failure"] == ""
    assert moved(run, 5.0) < 1e-9 * SIZE


def ball() -> td.Mechanism:
    """Return an arm on a ball with clearance, whose mass centre lies beside the ball."""
    drawn = td.Mechanism("Ball", gravity=f"0, -{GRAVITY}, 0 m/s^2", friction=HELD, run={"duration": "100 s"})
    drawn.body("arm", mass="1 kg", centre="0.3, 0, 0.2 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    drawn.spherical("seat", "ground", "arm", point="0, 0, 0 mm")
    sizes = {"radius": "10 mm", "radial": "20 um"}
    return drawn.clearance("seat", **sizes, friction_coefficient=0.1, nodes_around=48, nodes_along=12)


def test_a_ball_holds_in_its_socket() -> None:
    assert moved(td.simulate(ball().case()), 5.0) < 1e-9 * SIZE


def on_triangles(coefficient: float, duration: str) -> Any:
    """Return the run of a block on a face of triangles, which is the incline of :func:`block`."""
    slope = f"{GRAVITY * math.sin(STEEP)}, 0, {-GRAVITY * math.cos(STEEP)} m/s^2"
    drawn = td.Mechanism("Block", gravity=slope, friction=HELD, run={"duration": duration})
    drawn.body("block", mass="2 kg", centre="0, 0, 5 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.spherical("face", "ground", "block", point="0, 0, 0 mm")
    facets = "-20, -20, 0, 20, -20, 0, 20, 20, 0, -20, -20, 0, 20, 20, 0, -20, 20, 0 mm"
    mesh = {"shape": "mesh", "facets": facets, "gap": "20 um", "mesh_edge": "8 mm"}
    drawn.clearance("face", **mesh, friction_coefficient=coefficient)
    run = td.simulate(drawn.case().replace({"solver.rtol": 1e-6}))
    assert run.attrs["failure"] == ""
    return run


def test_a_block_holds_on_triangles() -> None:
    assert moved(on_triangles(0.25, "1000 s"), 5.0) < 1e-9 * SIZE


def test_a_block_slides_on_triangles_by_the_law_of_coulomb() -> None:
    """It rocks as it has fallen on them: speeds scatter by some 3e-4 around the mean acceleration."""
    run = on_triangles(0.15, "0.2 s")
    late = run["time"].values > 0.1
    found = np.polyfit(run["time"].values[late], run["velocity"].values[late, 0, 0], 1)[0]
    assert found == pytest.approx(GRAVITY * (math.sin(STEEP) - 0.15 * math.cos(STEEP)), rel=1e-3)


MESHES: dict[str, dict[str, Any]] = {
    "backlash": {"backlash": "0.1 mm", "mesh_stiffness": "1e8 N/m"},
    "losses": {"efficiency": 0.9, "backward_efficiency": 0.8},
    "worm": {"lead_angle": "3 deg", "friction_coefficient": 0.1},
}


@pytest.mark.parametrize("mesh", MESHES)
def test_a_gear_pair_holds_under_a_torque(mesh: str) -> None:
    """The bearing of the pinion holds 0.2 N m against the 0.15 N m of the wheel."""
    drawn = td.Mechanism("Gears", friction=HELD, run={"duration": "1000 s"})
    drawn.body("pinion", mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
    drawn.body("wheel", mass="4 kg", centre="90, 0, 0 mm", inertia="5e-3, 5e-3, 9e-3 kg m^2")
    drawn.revolute("input", "ground", "pinion", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("output", "ground", "wheel", point="90, 0, 0 mm", axis=[0, 0, 1])
    drawn.gear("mesh", joints=["input", "output"], ratio=-0.5, **MESHES[mesh])
    load = {"radius": "10 mm", "friction_coefficient": 0.2, "normal_load": "100 N"}
    drawn.friction("rubbing", joint="input", **load)
    drawn.load("torque", body="wheel", moment="0.3 N m", direction=[0, 0, 1])
    run = td.simulate(drawn.case())
    assert run.attrs["failure"] == ""
    assert turned(run, 5.0) < 1e-9


def turned(run: Any, after: float) -> float:
    """Return how far bodies turn after a time [rad]."""
    late = run["orientation"].values[run["time"].values > after]
    return 2.0 * float(np.ptp(late, axis=0).max())


def test_a_pin_holds_in_its_slot() -> None:
    """A spring presses the slot on the pin with 100 N, and 6 N pull it along with a coefficient of 0.2."""
    drawn = td.Mechanism("Slot", friction=HELD, run={"duration": "1000 s"})
    for name, kind, axis in (("yoke", "guide", [1, 0, 0]), ("pin", "slide", [0, 1, 0])):
        drawn.body(name, mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        drawn.prismatic(kind, "ground", name, point="0, 0, 0 mm", axis=axis)
    drawn.slot("contact", "yoke", "pin", point="0, 0, 0 mm", axis=[0, 1, 0], second_axis=[0, 0, 1])
    sizes = {"radius": "5 mm", "radial": "20 um", "length": "20 mm"}
    drawn.clearance("contact", **sizes, friction_coefficient=0.2)
    ends = {"first_point": "-100, 0, 0 mm", "second_point": "0, 0, 0 mm"}
    drawn.spring("back", "ground", "yoke", stiffness="1e5 N/m", damping="100 N s/m", **ends)
    for name, body, force, direction in (("press", "yoke", 100, [1, 0, 0]), ("pull", "pin", 6, [0, 1, 0])):
        drawn.load(name, body=body, point="0, 0, 0 mm", force=f"{force} N", direction=direction)
    run = td.simulate(drawn.case())
    assert run.attrs["failure"] == ""
    assert moved(run.sel(body=["pin"]), 5.0) < 1e-9 * SIZE


@pytest.mark.parametrize(("torque", "holds"), [(0.2, True), (0.35, False)])
def test_an_end_face_holds_under_load_and_torque(torque: float, holds: bool) -> None:
    """Its limit is the coefficient times 100 N times the mean radius of 14 mm: 0.28 N m."""
    drawn = td.Mechanism("Face", friction=HELD, run={"duration": "1000 s" if holds else "0.2 s"})
    drawn.body("shaft", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    drawn.revolute("pivot", "ground", "shaft", point="0, 0, 0 mm", axis=[0, 0, 1])
    sizes = {"radius": "10 mm", "radial": "20 um", "length": "20 mm", "axial": "50 um", "flange": "18 mm"}
    drawn.clearance("pivot", **sizes, friction_coefficient=0.2, nodes_around=48, nodes_along=8)
    drawn.load("push", body="shaft", point="0, 0, 0 mm", force="100 N", direction=[0, 0, -1])
    drawn.load("torque", body="shaft", moment=f"{torque} N m", direction=[0, 0, 1])
    run = td.simulate(drawn.case())
    assert run.attrs["failure"] == ""
    if holds:
        assert max(moved(run, 5.0) / SIZE, turned(run, 5.0)) < 1e-9
    else:
        assert turned(run, 0.1) > 0.1


@pytest.mark.parametrize("seed", range(1))
def test_friction_of_a_guide_with_play_gives_no_energy_under_random_loads(seed: int) -> None:
    """Its heat never falls by more than what sticks can store, below mu N delta with the largest load N."""
    random, times = np.random.default_rng(seed), np.linspace(0.0, 2.0, 81)
    drawn = td.Mechanism("Block", friction=HELD, run={"duration": "2 s"})
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=[1, 0, 0], second_axis=[0, 1, 0])
    drawn.clearance("face", radial="20 um", friction_coefficient=0.3, **SHAPES["square"])
    largest = 0.0
    for name, direction, size in (("across", [0, 0, -1], 40.0), ("along", [1, 0, 0], 8.0)):
        values = size * random.normal(size=times.size)
        largest = max(largest, float(np.abs(values).max()))
        table = {"times": [f"{t} s" for t in times], "values": [f"{force} N" for force in values]}
        drawn.load(name, body="block", point="0, 0, 0 mm", direction=direction, force=table)
    run = td.simulate(drawn.case())
    heat = run["energy_friction"].values
    assert run.attrs["failure"] == ""
    assert (np.maximum.accumulate(heat) - heat).max() < 0.3 * largest * 1e-6
    assert heat[-1] > 10.0 * 0.3 * largest * 1e-6


def test_a_sliding_pin_has_the_friction_of_the_regularised_law() -> None:
    """Of mu p v/sqrt(v² + u²), with v + 5 u in the place of v while what sticks is at its bound."""
    found = []
    for held in (True, False):
        drawn = pin(0.0, friction={"rest": held}, run={"duration": "50 ms"}, solver={"rtol": 1e-7})
        drawn.drive("motor", "pivot", speed="1000 rpm")
        run = td.simulate(drawn.case())
        found.append([run["drive_moment"].values[-1, 0], run["energy_friction"].values[-1]])
        assert run.attrs["energy_residual"] < 1e-4
    over = 0.001 / (0.01 * 1000.0 * math.pi / 30.0)
    expected = math.sqrt((1.0 + over**2) / (1.0 + (over / (1.0 + 5.0 * over)) ** 2))
    np.testing.assert_allclose(np.divide(*found), expected, rtol=0.0, atol=2e-10)
    assert np.divide(*found) - 1.0 == pytest.approx(5.0 * over**3, rel=0.05)


def test_friction_without_a_load_is_refused() -> None:
    with pytest.raises(InputError, match="holds by its load") as caught:
        block(0.2, run={"duration": "1 s"}).case().replace({"frictions.rubbing.normal_load": "0 N"})
    assert caught.value.key == "frictions.rubbing.normal_load"
    drawn = td.Mechanism("Smooth", friction=HELD, run={"duration": "1 s"})
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=[1, 0, 0])
    with pytest.raises(InputError, match="nothing here has friction") as caught:
        drawn.case()
    assert caught.value.key == "friction.rest"


@pytest.mark.parametrize("moved_on", [2e-7, 3e-6])
def test_derivatives_of_what_sticks_are_those_of_differences(moved_on: float) -> None:
    """Of a ball that is pressed into its socket, after an accepted step, below and beyond the presliding."""
    case = ball().case()
    assert isinstance(case, MechanismCase)
    model = Model(case, clearances_of(case))
    problem = mechanism_problem(assemble(model), duration=1.0, rtol=1e-6, dense=True)
    functions, given, random = problem.functions, (problem.data, problem.memory), np.random.default_rng(1)
    y, n = problem.y0.copy(), problem.y0.size
    y[:3] += 2.05e-5 * np.array([0.1, -1.0, 0.2])
    functions.enter(0.0, y, *given)
    functions.accept(0.0, y, *given)
    y[:3] += moved_on * random.normal(size=3) * [1.0, 0.1, 1.0]
    y[3:7] += 30.0 * moved_on * random.normal(size=4)
    y[7:] = 1e-4 * random.normal(size=6)
    found, f, steps = np.zeros((n, n)), np.zeros(n), np.repeat([1e-11, 1e-8, 1e-9, 1e-7], [3, 4, 3, 3])
    functions.jac(0.0, y, *given, f, found)
    assert problem.memory.contact.strains[0, NORMAL:].any()

    def at(place: FloatArray) -> FloatArray:
        rates = np.zeros(n)
        functions.rhs(0.0, place, *given, rates)
        return rates

    differences = np.array([(at(y + e) - at(y - e)) / (2.0 * e.max()) for e in np.diag(steps)]).T
    scale = np.abs(differences).max(axis=0)
    assert (np.abs(found - differences) / scale).max() < 1e-3


def test_friction_at_rest_takes_few_more_steps() -> None:
    """Balls that slide with a spin, pins and a collar: 1.17 times the steps of the regularised law."""
    case = td.load_case("vsv-joints", {"run.cycles": 0.5})
    steps = [
        json.loads(td.simulate(case.replace({"friction.rest": held})).attrs["solver"])["steps"]
        for held in (True, False)
    ]
    assert steps[0] < 1.3 * steps[1]
