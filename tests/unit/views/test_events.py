import numpy as np
import pytest

from tribodyn.figures.chart import close_up
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import build
from tribodyn.views.bushing_sections import CONTACT_FORCE
from tribodyn.views.events import reversal_times

VSV = MECHANISMS["vsv"]


def _speeds(time, speed):
    return build(coordinates={"time": time}, columns={"omega_v_ideal": speed}, variables=VSV.variables)


def test_reversals_of_a_sine():
    time = np.arange(0.0, 12.5, 5e-3)
    assert reversal_times(_speeds(time, np.sin(time))) == pytest.approx(np.pi * np.array([1, 2, 3]), abs=1e-5)


def test_the_close_up_starts_at_the_hardest_reversal(make_result):
    result = make_result()
    after = (result["time"] > np.pi) & (result["time"] < np.pi + 0.02)
    result["F_cx"].values[after.values] += 500.0
    start, end = close_up(result, CONTACT_FORCE)
    assert start == pytest.approx(np.pi, abs=5e-3)
    assert 0.03 <= end - start <= 0.3


def test_without_reversal_the_close_up_shows_the_largest_force(make_result):
    result = make_result(1.0)
    result["F_cx"].values[100] = 1e3
    assert close_up(result, CONTACT_FORCE)[0] == pytest.approx(0.5)
