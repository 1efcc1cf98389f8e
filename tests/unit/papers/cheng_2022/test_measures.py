"""What claims measure, on motions of which it is known."""

import numpy as np
import pytest
import xarray as xr

from tribodyn.papers.cheng_2022.claims.errors import speed_trend
from tribodyn.papers.cheng_2022.claims.journal import fall_time, late_motion
from tribodyn.papers.cheng_2022.claims.pressure import ZONE, contact_arc
from tribodyn.papers.cheng_2022.runs import joined


@pytest.mark.parametrize("n", [48, 96, 720])
@pytest.mark.parametrize("middle", [-10.0, 180.0])
def test_ends_of_contact_lie_between_nodes(n, middle):
    theta = 2.0 * np.pi * np.arange(n) / n
    away = (np.degrees(theta) - middle + 180.0) % 360.0 - 180.0
    first, last = contact_arc(theta, 3e6 * np.exp(-np.abs(away - 7.0) / 11.0), middle)
    # Pressure falls by a factor with each degree: between nodes on either side the line is exact, but that
    # the peak itself may lie between nodes.
    reach = 11.0 * np.log(1.0 / ZONE)
    assert first == pytest.approx(middle + 7.0 - reach, abs=180.0 / n)
    assert last == pytest.approx(middle + 7.0 + reach, abs=180.0 / n)


def test_the_trend_of_the_speed_forgets_what_rings():
    period = 2.0 * np.pi
    time = np.arange(0.0, 2.0 * period, 5e-3)
    trend, ringing = 2e-3, 1e-4 * np.sin(2.0 * np.pi * 20.0 * time)
    angle = np.radians(trend * time + ringing)
    run = xr.Dataset(
        {"theta_v": ("time", angle), "theta_v_ideal": ("time", np.zeros_like(time))},
        coords={"time": time},
        attrs={"cycle_period": period, "impact_time": 0.3},
    )
    # Its speed rings by 0.0126 °/s, six times the trend; four of its periods are averaged.
    assert speed_trend(run) == pytest.approx(trend, rel=1e-3)


def test_the_fall_of_a_force_is_timed_between_rows():
    time = np.arange(0.0, 0.05, 5e-5)
    force = np.exp(-time / 4e-3)
    run = xr.Dataset({"F_ox": ("time", -force), "F_oy": ("time", 0.0 * force)}, coords={"time": time})
    # ln 9 time constants; lines between rows 50 µs apart bend by a thousandth of that.
    assert fall_time(run) == pytest.approx(4.0 * np.log(9.0), rel=1e-3)


def test_the_late_motion_is_that_of_the_coordinate_that_moves_more():
    time = np.linspace(0.0, 1.0, 101)
    run = xr.Dataset(
        {"e_x": ("time", 1e-6 * time), "e_y": ("time", 3e-6 * time)},
        coords={"time": time},
        attrs={"clearance": 20e-6},
    )
    assert late_motion(run) == pytest.approx(100.0 * 0.2 * 3.0 / 20.0)


def test_runs_with_rows_of_their_own_come_side_by_side():
    def run(time):
        time = np.array(time)
        return xr.Dataset(
            {"a": ("time", 2.0 * time), "b": ("z", np.ones(2)), "c": (("time", "z"), np.outer(time, [1, 3]))},
            coords={"time": time, "z": [0.0, 1.0]},
        )

    whole = joined([run([0.0, 1.0, 3.0]), run([0.0, 2.0, 3.0])], xr.Variable("law", ["x", "y"]))
    assert whole["time"].values.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert whole["a"].dims == ("law", "time")
    np.testing.assert_allclose(whole["a"].values, 2.0 * np.array([[0.0, 1.0, 2.0, 3.0]] * 2), rtol=1e-15)
    np.testing.assert_allclose(whole["c"].values[1], np.outer([0.0, 1.0, 2.0, 3.0], [1, 3]), rtol=1e-15)
