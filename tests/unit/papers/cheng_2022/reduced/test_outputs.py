"""Outputs of the vane mechanism have the names and statistics of those of user-defined mechanisms."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column, settled

TEXT = """
case = "vsv"
[outputs.vane]
at.angles = ["0 deg", "5 deg"]
at.times = ["0.5 s"]
angle_error_limit = "0.06 deg"
[outputs.speed]
quantity = "angular_velocity"
"""


@pytest.fixture(scope="module")
def vane() -> xr.Dataset:
    return td.simulate(parse_case(TEXT, "test"))


def test_the_error_is_that_of_the_vane_angle(vane: xr.Dataset) -> None:
    error = column(vane, "theta_v") - column(vane, "theta_v_ideal")
    assert column(vane, "output_error")[:, 0] == pytest.approx(error)
    speed = column(vane, "omega_v") - column(vane, "omega_v_ideal")
    assert column(vane, "output_error")[:, 1] == pytest.approx(speed)
    assert vane["output_unit"].values.tolist() == ["rad", "rad/s"]


def test_statistics_are_those_of_user_defined_mechanisms(vane: xr.Dataset) -> None:
    numbers = summarise(vane)
    assert numbers["error_max_deg_vane"] == pytest.approx(numbers["vane_angle_error_max_deg"], rel=0.02)
    assert numbers["error_rms_deg_vane"] < numbers["error_sustained_deg_vane"] < numbers["error_max_deg_vane"]
    # Air loads and friction press the trunnion to opposite sides in both directions.
    assert numbers["error_forward_deg_vane"] < 0.0 < numbers["error_backward_deg_vane"]
    assert numbers["error_of_limit_percent_vane"] == pytest.approx(
        100.0 / 0.06 * np.degrees(np.abs(column(vane, "output_error")[:, 0]).max())
    )
    assert numbers["error_rms_deg_per_s_speed"] > 0.0
    assert numbers["drive_moment_sustained_Nm"] <= numbers["drive_moment_max_Nm"]


def test_errors_are_read_where_the_crank_passes_an_angle(vane: xr.Dataset) -> None:
    numbers = summarise(vane)
    time, crank = (settled(vane, column(vane, name)) for name in ("time", "theta_a"))
    error = np.degrees(settled(vane, column(vane, "output_error")[:, 0]))
    rising = time <= time[np.argmax(crank)]
    expected = [np.interp(np.radians(5.0), crank[rising], error[rising])]
    expected.append(np.interp(np.radians(5.0), crank[~rising][::-1], error[~rising][::-1]))
    read = [numbers[f"error_at_{way}_deg_vane_5_deg"] for way in ("forward", "backward")]
    assert read == pytest.approx(expected, rel=1e-3)
    assert numbers["error_at_deg_vane_5_deg"] == pytest.approx(np.mean(expected), abs=1e-4)
    period = float(vane.attrs["cycle_period"])
    at_time = np.interp(period + 0.5, time, error)
    assert numbers["error_at_deg_vane_0_5_s"] == pytest.approx(at_time)


def test_a_campaign_ends_at_the_limit_of_an_output() -> None:
    case = td.load_case("vsv").replace(
        {
            "run.cycles": "1",
            "wear.cycles": "1000000000",
            "wear.specific_wear_rate": "1e-12 m^2/N",
            "outputs.vane.angle_error_limit": "0.031 deg",
        }
    )
    result = td.simulate(case)
    share = column(result, "wear_error_share")
    largest = column(result, "wear_angle_error_max")
    assert share == pytest.approx(np.degrees(largest) / 0.031)
    assert share[-1] >= 1.0
    cycles = column(result, "wear_cycles")
    assert summarise(result)["wear_life_cycles"] <= cycles[-1]
