"""A Jacobian that does not belong to the right-hand side is found out before it costs much."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mebdf import MEBDF


def robertson(t, y):
    first, second, third = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
    return np.array([second - first, first - second - third, third])


def slopes_of_robertson(t, y):
    first, last = np.array([0.04, 0.0, 0.0]), np.array([0.0, 6e7 * y[1], 0.0])
    second = np.array([0.0, 1e4 * y[2], 1e4 * y[1]])
    return np.array([second - first, first - second - last, last])


def van_der_pol(t, y):
    return np.array([y[1], 100.0 * (1.0 - y[0] ** 2) * y[1] - y[0]])


def slopes_of_van_der_pol(t, y):
    return np.array([[0.0, 1.0], [-200.0 * y[0] * y[1] - 1.0, 100.0 * (1.0 - y[0] ** 2)]])


PROBLEMS = {
    "Robertson": (robertson, slopes_of_robertson, [1.0, 0.0, 0.0], 40.0),
    "Van der Pol": (van_der_pol, slopes_of_van_der_pol, [2.0, 0.0], 20.0),
}


def solved(name, factor, **options):
    fun, jac, y0, t_end = PROBLEMS[name]
    return solve_ivp(
        fun, (0.0, t_end), y0, method=MEBDF, atol=1e-8, jac=lambda t, y: factor * jac(t, y), **options
    )


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("factor", [-1.0, 0.0, 1e6, 1e-6])
def test_a_wrong_jacobian_is_told_and_replaced(name, factor):
    right = solved(name, 1.0)
    with pytest.warns(RuntimeWarning, match="`jac` is not the derivative of `fun` at t = "):
        solution = solved(name, factor)
    assert solution.success
    assert np.allclose(solution.y[:, -1], right.y[:, -1], rtol=1e-2)
    # With it all the way, both would take some hundred thousand calls.
    assert solution.nfev < 2 * right.nfev


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("factor", [1.0, 1.3, 0.7])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_a_jacobian_that_serves_is_left_alone(name, factor, rtol):
    assert solved(name, factor, rtol=rtol).success  # a warning would be an error


def wrong_later(factor):
    fun, jac, y0, t_end = PROBLEMS["Robertson"]
    return solve_ivp(
        fun, (0.0, t_end), y0, method=MEBDF, jac=lambda t, y: (1.0 if t < 0.1 else factor) * jac(t, y)
    )


def test_a_jacobian_that_goes_wrong_later_is_found_out():
    with pytest.warns(RuntimeWarning, match="`jac` is not the derivative of `fun` at t = "):
        solution = wrong_later(1e3)
    assert solution.success
    assert solution.nfev < 2000


def test_stages_are_solved_without_a_jacobian_if_need_be():
    solution = wrong_later(0.0)
    assert solution.success
    assert np.allclose(solution.y[:, -1], solved("Robertson", 1.0).y[:, -1], rtol=1e-2)
    assert solution.nfev < 2000


def test_a_jacobian_that_changes_its_sign_is_left_for_the_last_right_one():
    # What grows faster than the step by a Jacobian is reason enough not to use it: 112 calls.
    solution = wrong_later(-1.0)
    assert solution.success
    assert np.allclose(solution.y[:, -1], solved("Robertson", 1.0).y[:, -1], rtol=1e-2)
    assert solution.nfev < 500


def test_rounding_is_no_doubt():
    solution = solve_ivp(lambda t, y: 5.0 + 1e-6 * y, (0.0, 1.0), [0.0], method=MEBDF, jac=[[1e-6]])
    assert solution.y[0, -1] == pytest.approx(5.0, rel=1e-3)


def test_a_jacobian_beside_a_kink_is_left_alone():
    solution = solve_ivp(
        lambda t, y: -1e4 * np.maximum(y, 0.0) - 1.0,
        (0.0, 1.0), [1.0], method=MEBDF, jac=lambda t, y: np.diag(-1e4 * (y > 0.0)),
    )  # fmt: skip
    assert solution.success
    assert solution.y[0, -1] == pytest.approx(-1.0 + 1e-4 * np.log(1e4), abs=2e-3)
