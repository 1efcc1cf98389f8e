"""The books of peaks, on values of which the peaks are known."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.kernels.ledger import NOW
from tribodyn.kernels.peaks import IMPACT, begin, new_peaks, note


def noted(times, values, *, begins=(0.0,), impact_time=1.0):
    """Return books of one quantity that were told the values at the times."""
    peaks = new_peaks(1, reversals=len(begins) - 1, impact_time=impact_time)
    for t, value in zip(times, values, strict=True):
        peaks.values[NOW] = value
        begin(peaks, t) if t in begins else note(peaks, t)
    return peaks


def test_a_parabola_is_found_between_equal_steps():
    t = np.arange(0.0, 1.01, 0.1)
    peaks = noted(t, 5.0 - 20.0 * (t - 0.33) ** 2)
    assert peaks.largest[0, IMPACT, 0] == pytest.approx(5.0)
    assert peaks.when[0, IMPACT, 0] == pytest.approx(0.33)


def test_the_top_of_an_impact_is_missed_by_a_tenth_of_what_steps_alone_miss():
    """Eight steps in an impact of a half sine, wherever they fall."""
    for shift in np.linspace(0.0, 1.0, 11):
        t = (np.arange(12) + shift) / 8.0
        force = np.maximum(np.sin(np.pi * (t - 0.125)), 0.0)
        peaks = noted(np.append(0.0, t + 1e-3), np.append(0.0, force), impact_time=10.0)
        alone = 1.0 - force.max()
        # The fourth derivative of the sine over steps of an eighth leaves 0.2 %.
        assert abs(1.0 - peaks.largest[0, IMPACT, 0]) < 0.1 * alone + 2e-3


def test_stretches_and_their_parts_are_kept_apart():
    t = np.arange(600) / 100.0
    since = np.mod(t, 3.0)
    values = np.where(t < 3.0, 7.0, 9.0) * np.exp(-200.0 * (since - 0.5) ** 2) + since
    peaks = noted(t, values, begins=(0.0, 3.0))
    # The bells stand on a slope of 1, and the second stretch begins where the first ends.
    assert peaks.largest[:, :, 0] == pytest.approx(np.array([[7.5, 2.99], [9.5, 2.99]]), abs=0.02)
    assert peaks.when[:, IMPACT, 0] == pytest.approx([0.5, 3.5], abs=0.01)
