"""Sparse, banded and large dense Newton matrices of the solver class: all solve one chain alike."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import coo_array, csc_array, csr_matrix, diags_array

from mebdf import MEBDF
from mebdf.algebra import by_bands

N = 80  #: More equations than the compiled core solves for.
RATE = 400.0
LAPLACIAN = csr_matrix(
    RATE * diags_array([np.ones(N - 1), np.full(N, -2.0), np.ones(N - 1)], offsets=[-1, 0, 1])
)
START = np.sin(np.pi * np.arange(1, N + 1) / (N + 1))


def chain(t, y):
    """Diffusion with a cubic sink; the first value feeds the last one, which no narrow band holds."""
    return LAPLACIAN @ y - y**3


def slope(t, y):
    return csc_array(LAPLACIAN - diags_array(3.0 * y**2))


def diagonals(t, y):
    packed = np.full((3, N), RATE)
    packed[1] = -2.0 * RATE - 3.0 * y**2
    return packed


def shortcut(t, y):
    """Far from a band."""
    return chain(t, y) - np.append(0.0, np.full(N - 1, y[0]))


SHORTCUT = csc_array(LAPLACIAN != 0) + csc_array(([1.0] * N, (range(N), [0] * N)), shape=(N, N))


def solve(fun, **options):
    return solve_ivp(fun, (0.0, 0.3), START, method=MEBDF, rtol=1e-6, atol=1e-8, **options)


@pytest.mark.parametrize(
    "options",
    [
        {"jac": slope},
        {"jac": lambda t, y: slope(t, y).toarray()},
        {"jac": diagonals, "lband": 1, "uband": 1},
        {"jac_sparsity": LAPLACIAN},
        {"lband": 1, "uband": 1},
        {"lband": 3, "uband": 2},
        {},
    ],
)
def test_every_kind_of_matrix_gives_one_solution(options):
    reference = solve_ivp(chain, (0.0, 0.3), START, method="Radau", rtol=1e-9, atol=1e-11, jac=slope)
    solution = solve(chain, **options)
    assert solution.success
    # Some fifty steps, each within 1e-6 of it.
    np.testing.assert_allclose(solution.y[:, -1], reference.y[:, -1], rtol=3e-5)


def test_a_pattern_that_is_no_band():
    solution = solve(shortcut, jac_sparsity=SHORTCUT)
    dense = solve(shortcut)
    assert solution.success
    np.testing.assert_allclose(solution.y[:, -1], dense.y[:, -1], rtol=3e-5, atol=1e-7)


def test_differences_by_groups_cost_a_call_a_group():
    calls = []

    def counted(t, y):
        calls.append(t)
        return chain(t, y)

    grouped = solve(counted, jac_sparsity=LAPLACIAN)
    differences = len(calls) - grouped.nfev
    assert 0 < differences <= 10 * grouped.njev  # three columns instead of eighty, some of them twice
    calls.clear()
    full = LAPLACIAN.tocoo()
    full = coo_array(
        (np.append(full.data, np.zeros(N)), (np.append(full.row, range(N)), np.append(full.col, [0] * N)))
    )
    assert solve(counted, jac_sparsity=full).njev == grouped.njev
    assert len(calls) - grouped.nfev == differences  # zeros that are stored are zeros
    calls.clear()
    single = solve(counted)
    assert len(calls) - single.nfev >= N * single.njev
    assert single.njev < grouped.njev  # they cost more, so fewer are taken


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"jac_sparsity": np.eye(3)}, r"`jac_sparsity` is expected to have shape \(80, 80\), but"),
        ({"lband": -1}, "`lband` must be a whole number from 0 to 79, not -1"),
        ({"uband": 80}, "`uband` must be a whole number from 0 to 79, not 80"),
        ({"lband": 1, "jac_sparsity": LAPLACIAN}, "Give either `jac_sparsity` or `lband` and `uband`"),
        ({"jac": slope, "lband": 1, "uband": 1}, r"`jac` is expected to have shape \(3, 80\)"),
        ({"jac": lambda t, y: slope(t, y)[:3]}, r"`jac` is expected to have shape \(80, 80\)"),
    ],
)
def test_wrong_shapes_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        solve(chain, **options)


@pytest.mark.parametrize("n", [3, N])
def test_bands_of_few_and_of_many_equations(n):
    solution = solve_ivp(
        lambda t, y: -np.arange(1.0, n + 1) * y,
        (0.0, 1.0),
        np.ones(n),
        method=MEBDF,
        rtol=1e-7,
        atol=1e-9,
        jac=lambda t, y: -np.arange(1.0, n + 1)[None, :],
        lband=0,
    )
    np.testing.assert_allclose(solution.y[:, -1], np.exp(-np.arange(1.0, n + 1)), atol=1e-6)


@pytest.mark.parametrize(
    "options",
    [{"jac": slope}, {"jac": lambda t, y: slope(t, y).toarray()}, {"jac": diagonals, "lband": 1, "uband": 1}],
)
def test_a_jacobian_that_is_not_finite_is_told_by_its_entry(options):
    given = options["jac"]

    def broken(t, y):
        value = given(t, y)
        value[1, 1] = np.nan  # of the diagonals: the second on the main one
        return value

    solution = solve(chain, **{**options, "jac": broken})
    assert "d(rate of component 1)/d(component 1) is not finite" in solution.message


@pytest.mark.parametrize(("lower", "upper"), [(0, 0), (1, 1), (2, 2), (3, 1), (0, 2), (2, 0)])
@pytest.mark.parametrize("diagonal", [1e-3, 20.0])
def test_bands_with_and_without_exchanges_of_rows(lower, upper, diagonal):
    rng = np.random.default_rng(3)
    offsets = range(-lower, upper + 1)
    matrix = diags_array(
        [rng.uniform(1.0, 2.0, N - abs(k)) for k in offsets], offsets=list(offsets)
    ).toarray()
    matrix[np.diag_indices(N)] *= diagonal
    packed = np.zeros((2 * lower + upper + 1, N))
    for row, column in zip(*np.nonzero(matrix), strict=True):
        packed[lower + upper + row - column, column] = matrix[row, column]
    known = rng.normal(size=N)
    solve, sign = by_bands(packed, lower, upper)
    solution = solve(known)
    if np.linalg.cond(matrix) < 1e12:
        assert sign == np.linalg.slogdet(matrix)[0]
    # Gauss's elimination with exchanges of rows is stable: rounding in each of at most seven diagonals.
    assert np.max(np.abs(matrix @ solution - known)) < 1e-13 * np.max(np.abs(matrix) @ np.abs(solution))


def test_entries_given_twice_count_twice_and_stay():
    twice = csc_array(
        (np.full(2 * N, -1.0), np.repeat(np.arange(N), 2), np.arange(0, 2 * N + 1, 2)), shape=(N, N)
    )
    span = (0.0, 1.0)
    solution = solve_ivp(
        lambda t, y: -2.0 * y, span, np.ones(N), method=MEBDF, rtol=1e-6, jac=lambda t, y: twice
    )
    single = solve_ivp(
        lambda t, y: -2.0 * y, span, np.ones(N), method=MEBDF, rtol=1e-6, jac=csc_array(-2.0 * np.eye(N))
    )
    assert solution.nfev == single.nfev
    assert twice.nnz == 2 * N
