"""Quasi-static and kinematic analyses against closed forms and against dynamic runs."""

import math

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from tests.analytic.mechanism.test_outputs import BAR, CRANK, ROD, closed_form, of, press
from tests.faults.mechanisms.random_mechanisms import flat_loop

import tribodyn as td
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.kernels.actions import Signals, evaluate
from tribodyn.mechanism.analyses.statics import _turned
from tribodyn.mechanisms.results import summarise
from tribodyn.mechanisms.signal_pieces import Pieces, SignalList, backward
from tribodyn.results.reading import column

PIN = {"radius": "9.5 mm", "length": "20 mm", "axial": "50 um", "nodes_around": 96, "nodes_along": 4}
FRICTION = 0.2
TURN = 8  #: Positions of a turn.
SIDE = 0.2e-3  #: Difference of two clearances [m]: roughness, which holds pins apart, is some micrometres.


def static(mechanism: td.Mechanism, **run: object) -> xr.Dataset:
    keys = {"analysis": "static", **run}
    return td.simulate(mechanism.case().replace({f"run.{key}": str(value) for key, value in keys.items()}))


def wrist(radial: str) -> xr.Dataset:
    """Return the equilibria of the press in both directions, by the ideal angle of the crank."""
    drawn = press(radial=radial, friction_coefficient=str(FRICTION), **PIN)
    return static(drawn, directions="both", positions=TURN)


def test_error_of_a_slider_for_one_clearance_in_both_directions() -> None:
    # The rod is a bar between two points: its force touches the friction circle of the wrist. The pin lies
    # where the normal stands at the angle of friction to that force. Two clearances differ by 0.2 mm of it.
    narrow, wide = wrist("0.2 mm"), wrist("0.4 mm")
    angle = of(narrow, "output_ideal", "turn")
    assert angle[TURN] == pytest.approx(2.0 * np.pi)
    assert angle == pytest.approx(angle[::-1], abs=1e-9)
    _, _, lean = closed_form(narrow)
    lean = np.where(np.arange(2 * TURN + 1) > TURN, lean[::-1], lean)
    friction, radius = math.atan(FRICTION), 9.5e-3
    off = friction - math.asin(radius * math.sin(friction) / ROD)
    way, tilt = (
        of(wide, "output_error", name) - of(narrow, "output_error", name) for name in ("way", "lean")
    )
    clear = np.abs(np.cos(angle)) > 0.2  # at the dead centres of the rod's rotation slip changes its sign
    assert way[clear] == pytest.approx((-SIDE * math.cos(off) / np.cos(lean))[clear], rel=0.01)
    # Across the rod the pin stands on one side as the crank turns forward, on the other as it turns back.
    sliding = np.where(np.arange(2 * TURN + 1) > TURN, -1.0, 1.0) * np.sign(np.cos(angle))
    across = -tilt * ROD * np.cos(lean)
    along, expected = SIDE * math.cos(off), SIDE * math.sin(off) * sliding
    height = -along * np.sin(lean) + expected * np.cos(lean)
    assert across[clear] == pytest.approx(height[clear], abs=0.01 * SIDE)


def test_slow_dynamic_runs_pass_through_the_equilibria() -> None:
    drawn = press(radial="20 um", friction_coefficient="0.1", **PIN)
    found, moved = static(drawn, positions=50), td.simulate(drawn)
    times = column(found, "time")
    error = np.interp(times, column(moved, "time"), of(moved, "output_error", "way"))
    # The dynamic run begins at rest in its equilibrium and makes no impacts under this load.
    assert of(found, "output_error", "way") == pytest.approx(error, rel=2e-3)
    numbers = [summarise(result)["force_mean_N_wrist"] for result in (found, moved)]
    assert numbers[0] == pytest.approx(numbers[1], rel=2e-3)
    worn = [summarise(result)["wear_depth_nm_wrist"] for result in (found, moved)]
    assert worn[0] == pytest.approx(worn[1], rel=0.02)


def ideal(**run: object) -> td.Mechanism:
    """Return a slider-crank of ideal joints, not redundant, under all kinds of forces."""
    return (
        td.Mechanism(
            "Ideal",
            gravity="0, -9.81, 0 m/s^2",
            run={"cycles": 1, "output_interval": "2 ms", **run},
            solver={"rtol": 1e-11},
        )
        .body("crank", mass="0.3 kg", centre="10, 5, 0 mm", **BAR)
        .body("rod", mass="0.2 kg", centre="110, 3, 0 mm", **BAR)
        .body("slider", mass="0.14 kg", centre="170, 0, 0 mm", **BAR)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .spherical("crankpin", "crank", "rod", point="50, 0, 0 mm")
        .universal("wrist", "rod", "slider", point="170, 0, 0 mm", axis=[0, 1, 0], second_axis=[0, 0, 1])
        .prismatic("guide", "ground", "slider", point="170, 0, 0 mm", axis=[1, 0, 0])
        .drive("motor", "main", speed="600 rpm")
        .load(
            "push",
            "slider",
            direction=[-1, 0, 0],
            force={"value": "100 N", "amplitude": "50 N", "angular_frequency": "30 rad/s"},
        )
        .spring(
            "return",
            "ground",
            "rod",
            first_point="110, 100, 0 mm",
            second_point="110, 0, 0 mm",
            stiffness="2 N/mm",
        )
        .output("way", "slider", along=[1, 0, 0])
        .output("lean", "rod", quantity="angle", along=[0, 0, 1])
        .output("stroke", "slider", quantity="distance", reference_point="0, 0, 0 mm", point="170, 0, 0 mm")
        .output("speed", "slider", quantity="velocity", along=[1, 0, 0])
    )


def test_inverse_dynamics_equals_a_dynamic_run() -> None:
    known, integrated = (td.simulate(ideal(analysis=name)) for name in ("kinematic", "dynamic"))
    assert column(known, "time") == pytest.approx(column(integrated, "time"))
    for name in ("position", "velocity", "acceleration", "reaction_force_global", "drive_moment"):
        found, expected = column(known, name), column(integrated, name)
        assert np.max(np.abs(found - expected)) < 1e-8 * np.max(np.abs(expected)), name
    assert known.attrs["warnings"] == "[]"


def test_velocity_ratios_are_those_of_the_closed_form() -> None:
    result = td.simulate(ideal(analysis="kinematic"))
    angle = 2.0 * np.pi * 10.0 * column(result, "time")
    lean = -np.arcsin(CRANK * np.sin(angle) / ROD)
    leaning = -CRANK * np.cos(angle) / (ROD * np.cos(lean))
    sliding = -CRANK * np.sin(angle) - ROD * np.sin(lean) * leaning
    ratio = dict(
        zip(result["output"].values.tolist(), column(result, "output_ratio")[:, :, 0].T, strict=True)
    )
    assert ratio["way"] == pytest.approx(sliding, abs=1e-10)
    assert ratio["stroke"] == pytest.approx(sliding, abs=1e-10)
    assert ratio["speed"] == pytest.approx(sliding, abs=1e-10)
    assert ratio["lean"] == pytest.approx(leaning, abs=1e-9)


def test_ratios_are_known_where_a_drive_rests() -> None:
    drawn = (
        td.Mechanism("Swing", run={"cycles": 1, "analysis": "kinematic"})
        .body("arm", mass="1 kg", centre="100, 0, 0 mm", **BAR)
        .revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
        .drive("motor", "hinge", angle={"value": "0 deg", "swing": "30 deg", "angular_frequency": "3 rad/s"})
        .output("tip", "arm", point="200, 0, 0 mm", along=[0, 1, 0])
        .output("turn", "arm", quantity="angle", along=[0, 0, 1])
    )
    result = td.simulate(drawn)
    ratio = column(result, "output_ratio")[:, :, 0]
    angle = of(result, "output_value", "turn")
    assert abs(column(result, "relative_rate")[0, 0, 2]) < 1e-12
    assert ratio[:, 1] == pytest.approx(1.0, abs=1e-12)
    assert ratio[:, 0] == pytest.approx(0.2 * np.cos(angle), abs=1e-12)


def carriage(**more: object) -> td.Mechanism:
    """Return a driven wheel, and beside it a carriage on a rail that a spring of 2 N/mm holds."""
    drawn = (
        td.Mechanism("Carriage", run={"cycles": 1, "positions": 8, "analysis": "static", **more})
        .body("wheel", mass="1 kg", centre="0, 0, 0 mm", **BAR)
        .body("carriage", mass="1 kg", centre="0, 200, 0 mm", **BAR)
        .revolute("axle", "ground", "wheel", point="0, 0, 0 mm", axis=[0, 0, 1])
        .prismatic("rail", "ground", "carriage", point="0, 200, 0 mm", axis=[1, 0, 0])
        .drive("motor", "axle", speed="60 rpm")
        .load("push", "carriage", direction=[1, 0, 0], force="30 N")
        .output("way", "carriage", along=[1, 0, 0])
    )
    points = {"first_point": "-100, 200, 0 mm", "second_point": "0, 200, 0 mm"}
    return drawn.spring("spring", "ground", "carriage", stiffness="2 N/mm", **points)


def test_freedoms_that_springs_hold_find_their_equilibrium() -> None:
    result = td.simulate(carriage())
    assert of(result, "output_value", "way") == pytest.approx(np.full(9, 15e-3), rel=1e-9)
    assert column(result, "velocity")[:, 1] == pytest.approx(0.0, abs=1e-12)


def lever_on_a_spring(*, real: bool, **keys: object) -> td.Mechanism:
    """Return a base driven along x, and on it a lever of 0.8 kg on a torsion spring."""
    drawn = (
        td.Mechanism(
            "Lever",
            gravity="0, -9.81, 0 m/s^2",
            run={"analysis": "static", "duration": "1 s", "positions": 8},
        )
        .body("base", mass="1 kg", centre="0, 0, 0 mm", **BAR)
        .body("lever", mass="0.8 kg", centre="200, 20, 0 mm", inertia="8e-3, 8e-3, 1e-2 kg m^2")
        .prismatic("rail", "ground", "base", point="0, 0, 0 mm", axis=[1, 0, 0])
        .revolute("pivot", "base", "lever", point="0, 0, 0 mm", axis=[0, 0, 1])
        .torsion_spring("coil", joint="pivot", **keys)
        .drive("motor", "rail", velocity="0.1 m/s")
        .output("turn", "lever", quantity="angle", along=[0, 0, 1])
    )
    pin = {"radius": "10 mm", "length": "20 mm", "axial": "50 um", "friction_coefficient": "0"}
    return drawn.clearance("pivot", radial="20 um", **pin) if real else drawn


def moment_of_weight(angle: float) -> float:
    return -0.8 * 9.81 * (0.2 * math.cos(angle) - 0.02 * math.sin(angle))


@pytest.mark.parametrize("real", [False, True])
def test_a_lever_hangs_where_its_spring_balances_its_weight(real: bool) -> None:
    result = td.simulate(lever_on_a_spring(real=real, stiffness="2 N m/rad"))
    exact = brentq(lambda a: moment_of_weight(a) - 2.0 * a, -2.0, 1.0)
    assert math.degrees(exact) == pytest.approx(-38.1419, abs=1e-4)
    assert of(result, "output_value", "turn") == pytest.approx(exact, abs=1e-8)
    assert np.max(np.abs(column(result, "drive_force"))) < 1e-5
    assert "balance to" in result.attrs["notes"]


def test_a_lever_hangs_there_too_where_friction_of_its_rail_is_to_hold_at_rest() -> None:
    """Its way to there is some ten thousand times what friction yields."""
    drawn = lever_on_a_spring(real=False, stiffness="2 N m/rad").friction(
        "rub", joint="rail", normal_load="1 N"
    )
    result = td.simulate(drawn.case().replace({"friction.rest": True}))
    assert result.attrs["failure"] == ""
    exact = brentq(lambda a: moment_of_weight(a) - 2.0 * a, -2.0, 1.0)
    assert of(result, "output_value", "turn") == pytest.approx(exact, abs=1e-8)


def test_a_cubic_spring_without_stiffness_at_its_start_holds_a_lever() -> None:
    angles = np.linspace(-3.0, 3.0, 601)
    torque = {
        "angles": [f"{a} rad" for a in angles.tolist()],
        "values": [f"{2.0 * a**3} N m" for a in angles.tolist()],
    }
    result = td.simulate(lever_on_a_spring(real=False, torque=torque))
    exact = brentq(lambda a: moment_of_weight(a) - 2.0 * a**3, -2.0, 1.0)
    assert result.attrs["failure"] == ""
    assert of(result, "output_value", "turn") == pytest.approx(exact, abs=1e-6)


def test_an_overloaded_joint_has_no_equilibrium() -> None:
    drawn = (
        press(radial="20 um", **PIN)
        .case()
        .replace({"loads.push.force.value": "1e7 N", "run.analysis": "static"})
    )
    rigid = td.simulate(drawn.replace({"joints.wrist.clearance.bulk": "none"})).attrs["failure"]
    assert "with drive motor at 0°, no static equilibrium was found" in rigid
    assert "the surfaces of joint wrist come closer than the contact law reaches" in rigid
    assert "the loads move the shaft of joint wrist out of its bore" in td.simulate(drawn).attrs["failure"]


def test_bodies_carry_where_asperities_end() -> None:
    smooth = {f"surfaces.{body}.roughness": "0.05 um" for body in ("trunnion", "bushing")}
    loaded = {"loads.push.force.value": "1e4 N", "run.analysis": "static", "run.positions": "8"}
    drawn = press(radial="20 um", **PIN).case().replace(loaded | smooth)
    key = "joints.wrist.clearance.bulk"
    assert "closer than the contact law" in td.simulate(drawn.replace({key: "none"})).attrs["failure"]
    found = td.simulate(drawn)
    assert not found.attrs["failure"]
    assert 'bulk = \\"none\\"' in found.attrs["notes"]
    assert found.attrs["rows_sha256"] == td.simulate(drawn.replace({key: "conformal"})).attrs["rows_sha256"]


def lever(height: str) -> td.Mechanism:
    """Return a lever on one bearing of 20 mm, pushed at a height above its middle."""
    return (
        td.Mechanism("Lever", run={"cycles": 1, "output_interval": "50 ms", "positions": 20})
        .body("lever", mass="1 g", centre="0, 0, 0 mm", inertia="1e-9, 1e-9, 1e-9 kg m^2")
        .revolute("pivot", "ground", "lever", point="0, 0, 0 mm", axis=[0, 0, 1])
        .clearance("pivot", radial="20 um", friction_coefficient=str(FRICTION), **PIN)
        .drive("motor", "pivot", speed="60 rpm")
        .load("push", "lever", direction=[1, 0, 0], point=f"0, 0, {height}", force="100 N")
        .output("top", "lever", point="0, 0, 100 mm", along=[1, 0, 0])
        .output("side", "lever", point="0, 0, 0 mm", along=[0, 1, 0])
    )


def test_damping_of_impacts_has_no_part_in_equilibria() -> None:
    # Both pins of the coupler are tilted and turn: with damping their forces jumped, and nothing balanced.
    drawn = flat_loop(np.random.default_rng(9)).case()
    changes = {"run.analysis": "static", "run.positions": "2"}
    assert td.simulate(drawn.replace(changes)).attrs["failure"] == ""


def test_a_seesaw_without_a_drive_rests_where_springs_and_loads_balance() -> None:
    # It lies lower by the offset of its pivot, and turns as far as in ideal joints.
    drawn = td.Mechanism("Seesaw", run={"duration": "1 s", "positions": 2})
    drawn.body("board", mass="20 kg", centre="0, 0, 0 mm", inertia="1, 5, 5 kg m^2")
    drawn.revolute("pivot", "ground", "board", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.clearance("pivot", radius="10 mm", radial="20 um", length="30 mm", friction_coefficient=0.1)
    for name, x in (("left", -1000), ("right", 1000)):
        ends = {"first_point": f"{x}, -300, 0 mm", "second_point": f"{x}, 0, 0 mm"}
        drawn.spring(name, "ground", "board", **ends, stiffness="2000 N/m", length="300 mm")
    drawn.load("child", "board", point="800, 0, 0 mm", direction=[0, -1, 0], force="250 N")
    drawn.output("tip", "board", point="1000, 0, 0 mm", along=[0, 1, 0])
    drawn.output("turn", "board", quantity="angle", along=[0, 0, 1])

    def moment(angle: float) -> float:
        total = -250.0 * 0.8 * math.cos(angle)
        for x in (-1.0, 1.0):
            end = x * np.array([math.cos(angle), math.sin(angle)])
            way = end - [x, -0.3]
            pull = -2000.0 * (1.0 - 0.3 / np.hypot(*way)) * way
            total += end[0] * pull[1] - end[1] * pull[0]
        return total

    exact = brentq(moment, -0.2, 0.0)
    result = static(drawn)
    lowered = float(result["position"].sel(body="board")[-1, 1])
    assert -20e-6 < lowered < -14e-6
    assert of(result, "output_ideal", "turn")[-1] == pytest.approx(exact, abs=1e-9)
    assert of(result, "output_value", "tip")[-1] == pytest.approx(math.sin(exact) + lowered, abs=2e-8)
    assert of(result, "output_error", "tip")[-1] == pytest.approx(lowered, abs=2e-8)
    assert "friction, which could hold them beside that position, is left out" in result.attrs["notes"]
    assert "the error of output tip is that against rest in ideal joints" in result.attrs["notes"]


@pytest.mark.parametrize("load", [50.0, -50.0])
def test_a_nut_with_backlash_rests_on_the_flank_that_its_load_presses(load: float) -> None:
    # Half of the play and the flattening F/K, in the static analysis and at the end of a damped run.
    drawn = td.Mechanism("Press", run={"duration": "0.2 s", "positions": 4})
    drawn.body("screw", mass="1 kg", centre="0, 0, 50 mm", inertia="1e-3, 1e-3, 2e-4 kg m^2")
    drawn.body("nut", mass="2 kg", centre="0, 0, 30 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("bearing", "ground", "screw", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.prismatic("guide", "ground", "nut", point="40, 0, 30 mm", axis=[0, 0, 1])
    drawn.screw(
        "thread", joints=["bearing", "guide"], lead="5 mm", backlash="0.1 mm", stiffness="10 N/um"
    ).drive("motor", "bearing", speed="60 rpm")
    drawn.load("cut", "nut", direction=[0, 0, 1], force=f"{load} N")
    drawn.output("position", "nut", point="0, 0, 30 mm", along=[0, 0, 1])
    expected = math.copysign(0.05e-3 + abs(load) / 1e7, load)
    for result in (static(drawn), td.simulate(drawn)):
        assert of(result, "output_error", "position")[-1] == pytest.approx(expected, rel=1e-5)
        assert float(result["element_force"][-1, 0]) == pytest.approx(-load, rel=1e-5)
    exact = td.simulate(drawn.case().replace({"screws.thread.ideal": True, "run.analysis": "static"}))
    assert of(exact, "output_error", "position")[-1] == pytest.approx(0.0, abs=1e-12)


def test_a_mechanism_without_a_prescribed_motion_has_no_kinematics() -> None:
    pendulum = (
        td.Mechanism("Pendulum", run={"duration": "20 ms", "analysis": "kinematic"})
        .body("arm", mass="1 kg", centre="100, 0, 0 mm", **BAR)
        .revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
        .drive("motor", "hinge", torque="1 N m")
    )
    with pytest.raises(InputError, match="no drive prescribes a motion"):
        td.simulate(pendulum)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"run.directions": "both"}, "only a static analysis"),
        ({"run.analysis": "static", "wear.cycles": "10"}, "choose dynamic"),
    ],
)
def test_what_an_analysis_does_not_do_is_refused(changes: dict[str, str], said: str) -> None:
    with pytest.raises(TribodynError, match=said):
        td.load_case("slider-crank", changes)


def test_an_oil_film_has_no_static_equilibrium() -> None:
    oiled = press(radius="9.5 mm", radial="20 um", length="20 mm").case()
    case = oiled.replace({"joints.wrist.film.viscosity": "0.01 Pa s", "run.analysis": "static"})
    with pytest.raises(TribodynError, match="carries by motion alone"):
        td.simulate(case)


def signals() -> Signals:
    """Return a sine beside a polynomial, a table, and a table that repeats."""
    chance = np.random.default_rng(1)
    found = SignalList()
    one = np.array([np.inf])
    found.add(Pieces(one, np.zeros(1), chance.normal(size=(1, 5)), (0.7, 3.0, 0.4)))
    until, left = np.array([0.0, 0.5, np.inf]), np.array([0.0, 0.0, 0.5])
    found.add(Pieces(until, left, chance.normal(size=(3, 5)), (0.0, 0.0, 0.0)), np.array([0.0, 0.5]))
    until, left = np.array([0.4, np.inf]), np.array([0.1, 0.4])
    found.add(Pieces(until, left, chance.normal(size=(2, 5)), (0.0, 0.0, 0.0), period=0.9))
    return found.records()


def test_backward_signals_have_the_values_of_the_opposite_time() -> None:
    forward = signals()
    reverse = backward(forward, [0, 1, 2])
    assert reverse.kinks == pytest.approx([-0.5, 0.0])
    for number in range(3):
        for x in np.random.default_rng(2).uniform(0.01, 3.0, 50):
            value, rate, second = evaluate(forward, number, x, x)
            assert evaluate(reverse, number, -x, -x) == pytest.approx(
                (value, -rate, second), rel=1e-9, abs=1e-9
            )
    kept = backward(forward, [1])
    assert evaluate(kept, 0, 0.3, 0.3) == evaluate(forward, 0, 0.3, 0.3)


def test_superposition_shows_tilt_and_friction() -> None:
    # Pushed 50 mm beside the middle the shaft lies on both ends of its bearing, tilted by twice the clearance
    # over the length. Pushed in the middle it lies straight, at the angle of friction.
    straight, tilted = (
        column(static(lever(height), analysis="kinematic"), "error_estimate")[:, :, 0]
        for height in ("0 mm", "50 mm")
    )
    angle = math.atan(FRICTION)
    assert straight[:, 0, 0] == pytest.approx(20e-6, rel=1e-3)
    assert straight[:, 0, 1] == pytest.approx(0.0, abs=1e-10)
    assert straight[:, 0, 2] == pytest.approx(20e-6 * (math.cos(angle) - 1.0), rel=1e-3)
    assert np.abs(straight[:, 1, 2]) == pytest.approx(20e-6 * math.sin(angle), rel=1e-3)
    assert tilted[:, 0, 1] == pytest.approx(100e-3 * 2.0 * 20e-6 / 20e-3, rel=2e-2)


def test_shafts_whose_force_passes_through_zero_change_sides() -> None:
    # The ring guide of the vane mechanism alone: at 17.9° its load vanishes, and it lies anywhere between.
    case = td.load_case("vsv-joints", {"run.analysis": "static", "run.positions": "20"})
    ideal = {f"joints.{name}.clearance.ideal": "true" for name in case.joints if name != "guide"}
    result = td.simulate(case.replace(ideal))
    assert result.attrs["failure"] == ""
    assert summarise(result)["error_rms_deg_vane"] > 0.03


def test_an_arm_rests_on_its_stop_as_far_in_as_its_weight_presses_it() -> None:
    """Torque m g l cos θ over the stiffness of the stop; the pivot has a clearance."""
    run = {"duration": "0.1 s", "output_interval": "50 ms", "analysis": "static"}
    drawn = td.Mechanism("Arm on a stop", gravity="0, -9.81 m/s^2, 0", run=run)
    drawn.body("arm", mass="2 kg", centre="100, 0, 0 mm", inertia="1e-2, 1e-2, 1e-2 kg m^2")
    drawn.revolute("pivot", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.clearance("pivot", radius="5 mm", radial="20 um", length="20 mm", friction_coefficient=0.0)
    drawn.stop("seat", "pivot", angle="-0.1 deg", side="below", angular_stiffness="1000 N m/rad")
    result = td.simulate(drawn)
    angle = result["joint_angle"].values[-1, 0]
    assert angle == pytest.approx(-np.radians(0.1) - 2.0 * 9.81 * 0.1 * np.cos(angle) / 1000.0, rel=1e-8)


def test_a_shaft_walks_along_its_bore_where_hysteresis_is_asked_for() -> None:
    """Friction points against the whole slip: dz = R dθ F/√((μN)² − F²) for a force F along the axis."""
    run = {"analysis": "static", "duration": "2 s", "positions": 41}
    drawn = td.Mechanism("Walk", friction={"rest": True}, run=run)
    drawn.body("shaft", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    drawn.revolute("pivot", "ground", "shaft", point="0, 0, 0 mm", axis=[0, 0, 1])
    sizes = {"radius": "10 mm", "radial": "20 um", "length": "20 mm", "axial": "1 mm"}
    drawn.clearance("pivot", **sizes, friction_coefficient=0.1, nodes_around=48, nodes_along=4)
    drawn.drive("motor", "pivot", speed="1e-2 rad/s")
    where = {"body": "shaft", "point": "0, 0, 0 mm"}
    drawn.load("across", **where, direction=[0, -1, 0], force="100 N")
    table = {"times": "0, 0.2, 0.21, 5 s", "values": "-5, -5, 5, 5 N", "interpolation": "linear"}
    drawn.load("along", **where, direction=[0, 0, 1], force=table)
    case = drawn.case()
    found = td.simulate(case)
    late = found["time"].values > 0.5
    rise = np.diff(found["position"].values[late, 0, 2]) / np.diff(1e-2 * found["time"].values[late])
    # Around an arc the pressure sums to some 1 % more than the load.
    np.testing.assert_allclose(rise, 0.01 * 5.0 / math.sqrt(75.0), rtol=0.02)
    pushed = found["reaction_force_global"].values[late].reshape(-1, 3)[:, 2]
    np.testing.assert_allclose(pushed, -5.0, rtol=1e-4)
    jumped = td.simulate(case.replace({"friction.rest": False}))["position"].values[late, 0, 2]
    assert np.ptp(jumped) < 1e-7


def test_a_body_that_nothing_holds_has_no_equilibrium() -> None:
    result = td.simulate(carriage().case().replace({"springs.spring.stiffness": "0 N/mm"}))
    assert "no static equilibrium: body carriage" in result.attrs["failure"]
    assert result.sizes["time"] == 0


def test_superposition_has_no_errors_of_velocities() -> None:
    # It displaces bodies; what that is for a velocity is the displacement, in another unit.
    drawn = press(radius="9.5 mm", radial="20 um", length="20 mm", axial="50 um")
    result = td.simulate(drawn.case().replace({"run.analysis": "kinematic"}))
    for output, known in (("speed", False), ("rate", False), ("way", True), ("lean", True)):
        place = result["output"].values.tolist().index(output)
        estimate = column(result, "error_estimate")[:, place, result["joint"].values.tolist().index("wrist")]
        assert np.isfinite(estimate).all() == known, output


def test_a_tilted_shaft_that_tilts_on_spins_by_half_of_it() -> None:
    """Rates of rotations become angular velocities as those of finite rotations do, by differences."""
    chance, h = np.random.default_rng(7), 1e-6
    ways, rates = chance.normal(size=(20, 3)), chance.normal(size=(20, 3))
    ways *= 0.3 / np.linalg.norm(ways, axis=1, keepdims=True)

    def turned(half: np.ndarray) -> Rotation:
        return Rotation.from_quat(np.hstack([half, np.sqrt(1.0 - np.sum(half**2, axis=1, keepdims=True))]))

    before, after = (turned(0.5 * (ways + side * h * rates)) for side in (-1.0, 1.0))
    expected = (before.inv() * after).as_rotvec() / (2.0 * h)
    assert np.allclose(_turned(ways, rates), expected, rtol=0.0, atol=1e-8)
    assert np.max(np.abs(rates - expected)) > 0.05
