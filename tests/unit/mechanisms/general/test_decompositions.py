"""Large matrices of a mechanism: elimination finds what singular values would, or is not used."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.mechanisms.general.decompositions import LARGE, complement, has_full_rank, pseudo_inverse

LEAST = 1e-6


def matrix(shape: tuple[int, int], least: float) -> np.ndarray:
    """Return a matrix whose singular values fall from 1 to 0.01, and the last one is ``least``."""
    rng, rank = np.random.default_rng(1), min(shape)
    left, right = (np.linalg.qr(rng.normal(size=(n, rank)))[0] for n in shape)
    values = np.append(np.geomspace(1.0, 1e-2, rank - 1), least)
    return left * values @ right.T


@pytest.mark.parametrize("shape", [(LARGE, LARGE + 40), (LARGE + 40, LARGE)])
def test_a_pseudo_inverse_is_that_of_singular_values(shape: tuple[int, int]) -> None:
    given = matrix(shape, 1e-3)
    assert has_full_rank(given, LEAST)
    found = pseudo_inverse(given)
    assert found is not None
    np.testing.assert_allclose(found, np.linalg.pinv(given), atol=1e-7)


@pytest.mark.parametrize("least", [0.0, 1e-16, 1e-9, 0.5 * LEAST])
def test_rows_that_depend_on_each_other_are_left_to_singular_values(least: float) -> None:
    given = matrix((LARGE, LARGE + 40), least)
    assert not has_full_rank(given, LEAST)
    assert pseudo_inverse(given) is None


def test_a_small_matrix_keeps_its_singular_values() -> None:
    assert not has_full_rank(np.eye(LARGE - 1), LEAST)


def test_the_complement_is_orthonormal_and_across_all_columns() -> None:
    given = matrix((LARGE + 40, LARGE), 1e-3)
    rows = complement(given)
    np.testing.assert_allclose(rows @ rows.T, np.eye(40), atol=1e-12)
    np.testing.assert_allclose(rows @ given, 0.0, atol=1e-12)
