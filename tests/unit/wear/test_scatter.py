"""Intervals of wear from repeats, by hand."""

import math

import pytest

from tribodyn.wear.archard import LEAST, of_repeats


def test_the_interval_of_repeats_is_that_of_one_more_part() -> None:
    """Logarithms 0, 1, 2 of base 2: deviation ln 2; Student's quantile of two degrees of freedom: 4.303."""
    low, high = of_repeats([1.0, 2.0, 4.0])
    factor = math.exp(4.302653 * math.log(2.0) * math.sqrt(4.0 / 3.0))
    assert (low, high) == pytest.approx((1.0 / factor, factor), rel=1e-6)


def test_two_repeats_that_agree_promise_no_less_than_equal_tests_differ_by() -> None:
    assert of_repeats([1.0, 1.0]) == (1.0 / LEAST, LEAST)
    low, high = of_repeats([0.060, 0.044])
    factor = math.exp(12.7062 * math.log(0.060 / 0.044) / math.sqrt(2.0) * math.sqrt(1.5))
    assert (low, high) == pytest.approx((1.0 / factor, factor), rel=1e-5)


def test_the_unit_of_repeats_does_not_matter() -> None:
    assert of_repeats([1.2, 0.9, 2.1]) == pytest.approx(of_repeats([12e-9, 9e-9, 21e-9]))
