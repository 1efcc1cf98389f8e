"""Chang-Etsion-Bogy and Jackson-Green: published load and area of one asperity, by adaptive quadrature."""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact import SurfacePair, law

H_STAR = np.array([-2.0, -0.5, 0.0, 1.0, 2.0, 3.5, 5.0])
Asperity = Callable[[SurfacePair, float], tuple[float, float, float]]


def chang_etsion_bogy(pair: SurfacePair, interference: float) -> tuple[float, float, float]:
    """Return load [N], area [m²] and critical interference [m], as the paper of 1987 has them."""
    hardness, radius = pair.hardness, pair.asperity_radius
    factor = 0.454 + 0.41 * pair.poisson_ratio[1]
    critical = (math.pi * factor * hardness / (2.0 * pair.composite_modulus)) ** 2 * radius
    if interference <= critical:
        load = 4.0 / 3.0 * pair.composite_modulus * math.sqrt(radius) * interference**1.5
        return load, math.pi * radius * interference, critical
    area = math.pi * radius * interference * (2.0 - critical / interference)
    return factor * hardness * area, area, critical


def jackson_green(pair: SurfacePair, interference: float) -> tuple[float, float, float]:
    """Return the same as the paper of 2005 has them."""
    modulus, radius, strength = pair.composite_modulus, pair.asperity_radius, pair.hardness / 2.8
    c = 1.295 * math.exp(0.736 * pair.poisson_ratio[1])
    critical = (math.pi * c * strength / (2.0 * modulus)) ** 2 * radius
    critical_load = 4.0 / 3.0 * (radius / modulus) ** 2 * (0.5 * c * math.pi * strength) ** 3
    critical_area = math.pi**3 * (c * strength * radius / (2.0 * modulus)) ** 2
    w = interference / critical
    if w <= 1.9:
        return critical_load * w**1.5, critical_area * w, critical
    area = critical_area * w * (w / 1.9) ** (0.14 * math.exp(23.0 * strength / modulus))
    contact_radius = math.sqrt(area / math.pi)
    limit = 2.84 * (1.0 - math.exp(-0.82 * (contact_radius / radius) ** -0.7))
    load = math.exp(-0.25 * w ** (5.0 / 12.0)) * w**1.5
    load += 4.0 * limit / c * (1.0 - math.exp(-(w ** (5.0 / 9.0)) / 25.0)) * w
    return critical_load * load, area, critical


def summed(one: Asperity, first: float, pair: SurfacePair, h_star: float) -> tuple[float, float]:
    """Return pressure [Pa] and area fraction [1]; regimes begin at ``first`` critical interferences."""
    sigma, end = pair.roughness_rms, 14.0 - min(h_star, 0.0)
    edge = first * one(pair, sigma)[2] / sigma
    edges = [0.0, *(x for x in (edge, 10.0 * edge, 100.0 * edge) if x < end), end]

    def integral(part: int) -> float:
        def integrand(s: float) -> float:
            density = math.exp(-0.5 * (h_star + s) ** 2) / math.sqrt(2.0 * math.pi)
            return one(pair, s * sigma)[part] * density

        spans = pairwise(edges)
        return sum(quad(integrand, low, high, epsabs=0, epsrel=1e-11, limit=200)[0] for low, high in spans)

    return pair.asperity_density * integral(0), pair.asperity_density * integral(1)


# From nearly plastic, or the largest yield strain of the published range of B, through Table 1 to nearly
# elastic asperities. 1e-6 is what a table is asked to be good to; fractional powers cost some digits.
@pytest.mark.parametrize(
    ("name", "one", "first", "hardness", "close"),
    [
        *(("ceb", chang_etsion_bogy, 1.0, hardness, 1e-9) for hardness in (1e6, 492e6, 4.9e9)),
        *(("jg", jackson_green, 1.9, hardness, 1e-8) for hardness in (50e6, 492e6, 1.0e9)),
    ],
)
def test_pressure_and_area_are_those_of_the_published_asperity(
    name, one, first, hardness, close, table_1_pair
):
    pair = replace(table_1_pair, hardness=hardness)
    found = law(name, pair)
    expected = np.array([summed(one, first, pair, h) for h in H_STAR]).T
    np.testing.assert_allclose(found.stiffness_pressure(H_STAR), expected[0], rtol=close)
    np.testing.assert_allclose(found.real_area_fraction(H_STAR), expected[1], rtol=close)


def test_a_plastic_asperity_has_twice_the_elastic_area_and_carries_kh(table_1_pair: SurfacePair) -> None:
    soft = replace(table_1_pair, hardness=1.0)
    found = law("ceb", soft)
    mean = found.stiffness_pressure(H_STAR) / found.real_area_fraction(H_STAR)
    # The share of asperities that are not plastic is below rounding here.
    np.testing.assert_allclose(mean, soft.hardness_coefficient * soft.hardness, rtol=1e-12)


def test_asperities_yield_where_those_of_kogut_and_etsion_do(table_1_pair: SurfacePair) -> None:
    steel = replace(table_1_pair, poisson_ratio=(0.3, 0.3))
    # Two fits of the same von Mises problem: C S_y against K H with H = 2.8 S_y, ν = 0.3.
    assert jackson_green(steel, 1e-7)[2] == pytest.approx(steel.critical_interference, rel=2e-3)
