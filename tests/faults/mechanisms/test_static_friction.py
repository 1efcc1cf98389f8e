"""Static analysis has friction of the same size at any speed of the drive, and of both signs.

Slider-cranks of random size slide in three joints under stated loads. By virtual work the torque of the crank
turning forward is above that turning back by twice the sum of friction forces times sliding distances.
"""

import json
import math

import numpy as np
import pytest

import tribodyn as td
from benchmarks.__main__ import TARGET
from benchmarks.mechanisms import static_loops
from benchmarks.mechanisms.static_loops import SAME, STATIC, swinging
from benchmarks.mechanisms.static_machines import one
from tribodyn.mechanism.analyses import statics
from tribodyn.mechanism.analyses.led_loads import LedLoads
from tribodyn.mechanism.analyses.statics import _snaps
from tribodyn.mechanism.assembly import start
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column

MANY = 200
#: Seeds whose loops agree as the manual has it, and the parts that they are looked at in.
MEANS = json.loads(TARGET.read_text(encoding="utf-8"))["static_loops"]["means"]
AGREE = tuple(int(seed) for seed, mean in MEANS.items() if mean < SAME)
PARTS = 14
FIRST = {"run.duration": "31.4 ms", "run.output_interval": "31.4 ms", "run.positions": 2}


def missed(seed: int) -> float:
    """Return the error of the hysteresis of the torque over its size, at most."""
    draw = np.random.default_rng(seed)
    crank, rod = float(draw.uniform(20.0, 60.0)), float(draw.uniform(150.0, 300.0))
    speed = 10.0 ** draw.uniform(-5.0, 1.0)
    loads, frictions = draw.uniform(5.0, 500.0, 3), draw.uniform(0.02, 0.4, 3)
    radii = draw.uniform(3.0, 20.0, 2)
    bar = {"inertia": "1e-4, 1e-4, 1e-4 kg m^2"}
    run = {"analysis": "static", "directions": "both", "cycles": 1, "positions": 16}
    drawn = (
        td.Mechanism("Press", run=run)
        .body("crank", mass="0.1 kg", centre="0, 0, 0 mm", **bar)
        .body("rod", mass="0.1 kg", centre=f"{crank + 0.5 * rod}, 0, 0 mm", **bar)
        .body("slider", mass="0.1 kg", centre=f"{crank + rod}, 0, 0 mm", **bar)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("pin", "crank", "rod", point=f"{crank}, 0, 0 mm", axis=[0, 0, 1])
        .spherical("wrist", "rod", "slider", point=f"{crank + rod}, 0, 0 mm")
        .prismatic("guide", "ground", "slider", point=f"{crank + rod}, 0, 0 mm", axis=[1, 0, 0])
        .drive("motor", "main", speed=f"{speed} rad/s")
        .load("push", "slider", direction=[-1, 0, 0], force="100 N")
    )
    for joint, load, friction, radius in zip(
        ("main", "pin", "guide"), loads, frictions, (*radii, None), strict=True
    ):
        keys = {} if radius is None else {"radius": f"{radius} mm"}
        drawn.friction(
            f"rub_{joint}",
            joint=joint,
            normal_load=f"{load} N",
            friction_coefficient=float(friction),
            stribeck_velocity="1 m/s",
            **keys,
        )
    result = td.simulate(drawn)
    assert result.attrs["failure"] == ""
    torque = column(result, "drive_moment")[:, 0]
    angle = speed * column(result, "time")[: torque.size // 2 + 1]
    lean = np.arcsin(crank / rod * np.sin(angle))
    leaning = crank * np.cos(angle) / (rod * np.cos(lean))
    sliding = crank * np.sin(angle) + rod * np.sin(lean) * leaning
    lost = frictions * loads
    expected = lost[0] * radii[0] + lost[1] * radii[1] * np.abs(1.0 + leaning) + lost[2] * np.abs(sliding)
    found = torque[: angle.size] - torque[::-1][: angle.size]
    clear = (
        np.arange(angle.size) % 8 != 0
    )  # at the dead centres of the slider, and where the drive turns back
    return float(np.max(np.abs(found - 2e-3 * expected)[clear]) / np.max(2e-3 * expected))


@pytest.mark.parametrize(
    "seeds",
    [pytest.param(range(0, MANY, 20), id="few"), pytest.param(range(MANY), id="all", marks=pytest.mark.long)],
)
def test_hysteresis_of_the_torque_is_that_of_virtual_work_at_any_speed(seeds: range) -> None:
    found = {seed: missed(seed) for seed in seeds}
    assert max(found.values()) < 1e-5, found


def test_the_speed_of_the_drive_has_no_part_in_friction_of_clearances() -> None:
    found = []
    for speed in ("1 rad/s", "1e-3 rad/s"):
        drawn = td.load_case("four-bar", {"run.analysis": "static", "run.directions": "both"})
        real = [name for name, joint in drawn.joints.items() if joint.clearance is not None]
        changes = {f"joints.{name}.clearance.friction_coefficient": "0.2" for name in real}
        drive = next(iter(drawn.drives))
        result = td.simulate(drawn.replace({**changes, f"drives.{drive}.speed": speed, "run.positions": "9"}))
        torque = np.nan_to_num(column(result, "drive_moment")).sum(axis=1)
        found.append((torque - torque[::-1])[1 : torque.size // 2])
    assert np.max(np.abs(found[0])) > 1e-3
    assert found[1] == pytest.approx(found[0], abs=0.05 * np.max(np.abs(found[0])))


@pytest.mark.parametrize(("speed", "noted"), [("0.01 rad/s", True), ("10 rad/s", False)])
def test_a_dynamic_run_says_where_its_friction_is_not_developed(speed: str, noted: bool) -> None:
    drawn = (
        td.Mechanism("Wheel", run={"duration": "0.1 s"})
        .body("wheel", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        .revolute("axle", "ground", "wheel", point="0, 0, 0 mm", axis=[0, 0, 1])
        .drive("motor", "axle", speed=speed)
        .friction("rub", joint="axle", normal_load="10 N", radius="10 mm")
    )
    assert (
        "% of the sliding in joint axle is below five slip velocities" in td.simulate(drawn).attrs["notes"]
    ) == noted


@pytest.mark.parametrize(
    "seeds",
    [
        (20,),
        *(
            pytest.param(AGREE[part::PARTS], marks=pytest.mark.long(minutes=1.5), id=f"part {part}")
            for part in range(PARTS)
        ),
    ],
)
def test_loops_of_random_mechanisms_are_those_of_slow_runs_with_friction_at_rest(monkeypatch, seeds):
    """Also while shafts walk from one end of their bores to the other, and where they stop after a snap.

    A shaft that tilts on spins by half its tilt times the rate, and one that stops has no rate that points
    back. The seeds are all of the table in the manual that agree.
    """
    monkeypatch.setattr(static_loops, "SLOW", 300.0)
    for seed in seeds:
        ended, far = static_loops.loop(seed)
        assert ended == "complete", seed
        assert np.mean(far) < SAME, seed


def test_friction_balances_a_weight_along_a_freedom_that_nothing_else_holds() -> None:
    """A coupler slides in two bores: beside its weight what one pushes along them the other one holds."""
    begins = {"run.duration": "235.6 ms", "run.output_interval": "23.56 ms", "run.positions": 10}
    result = td.simulate(swinging(26).replace({**STATIC, **begins}))
    assert result.attrs["failure"] == ""
    one, other = (result["reaction_force"].sel(joint=f"joint-{k}").values for k in (1, 2))
    weight = 0.130058 * np.dot((5.2328, -6.25084, 5.45719), (-0.1619959, -0.1540901, 0.9746864))
    # Axes of the bores lean by some 0.01 rad.
    assert np.median(other[2:, 2] - one[2:, 2]) == pytest.approx(weight, rel=0.05)


@pytest.mark.long(minutes=2.5)
def test_the_loop_of_a_coupler_that_friction_alone_holds_is_that_of_slow_runs(monkeypatch) -> None:
    monkeypatch.setattr(static_loops, "SLOW", 300.0)
    ended, far = static_loops.loop(26)
    assert ended == "complete"
    assert np.mean(far) < SAME


@pytest.mark.parametrize(
    "seed", [13, 75, 10, 26, 57, *(pytest.param(seed, marks=pytest.mark.long) for seed in (0, 17, 79))]
)
def test_first_positions_are_found_with_all_pins_in_their_bores(seed: int) -> None:
    """Freedoms turn with the bodies: of press fits, a ten-thousandth of a turn aside is thousands of loads.

    What slides freely went metres; shafts that walk from a place without friction begin to slip nowhere.
    """
    result = td.simulate(swinging(seed).replace({**STATIC, **FIRST}))
    assert result.attrs["failure"] == ""
    assert result.sizes["time"] == 3
    unbalance = next(float(note.split()[6]) for note in summarise(result)["notes"] if "forces on all" in note)
    assert unbalance <= 1e-6
    for name, joint in swinging(seed).joints.items():
        if joint.clearance is not None:
            at = list(result.joint.values).index(name)
            x, y, z = column(result, "displacement")[:, at].T
            if joint.type == "cylindrical":  # in the middle of the bore
                x = x - z * column(result, "tilt_y")[:, at]
                y = y + z * column(result, "tilt_x")[:, at]
            off = np.hypot(x, y)
            assert np.max(off) < 2.0 * joint.clearance.radial, name


@pytest.mark.parametrize("seed", [91, 112])
def test_rounding_of_loads_is_no_spring_that_moves_bodies(seed: int) -> None:
    """Velocities along freedoms that it held were of 1e14 m/s, and shafts left their bores."""
    assert not swinging(seed).springs
    assert one(seed)[0] == "complete"


@pytest.mark.long
def test_shafts_walk_where_friction_along_the_ideal_motion_leaves_no_equilibrium() -> None:
    result = td.simulate(swinging(0).replace({"run.analysis": "static", **FIRST}))
    assert result.attrs["failure"] == ""
    assert "at 1 positions and after them shafts walk as with friction.rest" in result.attrs["notes"]


def test_a_search_without_an_end_says_which_body_is_off_balance(monkeypatch) -> None:
    monkeypatch.setattr(statics, "settled", lambda loads, **keys: loads.look())
    result = td.simulate(swinging(13).replace({**STATIC, **FIRST}))
    for words in ("did not converge: loads on body coupler do not balance", "more positions", "dynamic run"):
        assert words in result.attrs["failure"]
    monkeypatch.setattr(statics.Linearised, "balanced", lambda *place: None)
    failure = td.simulate(swinging(13).replace({**STATIC, **FIRST})).attrs["failure"]
    assert "with ideal joints, too, no position at rest was found" in failure


def test_a_snap_is_ten_times_as_far_as_before_and_a_tenth_of_the_widest_clearance() -> None:
    rests, wide = np.zeros((2, 6)), 1e-4
    for far, steps, snaps in ((2e-5, 30.0, True), (2e-5, 8.0, False), (0.5e-5, 30.0, False)):
        before, way = (np.array([[0.0] * 6, [0.0, x, 0.0, 9.0, 9.0, 9.0]]) for x in (far / steps, far))
        assert _snaps([rests, before, before + way], wide) == snaps


@pytest.mark.long(minutes=1.7)
def test_a_note_says_where_a_shaft_snaps_and_inertia_decides_where_it_ends() -> None:
    assert static_loops.loop(11)[0].startswith("inertia decides")
    result = td.simulate(swinging(11).replace(STATIC))
    assert "at 1 positions a shaft snaps to another place" in result.attrs["notes"]


@pytest.mark.parametrize("sharpest", [50.0, 500.0])
def test_a_note_says_where_friction_of_shafts_that_walk_turns_less_sharply(monkeypatch, sharpest) -> None:
    """Where searches do not end with the sharpest friction, neither at once nor from less sharp ones."""
    newton = start._newton

    def dull(loads: LedLoads, *keys: float) -> tuple[int, float, float]:
        steps, moved, soft = newton(loads, *keys)
        slips = loads.data.contact.surfaces["slip_velocity"] / loads._slips_given
        return steps, moved if np.min(slips) > sharpest or not loads.blurs else math.inf, soft

    monkeypatch.setattr(start, "_newton", dull)
    changes = {"run.analysis": "static", "run.directions": "both", "run.positions": "4"}
    case = td.load_case("four-bar", changes)
    real = [name for name, joint in case.joints.items() if joint.clearance is not None]
    result = td.simulate(
        case.replace({f"joints.{name}.clearance.friction_coefficient": "0.2" for name in real})
    )
    assert result.attrs["failure"] == ""
    told = [note for note in summarise(result)["notes"] if "turns less sharply" in note]
    assert told == [
        "at 8 positions shafts that walk balance with friction that turns less sharply than elsewhere"
    ]
