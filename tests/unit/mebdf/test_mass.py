"""Mass matrices in the solver class: their forms, the index, consistent starts, breakpoints, failures."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import csr_array, diags_array

sys.path.insert(0, str(Path(__file__).parents[3]))
from benchmarks.solver.dae_problems import pendulum, transistor
from mebdf import MEBDF

RATES = np.array([[-2.0, 1.0], [1.0, -3.0]])
MASS = np.array([[2.0, 1.0], [1.0, 3.0]])


def solve(fun, t_span, y0, **options):
    return solve_ivp(fun, t_span, y0, method=MEBDF, **options)


def linear(t, y):
    return RATES @ y


@pytest.mark.parametrize("mass", [MASS, csr_array(MASS), MASS.tolist()])
@pytest.mark.parametrize("jac", [None, RATES])
def test_a_regular_mass_matrix(mass, jac):
    solution = solve(linear, (0.0, 2.0), [1.0, -1.0], mass=mass, jac=jac, rtol=1e-7, atol=1e-9)
    values, vectors = np.linalg.eig(np.linalg.solve(MASS, RATES))
    exact = vectors @ (np.exp(2.0 * values) * np.linalg.solve(vectors, [1.0, -1.0]))
    np.testing.assert_allclose(solution.y[:, -1], exact, atol=1e-6)


def robertson(t, y):
    slow, fast, last = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
    return [-slow + fast, slow - fast - last, y[0] + y[1] + y[2] - 1.0]


ROBERTSON_END = [0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050]


@pytest.mark.parametrize("mass", [[1.0, 1.0, 0.0], np.diag([1.0, 1.0, 0.0]), diags_array([1.0, 1.0, 0.0])])
def test_robertson_with_its_sum_as_an_equation(mass):
    atol = [1e-13, 1e-18, 1e-7]
    solution = solve(robertson, (0.0, 1e11), [1.0, 0.0, 0.0], mass=mass, rtol=1e-7, atol=atol)
    assert solution.success
    np.testing.assert_allclose(solution.y[:, -1], ROBERTSON_END, rtol=1e-4)  # IVP Test Set
    np.testing.assert_allclose(solution.y.sum(axis=0), 1.0, atol=1e-9)


@pytest.mark.parametrize("index", [1, 2, 3])
def test_the_pendulum_at_every_index(index):
    problem = pendulum(index)
    options = {"mass": problem.mass, "index": problem.index, "rtol": 1e-7, "atol": 1e-7}
    solution = solve(problem.fun, (0.0, 1.0), problem.y0, dense_output=True, **options)
    assert solution.success
    # The published runs at this tolerance have 8.3, 7.5 and 4.9 digits.
    assert problem.digits(solution.y[:, -1]) > 4.5
    x, y = solution.sol(np.linspace(0.0, 1.0, 50))[:2]
    np.testing.assert_allclose(x * x + y * y, 1.0, atol=1e-6)


@pytest.mark.parametrize("n", [30, 90])
def test_sparse_and_dense_matrices_with_algebraic_equations(n):
    """A chain whose odd values are the mean of their neighbours; 90 equations are solved outside the core."""
    diffusion = csr_array(
        30.0 * diags_array([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], offsets=[-1, 0, 1])
    )
    mass = (np.arange(n) % 2 == 0).astype(float)
    y0 = np.sin(np.pi * np.arange(1, n + 1) / (n + 1)) / np.cos(np.pi / (n + 1)) ** (1.0 - mass) ** 2
    y0[1::2] = 0.5 * (y0[::2] + np.append(y0[2::2], 0.0))[: n // 2]
    given = [
        {"jac": diffusion.toarray()},
        {"jac": diffusion},
        {"jac_sparsity": diffusion},
        {"lband": 1, "uband": 1},
        {},
    ]
    runs = [
        solve(lambda t, y: diffusion @ y, (0.0, 1.0), y0, mass=mass, rtol=1e-6, atol=1e-9, **o) for o in given
    ]
    for run in runs:
        assert run.success, run.message
        np.testing.assert_allclose(run.y[:, -1], runs[0].y[:, -1], rtol=1e-4, atol=1e-7)
        middle = run.y[1:-1:2]
        np.testing.assert_allclose(middle, 0.5 * (run.y[:-2:2] + run.y[2::2])[: len(middle)], atol=1e-6)


def test_a_mass_matrix_singular_without_rows_of_zeros():
    problem = transistor()
    solution = solve(problem.fun, (0.0, 0.2), problem.y0, mass=problem.mass, rtol=1e-5, atol=1e-5)
    assert solution.success
    assert problem.digits(solution.y[:, -1]) > 4.0  # the published run at this tolerance has 5.3


@pytest.mark.parametrize("index", [2, 3])
def test_multipliers_are_found_by_differentiation(index):
    problem = pendulum(index)
    y0 = [1.0, 0.0, 0.0, 1.0, 0.0]
    with pytest.warns(UserWarning, match="changed component 4 from 0"):
        solver = MEBDF(problem.fun, 0.0, y0, 1.0, mass=problem.mass, index=problem.index)
    assert solver.y[4] == pytest.approx(1.0, abs=1e-4)  # by second differences


@pytest.mark.parametrize(
    ("y0", "message"),
    [
        (
            [1.1, 0.0, 0.0, 1.0, 1.0],
            r"not consistent: equation 4 does not hold; it would with component 0 = 1\.0",
        ),
        ([1.0, 0.0, 0.1, 1.0, 1.0], "not consistent: the first derivative of equation 4 does not hold"),
    ],
)
def test_values_that_break_constraints_are_refused(y0, message):
    problem = pendulum(3)
    with pytest.raises(ValueError, match=message):
        MEBDF(problem.fun, 0.0, y0, 1.0, mass=problem.mass, index=problem.index)


def test_an_index_that_is_too_low_is_told():
    problem = pendulum(3)
    with pytest.raises(ValueError, match="the index is above 1; give `index`"):
        MEBDF(problem.fun, 0.0, problem.y0, 1.0, mass=problem.mass)


def test_equations_that_determine_nothing_are_told():
    with pytest.raises(ValueError, match="Equation 1 holds no algebraic variable"):
        solve(lambda t, y: [-y[0], 0.0 * y[0]], (0.0, 1.0), [1.0, 0.0], mass=[1.0, 0.0])


def test_an_algebraic_variable_with_a_pole():
    solution = solve(lambda t, y: [1.0, (0.5 - t) * y[1] - 1.0], (0.0, 1.0), [0.0, 2.0], mass=[1.0, 0.0])
    assert not solution.success
    assert "component 1" in solution.message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mass": np.eye(3)}, r"`mass` is expected to have shape \(2, 2\) or \(2,\), not \(3, 3\)"),
        ({"mass": [1.0, np.nan]}, "`mass` must be finite"),
        ({"mass": [1.0, 1j]}, "`mass` must be real"),
        ({"index": [1, 1]}, "need a `mass` matrix"),
        ({"mass": [1.0, 1.0], "index": [1]}, r"`index` is expected to have shape \(2,\)"),
        ({"mass": [1.0, 1.0], "index": [1, 4]}, "whole numbers from 1 to 3"),
        ({"breakpoints": [np.nan]}, "`breakpoints` must be numbers"),
    ],
)
def test_what_is_refused(options, message):
    with pytest.raises(ValueError, match=message):
        solve(linear, (0.0, 1.0), [1.0, 0.0], **options)


@pytest.mark.parametrize("t_span", [(0.0, 2.0), (2.0, 0.0)])
def test_a_jump_at_a_breakpoint(t_span):
    seen = []

    def jump(t, y):
        seen.append(t)
        return [1.0 if t < 1.0 else -1.0]

    solution = solve(jump, t_span, [0.0], breakpoints=[1.0, 5.0], rtol=1e-8, atol=1e-8)
    assert solution.y[0, -1] == pytest.approx(0.0, abs=1e-12)
    assert 1.0 in solution.t
    assert solution.t.size < 40  # without the breakpoint the step shrinks to find the jump


def test_algebraic_variables_jump_at_a_breakpoint():
    """A source that steps: the current through the resistor follows at once."""

    def circuit(t, y):
        source = 1.0 if t < 1.0 else 3.0
        return [y[1], source - y[0] - y[1]]

    with pytest.warns(UserWarning, match="changed component 1"):
        solution = solve(
            circuit, (0.0, 2.0), [0.0, 1.0], mass=[1.0, 0.0], breakpoints=[1.0], rtol=1e-8, atol=1e-10
        )
    before = 1.0 - np.exp(-1.0)
    assert solution.y[0, -1] == pytest.approx(3.0 + (before - 3.0) * np.exp(-1.0), abs=1e-6)


@pytest.mark.filterwarnings("ignore:`jac` is not the derivative of `fun`")
@pytest.mark.parametrize("index", [1, 2, 3])
@pytest.mark.parametrize("factor", [1e6, 10.0, 0.1, -1.0, 0.0])
@pytest.mark.parametrize("rows", [slice(None), slice(4, None)])
def test_a_wrong_jacobian_never_costs_digits(index, factor, rows):
    problem = pendulum(index)

    def wrong(t, y):
        jacobian = problem.jac(t, y)
        jacobian[rows] *= factor
        return jacobian

    options = {"mass": problem.mass, "index": problem.index, "rtol": 1e-5, "atol": 1e-5}
    solution = solve(problem.fun, (0.0, 0.1), problem.y0, jac=wrong, **options)
    right = solve(
        problem.fun, (0.0, 0.1), problem.y0, jac=problem.jac, **{**options, "rtol": 1e-9, "atol": 1e-9}
    )
    assert right.success
    if solution.success:
        np.testing.assert_allclose(solution.y[:4, -1], right.y[:4, -1], atol=1e-4)
    else:
        assert "component" in solution.message


@pytest.mark.parametrize("value", [[1.0], [1.0, 2.0, 3.0], None])
def test_a_right_hand_side_of_the_wrong_shape(value):
    with pytest.raises(
        ValueError, match=r"`fun` is expected to return shape \(2,\), but returned .* at t = 0\."
    ):
        solve(lambda t, y: value, (0.0, 1.0), [1.0, 0.0])


@pytest.mark.parametrize("options", [{"mass": [1.0, 0.0]}, {"slope": [-1.0, 0.0]}])
def test_an_algebraic_value_that_jumps_names_the_cure(options):
    def fun(t, y, slope=(0.0, 0.0)):
        rate = slope[0] + 1.0 if "slope" in options else -1.0
        return [rate, y[1] - np.sign(y[0])]

    solution = solve(fun, (0.0, 2.0), [1.0, 1.0], **options)
    assert not solution.success
    assert solution.message.endswith(
        "if component 1 jumps, `test_algebraic=False` leaves it out of the error test"
    )
    if "mass" in options:
        assert solve(fun, (0.0, 2.0), [1.0, 1.0], test_algebraic=False, **options).success


def test_the_unit_matrix_changes_next_to_nothing():
    runs = [solve(linear, (0.0, 2.0), [1.0, -1.0], rtol=1e-7, atol=1e-9, mass=m) for m in (None, [1.0, 1.0])]
    np.testing.assert_allclose(runs[0].y[:, -1], runs[1].y[:, -1], atol=1e-6)


def test_algebraic_variables_are_found_and_told():
    problem = pendulum(1)
    y0 = [1.0, 0.0, 0.0, 1.0, 0.0]
    with pytest.warns(UserWarning, match=r"not consistent; changed component 4 from 0 to 1\."):
        solver = MEBDF(problem.fun, 0.0, y0, 1.0, mass=problem.mass)
    assert solver.y[4] == pytest.approx(1.0)


def test_events_and_output_times_of_a_pendulum():
    problem = pendulum(2)

    def lowest(t, y):
        return y[0] - 0.99

    solution = solve(
        problem.fun, (0.0, 1.0), problem.y0, mass=problem.mass, index=problem.index, rtol=1e-8, atol=1e-8,
        events=lowest, t_eval=[0.0, 0.5, 1.0],
    )  # fmt: skip
    assert solution.y_events[0][0][0] == pytest.approx(0.99, abs=1e-6)
    assert solution.t.tolist() == [0.0, 0.5, 1.0]
    assert problem.digits(solution.y[:, -1]) > 6.0
