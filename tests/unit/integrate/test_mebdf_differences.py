"""Differences by groups of columns: those of SciPy's own solvers, entry by entry and call by call."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate._ivp.common import num_jac
from scipy.optimize._numdiff import group_columns
from scipy.sparse import csc_array, csc_matrix, random_array

from tribodyn.integrate.mebdf_differences import GroupedDifferences

N = 90
SMALL = 1e-9


def matrix(rng, density):
    """A random one with entries of all sizes and something in each column."""
    found = random_array(
        (N, N), density=density, rng=rng, data_sampler=lambda size: 10.0 ** rng.normal(size=size)
    )
    return csc_array(found + csc_array((np.ones(N), (rng.permutation(N), np.arange(N))), shape=(N, N)))


class Counted:
    """A right-hand side, cubic with an offset in whose rounding some columns are lost at first."""

    def __init__(self, of, offset):
        self.of, self.offset, self.calls = of, offset, 0

    def __call__(self, states):
        self.calls += states.shape[1]
        return self.of @ (states + states**3) + self.offset

    def at(self, y):
        return self.of @ (y + y**3) + self.offset


@pytest.mark.parametrize("offset", [0.0, -1e6, 1e9])
@pytest.mark.parametrize("density", [0.01, 0.1])
def test_they_are_those_of_scipy(density, offset):
    rng = np.random.default_rng(7)
    of = matrix(rng, density)
    ours, theirs = Counted(of, offset), Counted(of, offset)
    typical = np.full(N, SMALL)
    pattern = csc_matrix(of)
    differences, grouped = GroupedDifferences(of, typical), (pattern, group_columns(pattern))
    factor = None
    for y in rng.normal(size=(4, N)) * 10.0 ** rng.integers(-6, 3, size=(4, N)):
        f = ours.at(y)
        found = differences(ours, y, f)
        expected, factor = num_jac(lambda t, states: theirs(states), 0.0, y, f, typical, factor, grouped)
        # The same moves: no more than the rounding of divisions.
        np.testing.assert_allclose(found.toarray(), expected.toarray(), rtol=1e-12, atol=0.0)
        assert ours.calls == theirs.calls
    # Columns that are lost in rounding were moved further, too.
    assert ours.calls > 4 * differences.evaluations or offset < 1e9


def test_an_empty_column_costs_nothing():
    of = csc_array(([2.0, 3.0], ([0, 2], [0, 2])), shape=(3, 3))
    rates = Counted(of, 0.0)
    y = np.array([1.0, 1.0, 0.0])
    found = GroupedDifferences(of, np.full(3, SMALL))(rates, y, rates.at(y))
    np.testing.assert_allclose(found.toarray(), np.diag([8.0, 0.0, 3.0]), rtol=1e-6)
    assert rates.calls == 1


def test_a_rate_that_is_no_number_leaves_the_other_columns():
    of = csc_array(np.diag([1.0, 2.0, 3.0]))

    def broken(states):
        rates = of @ states
        rates[1] = np.nan
        return rates

    differences = GroupedDifferences(of, np.full(3, SMALL))
    y = np.array([1.0, 2.0, -1.0])
    for _ in range(2):
        found = differences(broken, y, of @ y).toarray()
        np.testing.assert_allclose(found.diagonal(), [1.0, np.nan, 3.0], rtol=1e-6)


def test_a_variable_that_swallows_its_move_is_moved_further():
    of = csc_array(np.eye(2))
    y = np.array([1e300, 0.0])
    found = GroupedDifferences(of, np.array([SMALL, 1e-320]))(lambda states: of @ states, y, y)
    np.testing.assert_allclose(found.diagonal(), 1.0, rtol=1e-6)
