"""Reversals of drives against their closed forms, and the largest values after them."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanism.model.drives_and_loads import DriveKeys
from tribodyn.mechanism.model.reversals import Reversals
from tribodyn.mechanisms.results import of_rows, write_run


def drive(**signal: dict[str, Any]) -> DriveKeys:
    return DriveKeys.model_validate({"joint": "main", **signal})


def times(one: DriveKeys, duration: float, period: float = 1.0) -> list[float]:
    return Reversals((one,), period, duration).times.tolist()


def test_sinusoids_reverse_where_their_rate_is_zero() -> None:
    swing = drive(angle={"swing": 0.7, "angular_frequency": 2.0})
    assert times(swing, 5.0) == pytest.approx([math.pi / 2, math.pi, 3 * math.pi / 2], rel=1e-12)
    wave = drive(angle={"amplitude": 0.7, "angular_frequency": 2.0, "phase": 0.3})
    expected = [(math.pi / 2 - 0.3) / 2, (3 * math.pi / 2 - 0.3) / 2, (5 * math.pi / 2 - 0.3) / 2]
    assert times(wave, 4.0) == pytest.approx(expected, rel=1e-12)
    # A speed reverses where it is zero itself.
    speed = drive(speed={"value": 1.0, "amplitude": -2.0, "angular_frequency": 3.0})
    assert times(speed, 2.0) == pytest.approx([math.pi / 18, 5 * math.pi / 18], rel=1e-12)
    one_way = drive(speed={"value": 3.0, "amplitude": 2.0, "angular_frequency": 3.0})
    assert times(one_way, 20.0) == []
    assert times(drive(torque={"amplitude": 2.0, "angular_frequency": 3.0}), 20.0) == []
    assert times(drive(speed={"value": -3.0}), 20.0) == []


def test_tables_reverse_stop_and_start() -> None:
    ramp = {"times": [0, 1, 2, 3, 4], "values": [0, 1, 1, 0, 0.5], "interpolation": "linear"}
    # Between these instants the direction is +, 0, −, +; corners are parabolas of a finite length.
    assert times(drive(angle=ramp), 4.0) == pytest.approx([1.0, 2.0, 3.0], abs=0.05)
    there = drive(velocity={"times": [0, 1, 2], "values": [1, 0.5, -1]})
    (turn,) = times(there, 2.0)
    assert 1.0 < turn < 2.0


def test_a_run_says_which_reversals_of_a_cycle_it_lacks() -> None:
    swing = drive(angle={"swing": 0.7, "angular_frequency": 2.0 * math.pi})
    held = Reversals((swing,), 1.0, 0.8)
    (said,) = held.notes(0.8, carried=False)
    assert "Of the 2 reversals of a drive cycle the run holds 1" in said
    assert not Reversals((swing,), 1.0, 2.0).notes(2.0, carried=False)


def test_largest_rows_in_and_outside_the_impacts() -> None:
    t = np.linspace(0.0, 2.0, 201)
    values = np.column_stack([np.sin(3.0 * t), np.full(t.size, np.nan)])
    found = of_rows(t, {"force": values}, np.array([0.0, 1.0]), 0.2)
    assert found["force_impact"][:, 0] == pytest.approx([math.sin(0.6), -math.sin(3.6)], abs=1e-4)
    assert found["force_outside"][0, 0] == pytest.approx(1.0, abs=1e-4)
    assert found["force_outside_time"][0, 0] == pytest.approx(math.pi / 6, abs=0.005)
    assert found["force_outside_time"][1, 0] == pytest.approx(math.pi / 2, abs=0.005)
    assert np.isnan(found["force_impact"][:, 1]).all()


@pytest.fixture(scope="module")
def both() -> tuple[xr.Dataset, xr.Dataset]:
    """The reduced vane mechanism and the same as a user-defined one, over a little more than half a cycle."""
    conductors = {
        "surfaces.trunnion.conductivity": "18 W/(m K)",
        "surfaces.trunnion.diffusivity": "5 mm^2/s",
        "surfaces.bushing.conductivity": "0.35 W/(m K)",
        "surfaces.bushing.diffusivity": "0.2 mm^2/s",
        "run.cycles": 0.6,
    }
    reduced = td.simulate(td.load_case("vsv").replace(conductors))
    drawn = td.load_case("vsv-free").replace({**conductors, "solver.rtol": 1e-4})
    return reduced, td.simulate(drawn)


def test_a_user_defined_vane_has_the_reversals_of_the_reduced_one(both):
    reduced, drawn = both
    np.testing.assert_allclose(drawn["reversal_time"], reduced["reversal_time"], rtol=1e-12)
    assert drawn.attrs["impact_time"] == pytest.approx(reduced.attrs["impact_time"], rel=1e-12)
    trunnion = drawn.sel(joint="trunnion")
    # Outside the impacts; in them the thrust collar and friction differ.
    for name, of_reduced in (("pressure", "pressure"), ("offset", "eccentricity")):
        outside = trunnion[f"{name}_outside"].values
        np.testing.assert_allclose(outside, reduced[f"{of_reduced}_outside"], rtol=0.015)
    crank = drawn.sel(joint="crank-pivot")["drive_moment_outside"].values
    np.testing.assert_allclose(crank, reduced["drive_moment_outside"], rtol=0.01)
    summary = drawn.tribodyn.summary
    assert summary["reversals"] == reduced.tribodyn.summary["reversals"] == 1
    assert summary["offset_outside_um_trunnion"] == pytest.approx(
        float(np.nanmax(trunnion["offset_outside"])) * 1e6
    )
    assert "drive_moment_outside_Nm_trunnion" not in summary


def test_a_result_with_an_ideal_joint_is_read_again(tmp_path: Path) -> None:
    drawn = (
        td.Mechanism("Rocker", run={"duration": "20 ms", "step_rows": 0})
        .body("arm", mass="1 kg", centre="50, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        .body("bob", mass="1 kg", centre="100, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        .revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("tip", "arm", "bob", point="100, 0, 0 mm", axis=[0, 0, 1])
        .clearance("tip", radius="5 mm", radial="20 um", length="10 mm", axial="50 um")
        .drive("motor", "hinge", angle={"value": "0 deg", "swing": "2 deg", "angular_frequency": "600 rad/s"})
    )
    result = td.simulate(drawn)
    assert np.isnan(result["offset_impact"].sel(joint="hinge")).all()
    write_run(result, tmp_path)
    assert td.read(tmp_path).identical(result)


def test_a_user_defined_vane_has_the_flash_temperature_of_the_reduced_one(both):
    reduced, drawn = both
    flash = float(drawn["flash_temperature"].sel(joint="trunnion"))
    assert flash == pytest.approx(reduced.attrs["flash_temperature"], rel=0.05)
    assert np.isnan(drawn["flash_temperature"].sel(joint="pin"))
