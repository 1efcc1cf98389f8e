"""Slopes of key results over five points."""

import pytest

from tribodyn.workbench.series import AROUND, slopes


def points(value, number):
    return [{"value": value * (1 + share), "results": {"a": number(1 + share)}} for share in AROUND]


def test_the_slope_of_a_power_is_its_exponent_and_a_line_has_no_scatter():
    line = slopes(points(40.0, lambda x: 3.0 * x))["a"]
    assert line["slope"] == pytest.approx(1.0, rel=1e-12)
    assert line["scatter"] == pytest.approx(0.0, abs=1e-12)
    # Over ten percent to either side, a square is its tangent but for the cube of that.
    assert slopes(points(40.0, lambda x: x**2))["a"]["slope"] == pytest.approx(2.0, rel=0.01)


def test_scatter_is_the_standard_error_of_the_slope():
    # Residuals ±1 % in turns, none of them along the line.
    noise = dict(zip(AROUND, (0.01, -0.01, 0.0, -0.01, 0.01), strict=True))
    found = slopes(points(40.0, lambda x: 1.0 + noise[min(AROUND, key=lambda s: abs(1 + s - x))]))["a"]
    assert found["slope"] == pytest.approx(0.0, abs=1e-12)
    assert found["scatter"] == pytest.approx((4e-4 / 3 / 0.025) ** 0.5, rel=1e-9)


def test_numbers_that_a_point_lacks_have_no_slope():
    some = points(40.0, lambda x: x)
    some[2]["results"] = {}
    assert slopes(some) == {}
