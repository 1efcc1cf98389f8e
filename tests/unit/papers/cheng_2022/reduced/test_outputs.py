"""Outputs of the reduced mechanism, and the engine around it."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.cases.tables import keys_in
from tribodyn.core.errors import TribodynError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import key_results_of_case, summarise
from tribodyn.papers.cheng_2022.reduced.descriptor import ENGINE
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


PAPERS_LOADS = {
    "loads.air_force_x": "0.4 N",
    "loads.air_force_y": "1.2 N",
    "loads.air_moment": "0.84 N m",
    "loads.more.gas.force_x.values": "0, 0, 0, 0, 0 N",
    "loads.more.gas.force_y.value": "0 N",
    "loads.more.gas.moment.values": "0, 0, 0, 0, 0 N m",
}


def test_every_number_has_a_source_or_is_assumed() -> None:
    case = td.load_case("vsv-engine")
    keys = keys_in(case)
    for path in ENGINE.given:
        key = path if path in keys else f"{path}.value"
        assert ENGINE.origins[path] or keys[key].kind == "text", path
    shown = case.to_toml(comments=True)
    assert "makeitfrom" in shown
    # The modulus in force follows from the temperature, and says so.
    line = next(line for line in shown.splitlines() if line.startswith('young_modulus = "4.3 GPa"'))
    assert "temperature.properties" in line


@pytest.fixture(scope="module")
def engine() -> xr.Dataset:
    """Return the run of the built-in case."""
    return td.simulate(td.load_case("vsv-engine"))


def test_the_heat_leaves_about_the_clearance_of_the_paper(engine: xr.Dataset) -> None:
    # Trunnion 6 mm, sleeve 1.5 mm, Poisson's ratio 0.34; free strains of 280 K.
    steel, polyimide = 11e-6 * 280.0, 38e-6 * 280.0
    sleeve = 1.5e-3 * (1.0 + polyimide + 2.0 * 0.34 / 0.66 * (polyimide - steel))
    expected = (6.043e-3 + 1.5e-3) * (1.0 + steel) - sleeve - 6e-3 * (1.0 + steel)
    assert engine.attrs["clearance"] == pytest.approx(expected, rel=1e-9)
    assert 19e-6 < engine.attrs["clearance"] < 21e-6


def test_impacts_are_made_by_the_load_that_opposes_the_motion(engine: xr.Dataset) -> None:
    hot = summarise(engine)
    braked = summarise(td.simulate(td.load_case("vsv-engine").replace(PAPERS_LOADS)))
    paper = summarise(td.simulate(td.load_case("vsv")))
    peak, smooth = "contact_force_max_N", "contact_force_outside_N"
    assert hot[peak] < 1.2 * hot[smooth]
    assert braked[peak] > 2.5 * braked[smooth]
    assert paper[peak] > 2.5 * paper[smooth]
    # Under the same loads sleeve and chamfer leave less than half of the edge pressure, a third of its peaks.
    assert braked["pressure_outside_MPa"] < 0.5 * paper["pressure_outside_MPa"]
    assert braked["peak_pressure_MPa"] < paper["peak_pressure_MPa"] / 3.0
    assert hot["wear_depth_rate_nm_per_1000_cycles"] < 0.5 * paper["wear_depth_rate_nm_per_1000_cycles"]
    error = "vane_angle_error_outside_deg"
    assert hot[error] == pytest.approx(paper[error], rel=0.15)


def test_the_force_changes_its_sign_with_the_gas_moment(engine: xr.Dataset) -> None:
    later = engine.sel(time=slice(2.0 * np.pi + 0.5, 3.0 * np.pi - 0.5))
    signs = np.sign(later["F_cx"].values)
    turned = np.degrees(later["theta_v"].values[np.flatnonzero(np.diff(signs))])
    assert turned.size == 1
    assert turned[0] == pytest.approx(90.0, abs=5.0)
    assert (np.diff(later["theta_v"]) > 0.0).all()


def test_commands_find_the_names() -> None:
    case = td.load_case("vsv").replace({"outputs.vane.at.angles": "5 deg"})
    known = key_results_of_case(case)
    assert {"error_sustained_deg_vane", "error_at_backward_deg_vane_5_deg"} <= known.keys()


def test_another_limit_is_refused() -> None:
    with pytest.raises(TribodynError, match="the limit of this error is angle_error_limit"):
        td.load_case("vsv").replace({"outputs.vane.angular_velocity_error_limit": "1 deg/s"})
