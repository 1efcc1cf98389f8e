"""The books of peaks, on values of which the peaks are known."""

import numpy as np
import pytest

from tribodyn.kernels.ledger import NOW
from tribodyn.kernels.peaks import IMPACT, MOST_RISE, OUTSIDE, begin, new_peaks, note


def noted(times, values, *, begins=(0.0,), impact_time=1.0):
    """Return books of one quantity that were told the values at the times."""
    peaks = new_peaks(1, reversals=len(begins) - 1, impact_time=impact_time)
    for t, value in zip(times, values, strict=True):
        peaks.values[NOW] = value
        begin(peaks, t) if t in begins else note(peaks, t)
    return peaks


@pytest.mark.parametrize("short", [0.1, 1e-3, 1e-9])
def test_a_jump_makes_no_peak(short):
    peaks = noted([0.0, 1.0, 1.0 + short, 3.0], [1.0, 1.0, 0.0, 0.0], impact_time=10.0)
    assert 1.0 <= peaks.largest[0, IMPACT, 0] <= 1.0 + MOST_RISE


def test_what_was_not_reached_or_is_no_number_is_not_there():
    peaks = noted([0.0, 0.5], [np.nan, 2.0], begins=(0.0, 3.0))
    assert peaks.largest[0, IMPACT, 0] == 2.0
    assert np.isnan(peaks.largest[0, OUTSIDE, 0])
    assert np.isnan(peaks.largest[1]).all()
