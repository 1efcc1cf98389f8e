"""The frames of the animation: one cycle, evenly, and close together after reversals."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanisms.playback import AFTER_REVERSAL, EVEN, frame_times, shown

TURNS = np.array([1.0, 2.0, 3.0, 4.0, 5.0])  #: Reversals of a drive with a period of 2 s, in a run of 6 s.


def test_a_film_is_one_cycle_with_slow_motion_after_reversals() -> None:
    times = frame_times(6.0, 2.0, TURNS, 0.05)
    film = times[shown(times, 6.0, 2.0)]
    assert film[0] == pytest.approx(4.0)
    assert film[-1] == pytest.approx(6.0)
    assert np.diff(film).max() <= 2.0 / EVEN * (1 + 1e-9)
    after = (film > 5.0) & (film <= 5.05 + 1e-9)
    assert AFTER_REVERSAL <= after.sum() <= AFTER_REVERSAL + 4


@pytest.mark.parametrize(("reached", "begin", "end"), [(1.0, 0.0, 1.0), (3.9, 0.0, 2.0), (4.5, 4.0, 4.5)])
def test_a_run_that_stops_keeps_the_last_cycle_it_reached(reached: float, begin: float, end: float) -> None:
    times = frame_times(6.0, 2.0, TURNS, 0.05)
    times = times[times <= reached]
    film = times[shown(times, 6.0, 2.0)]
    assert film[0] == pytest.approx(begin)
    assert film[-1] == pytest.approx(end, abs=2.0 / EVEN)


def test_the_film_agrees_with_the_time_series() -> None:
    result = td.simulate(td.load_case("vsv").replace({"run.duration": "0.2 s"}))
    frames = result["pressure_cycle"]
    assert frames.dtype == np.float32
    time, peak = result["time"].values, result["p_max"].values
    same = np.isin(np.round(result["frame_time"].values, 12), np.round(time, 12))
    found = np.interp(result["frame_time"].values[same], time, peak)
    # Single precision keeps seven digits.
    np.testing.assert_allclose(frames.values.max(axis=(1, 2))[same], found, rtol=1e-6)
    assert same.sum() > 10
