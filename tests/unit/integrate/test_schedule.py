"""The marks of an integration in time."""

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.integrate.following import make_schedule


def test_marks_are_the_union_of_outputs_and_pictures():
    schedule = make_schedule((0.0, 4.0), (2.0,), [0.0, 1.0, 2.0], [1.0, 1.5, 4.0])
    np.testing.assert_array_equal(schedule.edges, [0.0, 2.0, 4.0])
    np.testing.assert_array_equal(schedule.marks, [0.0, 1.0, 1.5, 2.0, 4.0])
    np.testing.assert_array_equal(schedule.is_output, [True, True, False, True, False])
    np.testing.assert_array_equal(schedule.is_picture, [False, True, True, False, True])


def test_times_a_rounding_error_apart_are_the_same_mark():
    assert 3 * 0.1 != 0.3
    schedule = make_schedule((0.0, 1.0), (0.3,), [0.1 * k for k in range(11)], [0.3, 0.7])
    assert schedule.marks.size == 11
    assert 0.3 in schedule.marks.tolist()
    assert schedule.is_picture.sum() == 2
    assert schedule.output_times[3] == 3 * 0.1, "outputs are returned as they were asked for"


@pytest.mark.parametrize(
    ("span", "outputs", "message"),
    [
        ((0.0, 0.0), [], "finite and increasing"),
        ((1.0, 0.0), [], "finite and increasing"),
        ((0.0, np.inf), [], "finite and increasing"),
        ((0.0, 1.0), [0.0, 0.5, 0.5], "must increase"),
        ((0.0, 1.0), [0.5, 0.2], "must increase"),
        ((0.0, 1.0), [0.5, 1.1], "between 0 s and 1 s"),
        ((0.0, 1.0), [-0.1], "between 0 s and 1 s"),
        ((0.0, 1.0), [np.nan], "finite"),
    ],
)
def test_times_that_cannot_be_kept_are_refused(span, outputs, message):
    with pytest.raises(InputError, match=message):
        make_schedule(span, (), outputs, ())
