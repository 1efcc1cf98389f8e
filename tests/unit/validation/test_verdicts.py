"""Verdicts, uncertainties and E by their definitions."""

import math

import numpy as np
import pytest

from tribodyn.validation.base import Band, Comparison, Verdict
from tribodyn.validation.catalogue import Input, varied
from tribodyn.validation.report import with_width


def _band(**limits: object) -> Band:
    return Band("some", "line", **limits)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("band", "computed", "measured", "verdict"),
    [
        (_band(relative=0.2), 119.9, 100.0, Verdict.WITHIN),
        (_band(relative=0.2), 120.1, 100.0, Verdict.OUTSIDE),
        (_band(absolute=0.02), 0.52, 0.5, Verdict.WITHIN),
        (_band(absolute=0.02), 0.479, 0.5, Verdict.OUTSIDE),
        (_band(at_least=1.0, at_most=1.57), 1.3, None, Verdict.WITHIN),
        (_band(at_least=1.0, at_most=1.57), 0.99, None, Verdict.OUTSIDE),
        (_band(at_most=6.0), -1e9, None, Verdict.WITHIN),
        (_band(must_exceed=0.05), 0.56, 0.5, Verdict.WITHIN),
        (_band(must_exceed=0.05), 0.44, 0.5, Verdict.WITHIN),
        (_band(must_exceed=0.05), 0.54, 0.5, Verdict.OUTSIDE),
        (_band(at_most=6.0), math.nan, None, Verdict.OUTSIDE),
        (None, 1.0, 2.0, Verdict.REPORTED),
    ],
)
def test_verdict(band: Band | None, computed: float, measured: float | None, verdict: Verdict) -> None:
    assert Comparison("x", "", computed, measured, band=band).verdict is verdict


@pytest.mark.parametrize(
    ("spread", "band", "verdict"),
    [
        ((90.0, 119.0), _band(relative=0.2), Verdict.WITHIN),
        ((79.0, 119.0), _band(relative=0.2), Verdict.OUTSIDE),
        ((0.1, 0.2), _band(covers=(0.12, 0.19)), Verdict.WITHIN),
        ((0.13, 0.2), _band(covers=(0.12, 0.19)), Verdict.OUTSIDE),
        ((94.0, 106.0), _band(must_exceed=5.0), Verdict.OUTSIDE),
        ((106.0, 108.0), _band(must_exceed=5.0), Verdict.WITHIN),
    ],
)
def test_a_range_is_judged_as_a_whole(spread: tuple[float, float], band: Band, verdict: Verdict) -> None:
    row = Comparison("x", "", 100.0, 100.0, spread=spread, band=band)
    assert row.verdict is verdict


def test_e_is_the_difference_over_both_uncertainties() -> None:
    assert Comparison("x", "", 13.0, 8.0, u_computed=3.0, u_measured=4.0).error == 1.0
    assert Comparison("x", "", 13.0, 8.0).error is None
    assert Comparison("x", "", 13.0, None, u_computed=1.0).error is None


def test_e_takes_the_side_of_the_measured_value() -> None:
    """Inputs that only lower a value do not explain a measured value above it."""
    assert Comparison("x", "", 10.0, 7.0, u_computed=(3.0, 0.0)).error == 1.0
    assert Comparison("x", "", 10.0, 13.0, u_computed=(3.0, 0.0)).error == math.inf
    assert Comparison("x", "", 10.0, 13.0, u_computed=(9.0, 0.0), u_measured=1.0).error == 3.0
    assert Comparison("x", "", 10.0, 10.0, u_computed=(9.0, 0.0)).error == 0.0
    only_lower = varied(lambda x: np.array([8.0 - x["a"] ** 2]), [_input("a", 0.0, -1.0, 2.0)])
    assert only_lower.sides_at(0) == (4.0, 0.0)


@pytest.mark.parametrize(
    ("null", "band", "within"),
    [
        (1.0, _band(relative=0.1), True),
        (1.2, _band(relative=0.1), False),
        (None, _band(relative=0.1), None),
        (1.0, None, None),
        (1.0, _band(covers=(0.9, 1.1)), None),
    ],
)
def test_what_the_null_model_does(null: float | None, band: Band | None, within: bool | None) -> None:
    assert Comparison("x", "", 1.0, 1.0, null=null, band=band).null_within is within


def test_both_sides_are_printed_where_they_differ() -> None:
    assert with_width(1.0, (0.1, 0.1)) == "1 ± 0.1"
    assert with_width(1.0, (0.25, 0.0)) == "1 −0.25 +0"
    assert with_width(1.0, (0.0, 0.0)) == "1"
    assert with_width(None, (0.0, 0.0)) == "-"


def _input(name: str, value: float, low: float, high: float) -> Input:
    return Input(name, value, low, high, str(value), "", "for a test")


def test_sides_are_the_roots_of_the_sums_of_squares_of_the_largest_changes_apart() -> None:
    inputs = [_input("a", 1.0, 0.5, 4.0), _input("b", 2.0, -2.0, 6.0), _input("c", 7.0, 7.0, 7.0)]
    result = varied(lambda x: np.array([x["a"] + x["b"], x["a"] * x["c"]]), inputs)
    assert result.values.tolist() == [3.0, 7.0]
    np.testing.assert_allclose(result.sides, [[math.hypot(0.5, 4.0), 3.5], [5.0, 21.0]])
    assert result.sides_at(1) == (3.5, 21.0)
    np.testing.assert_allclose(result.spread("a"), [[2.5, 3.5], [6.0, 28.0]])
    assert set(result.ends) == {"a", "b"}
