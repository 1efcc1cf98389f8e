"""Dense linear algebra against NumPy's."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense

SIZES = [(3, 3, 3), (5, 8, 4), (8, 5, 4), (30, 36, 25), (4, 4, 0)]  #: Rows, columns and rank.
ROUNDING = 1e-13  #: A hundred roundings and more: sums of 36 products, some ten sweeps of rotations.


def matrix(m: int, n: int, rank: int) -> FloatArray:
    """Return a matrix of a rank."""
    chance = np.random.default_rng(m + n)
    return np.asarray(chance.normal(size=(m, rank)) @ chance.normal(size=(rank, n)))


@pytest.mark.parametrize(("m", "n", "rank"), SIZES)
def test_singular_values(m: int, n: int, rank: int) -> None:
    a = matrix(m, n, rank)
    u, values, v = dense.svd(a)
    size = max(values[0], 1.0)
    k = min(m, n)
    assert (u.shape, values.shape, v.shape) == ((m, k), (k,), (n, n))
    assert values == pytest.approx(np.linalg.svd(a, compute_uv=False), abs=ROUNDING * size)
    assert (u * values) @ v[:k] == pytest.approx(a, abs=ROUNDING * size)
    assert v @ v.T == pytest.approx(np.eye(n), abs=ROUNDING)
    assert u[:, :rank].T @ u[:, :rank] == pytest.approx(np.eye(rank), abs=ROUNDING)
    assert a @ v[rank:].T == pytest.approx(0.0, abs=ROUNDING * size)


@pytest.mark.parametrize(("m", "n", "rank"), SIZES[:-1])
def test_least_squares(m: int, n: int, rank: int) -> None:
    a, b = matrix(m, n, rank), np.arange(1.0, m + 1.0)
    assert dense.lstsq(a, b) == pytest.approx(np.linalg.lstsq(a, b)[0], rel=1e-9, abs=1e-9)


def test_solutions_and_inverses() -> None:
    a = matrix(6, 6, 6)
    for right in (np.arange(6.0), np.arange(12.0).reshape(6, 2)):
        assert a @ dense.solve(a, right) == pytest.approx(right, abs=1e-10)
    assert a @ dense.inverse(a) == pytest.approx(np.eye(6), abs=1e-10)
    assert not np.isfinite(dense.solve(np.zeros((2, 2)), np.ones(2))).any()


def of_columns(a: FloatArray) -> FloatArray:
    """Return a matrix that is kept column by column and cannot be written to."""
    columns = np.asfortranarray(a)
    columns.flags.writeable = False
    return columns


def test_how_a_matrix_lies_in_memory_changes_no_bit() -> None:
    a = matrix(4, 4, 4)
    b = a @ a.T + np.eye(4)
    for function in (dense.inverse, dense.svd, dense.eigh, dense.cholesky, lambda m: dense.product(m, m)):
        np.testing.assert_array_equal(np.vstack(function(of_columns(b))), np.vstack(function(b)))
    for rows, columns in zip(dense.triangle(a, 4, 0.0), dense.triangle(of_columns(a), 4, 0.0), strict=True):
        np.testing.assert_array_equal(rows, columns)
    normals, across = dense.triangle(a, 4, 0.0)[2], np.asfortranarray(b)
    dense.reflect(of_columns(normals), across)
    dense.reflect(normals, b)
    np.testing.assert_array_equal(across, b)
