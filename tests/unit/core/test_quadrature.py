import numpy as np
import pytest

from tribodyn.core.splines import gauss_legendre, gauss_legendre_between


def test_it_integrates_polynomials_of_twice_the_degree_exactly() -> None:
    points, weights = gauss_legendre_between(4, 1.0, 3.0)
    assert weights @ points**7 == pytest.approx((3.0**8 - 1.0) / 8.0, rel=1e-14)


def test_what_is_found_once_nobody_changes() -> None:
    points, _ = gauss_legendre(3)
    with pytest.raises(ValueError, match="read-only"):
        points[0] = 0.0
    assert gauss_legendre(3)[0] is points
    np.testing.assert_allclose(points, [-np.sqrt(0.6), 0.0, np.sqrt(0.6)], atol=1e-15)
