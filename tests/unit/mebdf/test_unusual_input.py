"""Functions that write into their arguments, tolerances of 0 and infinity, and times without end."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mebdf import MEBDF


def decay(t, y):
    return -y


def overwriting(t, y):
    y *= -1.0
    return y


def overwriting_residual(t, y, slope):
    y += slope
    return y


def overwriting_jacobian(t, y):
    y *= 0.0
    return -np.eye(y.size)


@pytest.mark.parametrize(
    ("fun", "n", "options"),
    [
        (overwriting, 1, {}),
        (overwriting, 2, {"vectorized": True}),
        (overwriting, 70, {}),
        (overwriting, 2, {"jac_sparsity": np.eye(2)}),
        (overwriting, 1, {"mass": [1.0]}),
        (decay, 1, {"jac": overwriting_jacobian}),
        (overwriting_residual, 1, {"slope": [-1.0]}),
        (
            overwriting_residual,
            1,
            {"slope": [-1.0], "jac": lambda t, y, slope: (overwriting_jacobian(t, y) + 2.0, [[1.0]])},
        ),
    ],
)
def test_a_function_may_write_into_the_state(fun, n, options):
    # It took some three hundred calls, or was wrong.
    solution = solve_ivp(fun, (0.0, 1.0), np.ones(n), method=MEBDF, **options)
    np.testing.assert_allclose(solution.y[:, -1], np.exp(-1.0), rtol=2e-3)
    assert solution.nfev < 50


def chain(t, y):
    return np.array([-y[0] * y[1], y[0] * y[1]])


@pytest.mark.parametrize(
    ("fun", "options", "end"),
    [
        (chain, {}, [0.0, 2.0]),
        (lambda t, y: [-y[0], y[0] - y[1]], {"mass": [1.0, 0.0]}, [np.exp(-10.0)] * 2),
        (lambda t, y, slope: [slope[0] + y[0], y[0] - y[1]], {"slope": [-1.0, 0.0]}, [np.exp(-10.0)] * 2),
    ],
)
def test_a_component_whose_error_does_not_matter(fun, options, end):
    solution = solve_ivp(
        fun, (0.0, 10.0), [1.0, 1.0], method=MEBDF, rtol=1e-8, atol=[1e-6, np.inf], **options
    )
    assert solution.success
    np.testing.assert_allclose(solution.y[:, -1], end, atol=1e-5)


def test_no_error_matters():
    solution = solve_ivp(decay, (0.0, 1.0), np.ones(70), method=MEBDF, atol=np.inf)
    assert solution.success


def test_a_component_that_rests_at_zero_without_an_absolute_tolerance():
    solution = solve_ivp(decay, (0.0, 1.0), [0.0, 1.0], method=MEBDF, atol=0.0)
    assert solution.success
    assert solution.y[0, -1] == 0.0
    assert solution.y[1, -1] == pytest.approx(np.exp(-1.0), rel=2e-3)


def test_a_component_that_leaves_zero_without_an_absolute_tolerance_names_it():
    solution = solve_ivp(lambda t, y: 1.0 - y, (0.0, 1.0), [0.5, 0.0], method=MEBDF, atol=0.0)
    assert not solution.success
    assert "component 1 is 0" in solution.message
    assert "give it an absolute one" in solution.message


def test_an_end_that_never_comes():
    solution = solve_ivp(decay, (0.0, np.inf), [1.0], method=MEBDF)
    assert not solution.success
    assert "give a finite end" in solution.message
