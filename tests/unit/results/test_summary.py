import json
import math

import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.mechanisms.results import summarise
from tribodyn.papers.cheng_2022.reduced.key_results import KEY_RESULTS
from tribodyn.results import build
from tribodyn.results.dataset import WEAR_SCATTER

PERIOD = 2.0 * np.pi
IMPACT_TIME = 0.1 * np.pi


def test_every_key_result_of_a_whole_run_is_a_number(make_result):
    summary = summarise(make_result())
    assert set(KEY_RESULTS) <= set(summary)
    assert all(math.isfinite(summary[name]) for name in KEY_RESULTS)
    assert summary["status"] == "complete"
    assert summary["steps"] == 4321
    assert "assumed" in summary["warnings"][0]


def test_known_numbers():
    time = np.array([0.0, 1.0, 4.0])  # not uniform: a plain mean would weigh the ends wrongly
    result = build(
        coordinates={"time": time},
        columns={
            "theta_v": np.deg2rad([60.0, 60.03, 60.0]),
            "theta_v_ideal": np.deg2rad([60.0, 60.0, 60.01]),
            "F_cx": [0.0, 3.0, 3.0],
            "F_cy": [0.0, 4.0, 4.0],
            "p_max": [1e6, 2e6, np.nan],
        },
        attributes={"kind": "vsv", "solver": {"wall_time": 2.0}, "energy_residual": 0.002},
        variables=MECHANISMS["vsv"].variables,
    )
    summary = summarise(result)
    assert summary["vane_angle_error_max_deg"] == pytest.approx(0.03)
    assert summary["contact_force_max_N"] == pytest.approx(5.0)
    assert summary["contact_force_mean_N"] == pytest.approx((2.5 * 1 + 5 * 3) / 4)
    assert summary["peak_pressure_MPa"] == pytest.approx(2.0)
    assert summary["energy_residual_percent"] == pytest.approx(0.2)
    assert summary["real_time_factor"] == pytest.approx(2.0)


def test_what_is_missing_is_left_out_and_nothing_is_nan(make_result):
    for end in (0.0, 0.005, 0.5):
        summary = summarise(make_result(end, failure="stopped", energy_residual=math.nan))
        numbers = [value for value in summary.values() if not isinstance(value, str | list | dict)]
        assert all(math.isfinite(value) for value in numbers)
        assert "energy_residual_percent" not in summary
        assert summary["failure"] == "stopped"


@pytest.mark.parametrize("which", WEAR_SCATTER)
def test_a_scatter_of_wear_with_one_end_is_none(make_result, which):
    half = {name: json.dumps({} if name == which else {"": 1.5}) for name in WEAR_SCATTER}
    assert summarise(make_result().assign_attrs(half))["intervals"] == {}


def test_a_peak_between_output_times_is_not_lost(make_result):
    result = make_result(4.0)
    result["contact_force_impact"].values[1] = 1234.0
    result["pressure_outside"].values[0] = 5e8
    summary = summarise(result)
    assert summary["contact_force_max_N"] == 1234.0
    assert summary["contact_force_outside_N"] < 100.0
    assert summary["peak_pressure_MPa"] == pytest.approx(500.0)
    assert summary["pressure_outside_MPa"] == pytest.approx(500.0)


@pytest.mark.parametrize(
    ("end", "start", "held"),
    [
        (3.0, "equilibrium", 0),  # before the first reversal
        (np.pi + 0.5 * IMPACT_TIME, "equilibrium", 0),  # its impacts are not over
        (np.pi + 1.01 * IMPACT_TIME, "equilibrium", 1),
        (np.pi + 1.01 * IMPACT_TIME, "carried on", 2),  # the start is a reversal, too
        (2.0 * PERIOD, "centred", 3),
        (0.5 * IMPACT_TIME, "carried on", 0),
    ],
)
def test_a_reversal_counts_with_the_impacts_that_follow(make_result, end, start, held):
    assert summarise(make_result(end, start=start))["reversals"] == held


def test_a_peak_is_told_with_the_reversals_it_was_looked_for_after(make_result):
    summary = summarise(make_result())
    assert KEY_RESULTS["contact_force_max_N"].label_in(summary) == "Contact force, peak after 3 reversals"
    one = summarise(make_result(5.0))
    assert KEY_RESULTS["contact_force_max_N"].label_in(one).endswith("after 1 reversal")
    assert (
        KEY_RESULTS["contact_force_outside_N"].label_in(one) == KEY_RESULTS["contact_force_outside_N"].label
    )


def test_no_wear_rate_before_a_cycle_is_complete(make_result):
    assert "wear_depth_rate_nm_per_1000_cycles" not in summarise(make_result(3.0))
