"""The marks of an integration in time."""

import numpy as np
import pytest

from tribodyn.integrate.following import make_schedule


@pytest.mark.parametrize("shift", [-1e-15, 1e-15])
def test_times_a_rounding_error_outside_the_span_are_on_its_ends(shift):
    schedule = make_schedule((0.0, 1.0), (), [shift, 1.0 + shift], [])
    np.testing.assert_array_equal(schedule.marks, [0.0, 1.0])
