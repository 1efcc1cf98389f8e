"""Life of a mechanism by the depth of its joints and by the errors of its outputs."""

import numpy as np
import pytest
import xarray as xr
from tests.analytic.mechanism.test_outputs import of, press

import tribodyn as td
from tribodyn.core.errors import TribodynError
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column

PIN = {
    "radius": "9.5 mm",
    "length": "20 mm",
    "axial": "50 um",
    "radial": "20 um",
    "nodes_around": 48,
    "nodes_along": 8,
}
RATE = "1e-13 m^2/N"


def worn(**changes: str) -> xr.Dataset:
    case = press(**PIN).case().replace({"wear.specific_wear_rate": RATE, **changes})
    result = td.simulate(case)
    assert result.attrs["failure"] == ""
    return result


@pytest.fixture(scope="module")
def by_error() -> xr.Dataset:
    return worn(**{"wear.cycles": "1000000", "outputs.way.error_limit": "23 um"})


def test_a_campaign_ends_at_the_error_limit_of_an_output(by_error: xr.Dataset) -> None:
    numbers = summarise(by_error)
    share = column(by_error, "wear_error_share")
    assert np.all(share[:-1] < 1.0)
    assert share[-1] >= 1.0
    cycles = column(by_error, "wear_cycles")
    assert cycles[-2] < numbers["wear_life_cycles"] <= cycles[-1] < 1_000_000
    expected = np.interp(1.0, share[-2:], cycles[-2:])
    assert numbers["wear_life_cycles"] == pytest.approx(expected)
    assert numbers["error_of_limit_percent_way"] == pytest.approx(100.0 * share[-1], rel=1e-6)
    assert "error_of_limit_percent_stroke" not in numbers


def test_the_error_grows_by_the_depth_of_the_joint(by_error: xr.Dataset) -> None:
    # A push along the rod wears the bore where the pin lies: at the dead centre the error grows by the depth.
    depth = column(by_error, "wear_depth_max")
    share = 23e-6 * column(by_error, "wear_error_share")
    growth = share[-1] - share[0]
    assert 0.5 * depth[-1] < growth < 1.05 * depth[-1]


def test_life_by_error_of_one_cycle_is_that_of_the_first_rate_of_a_campaign(by_error: xr.Dataset) -> None:
    # The pocket widens, so that the error grows more slowly later: here the campaign lasts 1.7 times as long.
    result = worn(**{"outputs.way.error_limit": "23 um", "wear.depth_limit": "1 mm"})
    numbers = summarise(result)
    share, cycles = column(by_error, "wear_error_share"), column(by_error, "wear_cycles")
    first = (1.0 - share[0]) * cycles[2] / (share[2] - share[0])
    assert numbers["error_life_cycles_way"] == pytest.approx(first, rel=0.1)
    assert 1.2 < summarise(by_error)["wear_life_cycles"] / numbers["error_life_cycles_way"] < 2.5
    assert numbers["wear_life_cycles"] == numbers["error_life_cycles_way"] < numbers["wear_life_cycles_wrist"]
    assert "error_life_cycles_stroke" not in numbers
    assert "Life by the error of output way is a linear estimate from this run" in result.attrs["notes"]


def test_life_of_each_joint_at_the_rate_of_one_cycle() -> None:
    result = worn(**{"wear.depth_limit": "2 um"})
    numbers = summarise(result)
    deepest = numbers["wear_depth_nm_wrist"]
    assert numbers["wear_rate_nm_per_1000_cycles_wrist"] == pytest.approx(1000.0 * deepest)
    assert numbers["wear_life_cycles_wrist"] == pytest.approx(2000.0 / deepest)
    assert numbers["wear_life_cycles"] == pytest.approx(numbers["wear_life_cycles_wrist"])
    assert "Worn deepest is joint wrist" in result.attrs["notes"]


def test_life_of_each_joint_in_a_campaign() -> None:
    result = worn(**{"wear.cycles": "1000", "wear.depth_limit": "2 um", "wear.jump_depth": "1"})
    numbers = summarise(result)
    cycles, depths = column(result, "stage_cycles"), np.nan_to_num(column(result, "stage_depth"))
    deepest = depths.reshape(len(cycles), -1).max(axis=1)
    rate = (deepest[-1] - deepest[-2]) / (cycles[-1] - cycles[-2])
    life = cycles[-1] + (2e-6 - deepest[-1]) / rate
    assert numbers["wear_life_cycles_wrist"] == pytest.approx(life, rel=1e-6)
    assert numbers["wear_life_cycles"] == pytest.approx(life, rel=1e-6)


def test_errors_by_the_direction_of_motion() -> None:
    # The push keeps the pin on one side: both directions have the same error but for friction, and together
    # they are the mean of the error over the cycle.
    result = worn()
    numbers = summarise(result)
    forward, backward = (numbers[f"error_{way}_um_way"] for way in ("forward", "backward"))
    error, ideal = of(result, "output_error", "way"), of(result, "output_ideal", "way")
    time = column(result, "time")
    rising, middle = np.diff(ideal) > 0.0, 0.5e6 * (error[1:] + error[:-1])
    assert forward == pytest.approx(np.average(middle[rising], weights=np.diff(time)[rising]), rel=1e-3)
    assert backward == pytest.approx(np.average(middle[~rising], weights=np.diff(time)[~rising]), rel=1e-3)
    assert forward * backward > 0.0


@pytest.mark.parametrize(("key", "said"), [("angle_error_limit", "the limit of this error is error_limit")])
def test_a_limit_of_another_quantity_is_refused(key: str, said: str) -> None:
    with pytest.raises(TribodynError, match=said):
        press().output("off", "slider", along=[1, 0, 0], **{key: "1 deg"}).case()


def test_bore_and_shaft_live_longer_than_what_both_wear_off() -> None:
    # Rates of 4 to 1: the bore takes 4/5 of the depth, the shaft 1/5.
    numbers = summarise(worn(**{"wear.depth_limit": "2 um", "wear.partner_wear_rate": "2.5e-14 m^2/N"}))
    both = numbers["wear_life_cycles_wrist"]
    assert numbers["bore_life_cycles_wrist"] == pytest.approx(both / 0.8)
    assert numbers["shaft_life_cycles_wrist"] == pytest.approx(both / 0.2)
