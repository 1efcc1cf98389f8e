"""Greenwood-Tripp integrals against the printed table of 1970 and independently computed values."""

import math

import numpy as np
import pytest

from tribodyn.contact import SurfacePair
from tribodyn.contact.contact_law import asperity_integral
from tribodyn.contact.greenwood_tripp import GreenwoodTripp

# F_5/2 as printed by Greenwood and Tripp (1970), to five decimals, at h* = 0 (0.5) 3.5.
PRINTED = [0.61664, 0.24040, 0.08056, 0.02286, 0.00542, 0.00106, 0.00017, 0.00002]

# F_n(h) = (2π)^-1/2 ∫_h^∞ (s − h)^n exp(−s²/2) ds, computed independently of this project to nine digits.
POWERS = (0.0, 0.5, 1.0, 1.5, 2.0, 2.5)
INTEGRALS = [
    (0.0, 5.00000000e-01, 4.11089479e-01, 3.98942280e-01, 4.30019994e-01, 5.00000000e-01, 6.16634219e-01),
    (0.25, 4.01293674e-01, 3.10513512e-01, 2.86344698e-01, 2.95167240e-01, 3.29707500e-01, 3.91978459e-01),
    (0.5, 3.08537539e-01, 2.25335582e-01, 1.97796557e-01, 1.95203604e-01, 2.09639260e-01, 2.40401571e-01),
    (0.75, 2.26627352e-01, 1.56687750e-01, 1.31166918e-01, 1.24092680e-01, 1.28252164e-01, 1.41962114e-01),
    (1.0, 1.58655254e-01, 1.04153675e-01, 8.33154706e-02, 7.56681774e-02, 7.53397833e-02, 8.05623356e-02),
    (1.25, 1.05649774e-01, 6.60463670e-02, 5.05868683e-02, 4.41707355e-02, 4.24161883e-02, 4.38561312e-02),
    (1.5, 6.68072013e-02, 3.98815177e-02, 2.93067938e-02, 2.46394803e-02, 2.28470106e-02, 2.28630560e-02),
    (1.75, 4.00591569e-02, 2.28959462e-02, 1.61737943e-02, 1.31129116e-02, 1.17550168e-02, 1.13963239e-02),
    (2.0, 2.27501319e-02, 1.24800403e-02, 8.49070262e-03, 6.64817762e-03, 5.76872671e-03, 5.42370520e-03),
    (2.5, 6.20966533e-03, 3.15902303e-03, 2.00413718e-03, 1.46993824e-03, 1.19932238e-03, 1.06368895e-03),
    (3.0, 1.34989803e-03, 6.41850439e-04, 3.82154317e-04, 2.63967554e-04, 2.03435080e-04, 1.70872996e-04),
    (3.5, 2.32629079e-04, 1.04071453e-04, 5.84809184e-05, 3.82270778e-05, 2.79458646e-05, 2.23124072e-05),
    (4.0, 3.16712418e-05, 1.34066699e-05, 7.14525843e-06, 4.43915596e-06, 3.09020810e-06, 2.35338105e-06),
]
TABLE = np.array(INTEGRALS)


def test_printed_integral() -> None:
    found = asperity_integral(np.arange(0.0, 4.0, 0.5), 2.5, 0.0, math.inf)
    # Five printed decimals, the last one cut off or rounded.
    np.testing.assert_allclose(found, PRINTED, rtol=0.0, atol=1e-5)


@pytest.mark.parametrize("column", range(len(POWERS)))
def test_integrals(column: int) -> None:
    found = asperity_integral(TABLE[:, 0], POWERS[column], 0.0, math.inf)
    # Nine significant digits: half a unit of the last is at most 5e-9 of a number that begins with 1.
    np.testing.assert_allclose(found, TABLE[:, 1 + column], rtol=5.1e-9)


def test_pressure_area_and_count_are_their_integrals(table_1_pair: SurfacePair) -> None:
    law = GreenwoodTripp(table_1_pair)
    density, radius, sigma = 0.038e12, 8.17e-6, table_1_pair.roughness_rms
    product = density * radius * sigma
    h_star = TABLE[:, 0]
    factor = 16.0 * math.sqrt(2.0) / 15.0 * math.pi * product**2 * math.sqrt(sigma / radius)
    expected = factor * table_1_pair.composite_modulus * TABLE[:, 6]
    np.testing.assert_allclose(law.stiffness_pressure(h_star), expected, rtol=5.1e-9)
    area = math.pi**2 * product**2 * TABLE[:, 5]
    np.testing.assert_allclose(law.real_area_fraction(h_star), area, rtol=5.1e-9)
    count = 4.0 * math.pi * density * product * TABLE[:, 3]
    np.testing.assert_allclose(law.contact_count(h_star), count, rtol=5.1e-9)


def test_pressure_is_that_of_asperities_meeting_beside_their_summits(table_1_pair: SurfacePair) -> None:
    """The sum over offsets r of two spheres of radius β is done here by quadrature, not in closed form."""
    pair, h_star = table_1_pair, 1.0
    beta, sigma = pair.asperity_radius, pair.roughness_rms
    heights, weights = np.polynomial.legendre.leggauss(200)
    s = 4.0 + 4.0 * heights  # interference of the summits over σ, 0 to 8
    share, offset_weights = 0.5 + 0.5 * heights, 0.5 * weights
    # r = share·√(4βσs): the interference that is left is s(1 − share²).
    left = s[:, None] * (1.0 - share**2)
    load = 4.0 / 3.0 * pair.composite_modulus * math.sqrt(0.5 * beta) * (sigma * left) ** 1.5
    rings = 2.0 * math.pi * share * 4.0 * beta * sigma * s[:, None]
    gauss = np.exp(-0.5 * (h_star + s) ** 2) / math.sqrt(2.0 * math.pi)
    expected = pair.asperity_density**2 * np.sum(4.0 * weights * gauss * ((load * rings) @ offset_weights))
    found = GreenwoodTripp(pair).stiffness_pressure(np.array([h_star]))[0]
    # Gauss-Legendre with (1 − share)^1.5 at the end errs by about n^-5.
    assert found == pytest.approx(expected, rel=1e-8)


def test_the_popular_fit_is_not_used(table_1_pair: SurfacePair) -> None:
    fit = 4.4086e-5 * (4.0 - 3.0) ** 6.804
    exact = asperity_integral(np.array([3.0]), 2.5, 0.0, math.inf)[0]
    assert fit / exact - 1.0 == pytest.approx(-0.742, abs=5e-4)
