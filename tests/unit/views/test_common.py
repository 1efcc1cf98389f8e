"""What a comparison compares: the stretch that all results hold, with the same reversals."""

import numpy as np
import pytest

from tribodyn.mechanisms.results import summarise
from tribodyn.views.common import in_common

PERIOD = 2.0 * np.pi


@pytest.fixture
def demo(make_result):
    """Two cycles from the start, each reversal with its own peak."""
    result = make_result(2.0 * PERIOD, time_reached=2.0 * PERIOD)
    result["contact_force_impact"].values[:] = [20.0, 90.0, 300.0, 91.0]
    return result


def test_runs_that_agree_are_left_alone(demo):
    (one, other), said = in_common([demo, demo.copy()])
    assert one is demo
    assert other.identical(demo)
    assert said == ""


def test_a_shorter_run_cuts_the_longer_one(demo, make_result):
    short = make_result(PERIOD, time_reached=PERIOD)
    (long, same), said = in_common([demo, short])
    assert same.sizes == short.sizes
    assert "6.283 s" in said
    assert float(long["time"].max()) <= PERIOD * (1.0 + 1e-9)
    assert [summarise(result)["reversals"] for result in (long, same)] == [1, 1]
    assert summarise(long)["contact_force_max_N"] < 300.0


def test_a_cycle_of_a_campaign_is_laid_beside_the_last_cycle(demo, make_result):
    worn = make_result(PERIOD, time_reached=PERIOD, start="carried on")
    worn["contact_force_impact"].values[:] = [270.0, 80.0]
    (last, cycle), said = in_common([demo, worn])
    assert "the last drive cycle of each run, with the 2 reversals" in said
    assert [summarise(result)["reversals"] for result in (last, cycle)] == [2, 2]
    assert summarise(last)["contact_force_max_N"] == 300.0
    assert summarise(cycle)["contact_force_max_N"] == 270.0
    assert float(last["time"].min()) == pytest.approx(PERIOD, abs=5e-3)


def test_impacts_that_one_run_does_not_hold_are_left_out_of_all(make_result):
    fresh = make_result(PERIOD, time_reached=PERIOD)
    worn = make_result(PERIOD, time_reached=PERIOD, start="carried on")
    worn["contact_force_impact"].values[:] = [500.0, 80.0]
    worn["F_cx"].values[1] = 500.0
    (_, cycle), said = in_common([fresh, worn])
    assert "with the 1 reversal that" in said
    assert summarise(cycle)["reversals"] == 1
    assert summarise(cycle)["contact_force_max_N"] < 500.0
    # What lies outside those impacts stays.
    assert np.isfinite(cycle["contact_force_outside"].values).all()


def test_what_cannot_be_laid_beside_each_other_is_said(demo, make_result):
    fast = make_result(PERIOD, time_reached=PERIOD, cycle_period=0.5 * PERIOD)
    assert "last differently" in in_common([demo, fast])[1]
    begun = make_result(2.0, time_reached=2.0, start="carried on")
    assert "begin differently" in in_common([demo, begun])[1]


def test_results_without_reversals_are_left_alone(demo):
    bare = demo.drop_dims("reversal")
    assert in_common([demo, bare])[1] == ""
    assert in_common([demo])[1] == ""
