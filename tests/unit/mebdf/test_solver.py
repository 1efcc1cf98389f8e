"""The solver class in ``solve_ivp``: what SciPy documents for its own solver classes, in cases of our own."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import csc_matrix, csr_matrix

from mebdf import MEBDF


def swing(t, y):
    """Oscillator with y = (cos t, −sin t) from (1, 0)."""
    return np.array([y[1], -y[0]])


def tracking(t, y):
    """Stiff: both components are drawn to (cos t, sin t)."""
    return np.array([-500.0 * (y[0] - np.cos(t)) - np.sin(t), -500.0 * (y[1] - np.sin(t)) + np.cos(t)])


TRACKING_JACOBIAN = np.diag([-500.0, -500.0])


def solve(fun, t_span, y0, **options):
    return solve_ivp(fun, t_span, y0, method=MEBDF, **options)


@pytest.mark.parametrize("t_span", [(0.0, 6.0), (6.0, 0.0)])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_forward_and_backward_in_time(t_span, rtol):
    y0 = [np.cos(t_span[0]), -np.sin(t_span[0])]
    solution = solve(swing, t_span, y0, rtol=rtol, atol=rtol, dense_output=True)
    assert solution.success
    assert (solution.t[0], solution.t[-1]) == t_span
    for times, values in ((solution.t, solution.y), (t := np.linspace(0.0, 6.0, 101), solution.sol(t))):
        np.testing.assert_allclose(values, [np.cos(times), -np.sin(times)], atol=30.0 * rtol)


@pytest.mark.parametrize(
    "options",
    [
        {"jac": lambda t, y: TRACKING_JACOBIAN},
        {"jac": lambda t, y: csc_matrix(TRACKING_JACOBIAN)},
        {"jac": TRACKING_JACOBIAN},
        {"jac": csr_matrix(TRACKING_JACOBIAN)},
        {"jac": TRACKING_JACOBIAN.tolist()},
        {},
        {"jac_sparsity": np.eye(2)},
        {"jac_sparsity": csc_matrix(np.eye(2))},
    ],
)
def test_every_kind_of_jacobian(options):
    solution = solve(tracking, (0.0, 10.0), [1.0, 0.0], rtol=1e-6, atol=1e-8, **options)
    assert solution.success
    np.testing.assert_allclose(solution.y[:, -1], [np.cos(10.0), np.sin(10.0)], atol=1e-5)
    assert solution.nfev < 400  # an explicit method needs some 2500
    assert 0 < solution.njev <= solution.nlu


def test_vectorised_right_hand_side():
    shapes = set()

    def fun(t, y):
        shapes.add(y.shape[1:])
        return np.vstack((y[1], 5.0 * (1.0 - y[0] ** 2) * y[1] - y[0]))

    plain = solve(lambda t, y: fun(t, y[:, None]).ravel(), (0.0, 5.0), [2.0, 0.0])
    shapes.clear()
    vectorised = solve(fun, (0.0, 5.0), [2.0, 0.0], vectorized=True)
    np.testing.assert_array_equal(plain.y, vectorised.y)
    assert shapes == {(1,), (2,)}


def test_dense_output_is_continuous_and_meets_the_steps():
    solution = solve(tracking, (0.0, 3.0), [2.0, 0.0], rtol=1e-5, atol=1e-7, dense_output=True)
    np.testing.assert_allclose(solution.sol(solution.t), solution.y, rtol=1e-12, atol=1e-13)
    inner = solution.t[1:-1]
    gap = 1e-12
    np.testing.assert_allclose(solution.sol(inner - gap), solution.sol(inner + gap), atol=1e-7)
    assert solution.sol(1.5).shape == (2,)
    assert solution.sol([0.5, 1.5]).shape == (2, 2)


def test_largest_order():
    low = solve(swing, (0.0, 2.0), [1.0, 0.0], rtol=1e-8, atol=1e-8, max_order=2)
    high = solve(swing, (0.0, 2.0), [1.0, 0.0], rtol=1e-8, atol=1e-8)
    assert low.success
    assert low.t.size > 5 * high.t.size
    for wrong in (1, 9):
        with pytest.raises(ValueError, match="whole number from 2 to 8"):
            solve(swing, (0.0, 10.0), [1.0, 0.0], max_order=wrong)


@pytest.mark.parametrize("end", np.linspace(1e-3, 1e-2, 25))
def test_the_end_is_met_where_the_spacing_of_numbers_is_not_small_against_a_step(end):
    # Late and fast: steps of 1e-4, numbers 1e-13 apart.
    solution = solve(lambda t, y: [y[1], -1e6 * y[0]], (1e3, 1e3 + end), [1.0, 0.0], rtol=1e-6, atol=1e-9)
    assert solution.success, solution.message
    assert solution.t[-1] == 1e3 + end


def test_jacobians_are_rarer_where_they_cost_evaluations():
    def decay(t, y):
        return [-1e4 * y[0] * y[1] + y[1], 1e4 * y[0] * y[1] - y[1] - 30.0 * y[1] ** 2, 30.0 * y[1] ** 2]

    def jac(t, y):
        u, v = y[:2]
        return [
            [-1e4 * v, 1.0 - 1e4 * u, 0.0],
            [1e4 * v, 1e4 * u - 1.0 - 60.0 * v, 0.0],
            [0.0, 60.0 * v, 0.0],
        ]

    made = np.zeros(2)
    for rtol in np.geomspace(6e-7, 1.5e-6, 8):
        exact, differenced = (
            solve(decay, (0.0, 100.0), [1.0, 1e-3, 0.0], rtol=rtol, atol=1e-4 * rtol, jac=given)
            for given in (jac, None)
        )
        np.testing.assert_allclose(exact.y[:, -1], differenced.y[:, -1], rtol=1e-4, atol=1e-6)
        made += exact.njev, differenced.njev
    # 0.59 over 64 tolerances on two processors; over eight of them 0.57 to 0.62.
    assert made[1] < 0.7 * made[0]


def test_a_state_that_rests():
    solution = solve(lambda t, y: np.zeros(3), (0.0, 1e3), [1.0, -1.0, 0.0])
    assert solution.success
    np.testing.assert_array_equal(solution.y[:, -1], [1.0, -1.0, 0.0])
    assert solution.nfev < 100


@pytest.mark.parametrize("dtype", [np.float32, np.int64])
def test_other_kinds_of_numbers_become_double(dtype):
    y0 = np.array([1, 0], dtype=dtype)
    solution = solve(swing, (0.0, 1.0), y0, rtol=1e-9, atol=1e-11)
    assert solution.y.dtype == np.float64
    assert solution.y[0, -1] == pytest.approx(np.cos(1.0), abs=1e-7)
    np.testing.assert_array_equal(y0, np.array([1, 0], dtype=dtype))


def test_tolerances_below_rounding_are_raised():
    with pytest.warns(UserWarning, match="`rtol` is too small"):
        solution = solve(swing, (0.0, 1.0), [1.0, 0.0], rtol=1e-20, atol=1e-16)
    assert solution.success
    assert solution.y[0, -1] == pytest.approx(np.cos(1.0), abs=1e-11)


def test_an_absolute_tolerance_of_zero():
    solution = solve(lambda t, y: -y, (0.0, 50.0), [1.0], rtol=1e-8, atol=0.0)
    assert solution.y[0, -1] == pytest.approx(np.exp(-50.0), rel=1e-5)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_rate_that_stops_being_finite(value):
    solution = solve(lambda t, y: [y[1], -y[0] if t < 0.5 else value], (0.0, 1.0), [1.0, 0.0])
    assert not solution.success
    assert solution.status == -1
    assert "the rate of component 1 was not finite" in solution.message
    assert 0.4 < solution.t[-1] <= 0.5
    assert np.isfinite(solution.y).all()


def test_a_first_rate_that_is_not_finite():
    solution = solve(lambda t, y: [np.nan], (0.0, 1.0), [1.0])
    assert not solution.success
    assert "the rate of component 0 was not finite at t = 0" in solution.message


def test_a_pole():
    solution = solve(lambda t, y: y**2, (0.0, 2.0), [1.0], rtol=1e-6)
    assert not solution.success
    assert "component 0" in solution.message
    assert solution.t[-1] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("y0", "message"),
    [
        ([1.0 + 1.0j, 0.0], "complex"),
        ([[1.0, 0.0]], "1-dimensional"),
        ([np.nan, 0.0], "must be finite"),
        ([np.inf, 0.0], "must be finite"),
    ],
)
def test_states_that_are_refused(y0, message):
    with pytest.raises(ValueError, match=message):
        solve(swing, (0.0, 1.0), y0)


@pytest.mark.parametrize("jac", [np.eye(3), lambda t, y: np.eye(3)])
def test_a_jacobian_of_the_wrong_shape(jac):
    with pytest.raises(ValueError, match=r"`jac` is expected to have shape \(2, 2\)"):
        solve(swing, (0.0, 1.0), [1.0, 0.0], jac=jac)


def test_arguments_without_effect_are_told():
    with pytest.warns(UserWarning, match="no effect for a chosen solver: `shape`"):
        solve(swing, (0.0, 1.0), [1.0, 0.0], shape="round")


def test_many_equations():
    n = 60  # beyond the size up to which the inverse is kept
    x = np.arange(1, n + 1) / (n + 1)
    laplacian = (n + 1) ** 2 * (np.diag(np.full(n, -2.0)) + np.eye(n, k=1) + np.eye(n, k=-1))
    rate = 2.0 * (n + 1) ** 2 * (np.cos(np.pi / (n + 1)) - 1.0)
    solution = solve(
        lambda t, y: laplacian @ y, (0.0, 0.2), np.sin(np.pi * x), jac=laplacian, rtol=1e-7, atol=1e-9
    )
    np.testing.assert_allclose(solution.y[:, -1], np.exp(0.2 * rate) * np.sin(np.pi * x), atol=1e-6)
    assert solution.t.size < 100


def test_an_interval_of_a_few_roundings():
    solution = solve(lambda t, y: -y, (1.0, 1.0 + 1e-15), [1.0])
    assert solution.success
    assert solution.t[-1] == 1.0 + 1e-15


@pytest.mark.parametrize("span", [(0.0, np.nan), (np.nan, 1.0), (np.inf, 1.0)])
def test_times_that_are_no_numbers(span):
    with pytest.raises(ValueError, match="`t0` must be finite and `t_bound` a number"):
        MEBDF(swing, span[0], [1.0, 0.0], span[1])


def test_a_start_too_small_for_a_relative_tolerance():
    with pytest.raises(ValueError, match="`atol` must be positive for component 0"):
        solve(lambda t, y: -y, (0.0, 1.0), [1e-310], atol=0.0)


def test_a_start_just_large_enough_for_a_relative_tolerance():
    solution = solve(lambda t, y: -y, (0.0, 1.0), [1e-290], rtol=1e-6, atol=0.0)
    assert solution.y[0, -1] == pytest.approx(np.exp(-1.0) * 1e-290, rel=1e-5)


def falling(t, y):
    return [y[1], -1.0]


def ground(t, y):
    return y[0]


def test_events_backward_in_time():
    solution = solve(falling, (2.0, 0.0), [-1.0, -2.0], events=ground, rtol=1e-8, atol=1e-10)
    # y = 1 − t²/2 reaches 0 at √2
    np.testing.assert_allclose(solution.t_events[0], [np.sqrt(2.0)], atol=1e-7)


@pytest.mark.parametrize("span", [1e-4, 1.0, 1e6])
def test_nothing_is_evaluated_beyond_the_end(span):
    def fun(t, y):
        assert 0.0 <= t <= span
        return -y / span

    solution = solve(fun, (0.0, span), [1.0], rtol=1e-7, atol=1e-10)
    assert solution.y[0, -1] == pytest.approx(np.exp(-1.0), rel=1e-5)


def test_step_by_step():
    solver = MEBDF(swing, 0.0, [1.0, 0.0], 1.0)
    steps = 0
    while solver.status == "running":
        assert solver.step() is None
        assert solver.t_old < solver.t <= 1.0
        assert solver.dense_output()(solver.t) == pytest.approx(solver.y)
        steps += 1
    assert solver.status == "finished"
    assert steps > 3
    with pytest.raises(RuntimeError):
        solver.step()
