"""Chang-Etsion-Bogy: the published load and area of one asperity, summed by adaptive quadrature."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact import SurfacePair
from tribodyn.contact.kogut_etsion import ChangEtsionBogy

H_STAR = np.array([-2.0, -0.5, 0.0, 1.0, 2.0, 3.5, 5.0])


def one_asperity(pair: SurfacePair, interference: float) -> tuple[float, float]:
    """Return load [N] and area [m²] at an interference [m], as the paper of 1987 has them."""
    hardness, radius = pair.hardness, pair.asperity_radius
    factor = 0.454 + 0.41 * pair.poisson_ratio[1]
    critical = (math.pi * factor * hardness / (2.0 * pair.composite_modulus)) ** 2 * radius
    if interference <= critical:
        load = 4.0 / 3.0 * pair.composite_modulus * math.sqrt(radius) * interference**1.5
        return load, math.pi * radius * interference
    area = math.pi * radius * interference * (2.0 - critical / interference)
    return factor * hardness * area, area


def summed(pair: SurfacePair, h_star: float) -> tuple[float, float]:
    """Return pressure [Pa] and area fraction [1] of Gaussian asperities."""
    sigma, critical = pair.roughness_rms, pair.critical_interference_star
    end = 14.0 - min(h_star, 0.0)
    edges = [0.0, *(edge for edge in (critical, 10.0 * critical) if edge < end), end]

    def integral(part: int) -> float:
        def integrand(s: float) -> float:
            density = math.exp(-0.5 * (h_star + s) ** 2) / math.sqrt(2.0 * math.pi)
            return one_asperity(pair, s * sigma)[part] * density

        spans = pairwise(edges)
        return sum(quad(integrand, low, high, epsabs=0, epsrel=1e-11, limit=200)[0] for low, high in spans)

    return pair.asperity_density * integral(0), pair.asperity_density * integral(1)


# From nearly plastic through Table 1 to nearly elastic asperities.
@pytest.mark.parametrize("hardness", [1e6, 492e6, 4.9e9])
def test_pressure_and_area_are_those_of_the_published_asperity(
    table_1_pair: SurfacePair, hardness: float
) -> None:
    pair = replace(table_1_pair, hardness=hardness)
    law = ChangEtsionBogy(pair)
    expected = np.array([summed(pair, h) for h in H_STAR]).T
    # Both quadratures are good to about 1e-11 of parts that do not cancel beyond a factor of two.
    np.testing.assert_allclose(law.stiffness_pressure(H_STAR), expected[0], rtol=1e-9)
    np.testing.assert_allclose(law.real_area_fraction(H_STAR), expected[1], rtol=1e-9)


def test_a_plastic_asperity_has_twice_the_elastic_area_and_carries_kh(table_1_pair: SurfacePair) -> None:
    soft = replace(table_1_pair, hardness=1.0)
    law = ChangEtsionBogy(soft)
    mean = law.stiffness_pressure(H_STAR) / law.real_area_fraction(H_STAR)
    # The share of asperities that are not plastic is below rounding here.
    np.testing.assert_allclose(mean, soft.hardness_coefficient * soft.hardness, rtol=1e-12)
