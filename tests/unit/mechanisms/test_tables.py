"""Tables that a run leaves, and tables over a whole turn, in every model."""

from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cases.case import Case, with_entries
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanisms.results import summarise
from tribodyn.simulation import check


def rotor(*, turns: float = 2.0, **load: Any) -> Case:
    """Return a disc that turns at 100 revolutions per second under a moment about its axis."""
    drawn = Mechanism("Rotor", run={"duration": f"{10.0 * turns} ms", "period": "10 ms"})
    drawn.body("disc", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("shaft", "ground", "disc", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.drive("motor", "shaft", speed="6000 rpm")
    return drawn.load("gas", "disc", direction=[0, 0, 1], **load).case()


def warned(case: Case) -> list[str]:
    """Return the warnings of a run that are about tables."""
    return [text for text in summarise(td.simulate(case))["warnings"] if "leaves the table" in text]


@pytest.mark.parametrize(
    ("angles", "period"), [("0, 90, 180, 270, 360 deg", 1), ("-360, -180, 0, 180, 360 deg", 2)]
)
def test_a_table_over_whole_turns_of_a_joint_repeats(angles: str, period: int) -> None:
    values = "1, 3, 2, 0, 1 N m"
    case = rotor(turns=5, along="shaft", moment={"angles": angles, "values": values})
    result = td.simulate(case)
    assert not warned(case)
    (note,) = [text for text in check(case) if "repeats" in text]
    assert "loads.gas.moment" in note
    assert f"{360 * period} deg" in note
    assert note in summarise(result)["notes"]
    # The drive balances the load: by spline the same curve in every period, of the value at the knots.
    t, moment = result["time"].values, -result["drive_moment"].values[:, 0]
    knots = np.interp(1e-2 * np.array([0.25, 2.25, 4.25]), t, moment)
    if period == 1:
        np.testing.assert_allclose(knots, 3.0, atol=1e-3)
    one = t <= 1e-2 * period * (1.0 + 1e-9)
    later = np.interp(t[one] + 2e-2, t, moment)
    np.testing.assert_allclose(later, moment[one], atol=5e-3)
    assert np.ptp(moment[one]) > 2.0


def test_a_repeated_table_goes_on_smoothly_where_it_can_and_says_where_it_jumps() -> None:
    smooth = {"angles": "0, 90, 180, 270, 360 deg", "values": "1, 3, 2, 0, 1 N m"}
    result = td.simulate(rotor(along="shaft", moment=smooth))
    t, moment = result["time"].values, -result["drive_moment"].values[:, 0]
    near = (t > 0.0099) & (t < 0.0101)
    slope = np.gradient(moment[near], t[near])
    # One slope on both sides of the joint, to a few per cent over a hundredth of a turn.
    assert np.ptp(slope) < 0.1 * abs(slope.mean())
    (note,) = [
        text
        for text in check(rotor(along="shaft", moment={**smooth, "values": "1, 3, 2, 0, 4 N m"}))
        if "repeats" in text
    ]
    assert "jumps from 4 N m to 1 N m" in note


@pytest.mark.parametrize(
    ("load", "key", "time"),
    [
        (
            {"along": "shaft", "moment": {"angles": "0, 90, 350 deg", "values": "1, 3, 1 N m"}},
            "loads.gas.moment.angles",
            350.0 / 360.0 * 10e-3,
        ),
        ({"moment": {"times": "0, 1, 3 ms", "values": "1, 3, 1 N m"}}, "loads.gas.moment.times", 3e-3),
        ({"moment": {"times": "1, 2, 30 ms", "values": "1, 3, 1 N m"}}, "loads.gas.moment.times", 0.0),
    ],
)
def test_a_run_that_leaves_a_table_warns_with_the_time(load: dict[str, Any], key: str, time: float) -> None:
    (text,) = warned(rotor(**load))
    assert key in text
    said = float(text.partition("t = ")[2].partition(" s")[0])
    # Rows are 20 us apart.
    assert said == pytest.approx(time, abs=25e-6)


def test_a_drive_that_leaves_its_table_is_said_too() -> None:
    drawn = rotor(moment="1 N m")
    speed = {"drives.motor.speed.times": "0, 1, 5 ms", "drives.motor.speed.values": "100, 100, 90 rad/s"}
    (text,) = warned(drawn.replace(speed))
    assert "drives.motor.speed.times" in text
    assert "t = 0.005 s" in text


def test_a_load_over_one_cycle_repeats_with_it_as_that_of_the_vane_does() -> None:
    case = rotor(turns=3, moment={"times": "0, 2.5, 5, 7.5, 10 ms", "values": "1, 3, 2, 0, 1 N m"})
    assert not warned(case)
    assert any("loads.gas.moment repeats" in text for text in check(case))
    result = td.simulate(case)
    moment = np.interp([2.5e-3, 12.5e-3, 22.5e-3], result["time"], -result["drive_moment"][:, 0])
    np.testing.assert_allclose(moment, 3.0, atol=1e-3)


def test_the_vane_mechanism_says_that_it_leaves_its_tables() -> None:
    vane = td.load_case("vsv").replace({"run.duration": "4 ms", "run.output_interval": "1 ms"})
    load = "loads.more.gas.force_y"
    over_time = {f"{load}.times": "0, 2 ms", f"{load}.values": "0, 4 N"}
    over_angle = {f"{load}.angles": "0, 30 deg", f"{load}.values": "0, 4 N"}
    warm = {
        "temperature.over_time.bushing.times": "0, 2 ms",
        "temperature.over_time.bushing.values": "20, 21 degC",
        "surfaces.bushing.thermal_expansion": "50e-6 1/K",
    }
    for changes, key, time in (
        (over_time, f"{load}.times", "0.002"),
        (over_angle, f"{load}.angles", "0"),
        (warm, "temperature.over_time.bushing.times", "0.002"),
    ):
        (text,) = warned(with_entries(vane, changes, "test"))
        assert f"{key} (" in text
        assert f"t = {time} s" in text
