"""Fewer points of a curve, and more times of a motion: no peak is lost, no line is far off."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tribodyn.core.splines import Cubics
from tribodyn.views.charts import straightened, thinned
from tribodyn.views.playback import dense_times


@given(
    y=st.lists(st.floats(-1e6, 1e6) | st.just(float("nan")), min_size=1, max_size=400),
    most=st.integers(5, 60),
)
def test_peaks_ends_and_order_are_kept(y, most):
    values, x = np.array(y), np.arange(len(y), dtype=float)
    few_x, few_y = thinned(x, values, most)
    assert few_x.size <= most
    assert np.all(np.diff(few_x) > 0.0)
    assert (few_x[0], few_x[-1]) == (x[0], x[-1])
    if np.isfinite(values).any():
        assert (np.nanmin(few_y), np.nanmax(few_y)) == (np.nanmin(values), np.nanmax(values))
    assert np.isnan(few_y).any() == np.isnan(values).any()


def test_every_peak_of_a_fine_signal_is_there():
    x = np.arange(100_000.0)
    y = np.zeros_like(x)
    spikes = np.arange(500, 100_000, 5000)
    y[spikes] = 1.0 + np.arange(spikes.size)
    few_x, few_y = thinned(x, y, 500)
    assert few_x.size <= 500
    assert few_y[np.isin(few_x, spikes)] == pytest.approx(y[spikes])


@given(
    y=st.lists(st.floats(-1.0, 1.0) | st.just(float("nan")), min_size=1, max_size=300),
    tolerance=st.sampled_from([0.0, 0.01, 0.3]),
)
def test_lines_replace_points_within_the_tolerance(y: list[float], tolerance: float) -> None:
    values, x = np.array(y), np.cumsum(1.0 + np.arange(len(y)) % 3)
    few_x, few_y = straightened(x, values, tolerance)
    good = np.isfinite(values)
    assert np.isnan(few_y).sum() == (~good).sum()
    # Rounding of a line between two points of size 1.
    assert np.all(np.abs(np.interp(x, few_x, few_y) - values)[good] <= tolerance + 1e-15)


FALL = np.array([0.0, -9.81])
TIME = np.array([0.0, 0.01, 0.03, 0.04])
START = np.array([0.2, 0.1])


def flight(t: np.ndarray) -> np.ndarray:
    return START * t[:, None] + 0.5 * FALL * t[:, None] ** 2


def test_a_free_flight_is_the_parabola_that_it_is() -> None:
    times = np.linspace(0.0, 0.04, 41)
    rates = START + FALL * TIME[:, None]
    # Rounding.
    np.testing.assert_allclose(Cubics(TIME, flight(TIME), rates)(times), flight(times), atol=1e-15)


def test_lines_between_dense_times_miss_no_more_than_asked_for() -> None:
    rates, room = START + FALL * TIME[:, None], 2e-5
    times = dense_times(TIME, flight(TIME), rates, room)
    assert set(TIME) <= set(times)
    middle = 0.5 * (times[1:] + times[:-1])
    lines = 0.5 * (flight(times)[1:] + flight(times)[:-1])
    assert np.linalg.norm(lines - flight(middle), axis=1).max() <= room
    # Not more than needed: the longest row needs √(g h²/8/room) = 5 pieces.
    assert times.size <= 3 * 5 + 1
