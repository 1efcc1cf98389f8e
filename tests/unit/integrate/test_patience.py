"""Runs that step without getting anywhere end; runs that are slow, or have a hard stretch, go on."""

import numpy as np
import pytest

from tribodyn.core.errors import IntegrationFailure
from tribodyn.integrate import driver
from tribodyn.integrate.driver import LOOK, Patience
from tribodyn.integrate.following import make_schedule

DURATION = 1.0


class Clock:
    """A clock that the test turns."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        """Return the time [s]."""
        return self.now


def looks(monkeypatch: pytest.MonkeyPatch, marks: list[tuple[float, int]]) -> None:
    """Look at a run of one second at marks of simulated time and evaluations, five seconds apart."""
    clock = Clock()
    monkeypatch.setattr(driver, "time", clock)
    watched = Patience(make_schedule((0.0, DURATION), (), np.linspace(0.0, DURATION, 501), ()))
    for t, evaluations in marks:
        clock.now += 1.25 * LOOK
        watched.look(t, evaluations)


@pytest.mark.parametrize(
    "marks",
    [[(0.3, 5000), (0.3 + 1e-12, 60_000)], [(1e-13, 50_000)], [(0.5, 100_000), (0.5, 200_000)]],
    ids=["collapsed", "from the start", "no step at all"],
)
def test_a_run_that_is_stuck_ends_within_two_looks(
    monkeypatch: pytest.MonkeyPatch, marks: list[tuple[float, int]]
) -> None:
    with pytest.raises(IntegrationFailure, match="no progress any more"):
        looks(monkeypatch, marks)
    assert 2.0 * LOOK < 10.0


@pytest.mark.parametrize(
    "marks",
    [
        [(0.3, 5000), (0.3 + 1e-4, 60_000), (0.6, 65_000)],
        [(1e-4, 50_000), (2e-4, 100_000), (3e-4, 150_000)],
        [(0.3, 5000), (0.3, 5100), (0.3, 5200)],
        [(0.999, 5000), (0.999 + 1e-5, 105_000)],
    ],
    ids=["an impact", "slow all the time", "dear evaluations", "near the end"],
)
def test_a_run_that_is_slow_goes_on(monkeypatch: pytest.MonkeyPatch, marks: list[tuple[float, int]]) -> None:
    looks(monkeypatch, marks)
