"""Motion between rows: free flights are parabolas, not polygons."""

import numpy as np

from tribodyn.core.splines import Cubics
from tribodyn.views.playback import dense_times

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
