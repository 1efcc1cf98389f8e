"""What else holds."""

import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import build
from tribodyn.views.playback import direction, reversal_times

VSV = MECHANISMS["vsv"]


def _speeds(time, speed):
    return build(coordinates={"time": time}, columns={"omega_v_ideal": speed}, variables=VSV.variables)


def test_a_sample_exactly_at_the_reversal_counts_once():
    assert reversal_times(_speeds([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, -1.0])) == pytest.approx([2.0])


def test_lost_samples_are_passed_over():
    assert reversal_times(_speeds([0.0, 1.0, 2.0, 3.0], [1.0, np.nan, -1.0, np.nan])) == pytest.approx([1.0])


def test_direction_follows_the_ideal_motion():
    assert direction(_speeds([0.0, 1.0], [2.0, -2.0])).tolist() == [1.0, -1.0]
