"""Limits of the contact laws that have a closed form."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import erfc, gamma, pbdv

from mebdf.arrays import FloatArray
from tribodyn.contact import LAWS, RSDC, KogutEtsion, SurfacePair, law
from tribodyn.contact.asperities import AsperityLaw
from tribodyn.contact.greenwood_tripp import GreenwoodTripp

H_STAR = np.linspace(-4.0, 8.0, 25)


def greenwood_williamson(power: float, h_star: FloatArray) -> FloatArray:
    """∫_0^∞ s^power Φ(h* + s) ds in closed form, by the parabolic cylinder function D."""
    cylinder = pbdv(-power - 1.0, h_star)[0]
    return gamma(power + 1.0) / math.sqrt(2.0 * math.pi) * np.exp(-(h_star**2) / 4.0) * cylinder


@pytest.fixture
def elastic(table_1_pair: SurfacePair) -> SurfacePair:
    # δ_c* grows with the square of the hardness: here it is 7e12, far above every asperity.
    return dataclasses.replace(table_1_pair, hardness=1e16)


@pytest.fixture
def plastic(table_1_pair: SurfacePair) -> SurfacePair:
    # Here δ_c* is 7e-20: the share of asperities that are not fully plastic is below rounding.
    return dataclasses.replace(table_1_pair, hardness=1.0)


def elastic_pressure(pair: SurfacePair) -> FloatArray:
    """(4/3) E ξ √β σ^1.5 F_{3/2}: Hertz asperities of Gaussian heights [Pa]."""
    stress = 4.0 / 3.0 * pair.composite_modulus * pair.asperity_density
    stress *= math.sqrt(pair.asperity_radius) * pair.roughness_rms**1.5
    return stress * greenwood_williamson(1.5, H_STAR)


def test_hard_surfaces_are_elastic(elastic: SurfacePair) -> None:
    # scipy's D is off by 1e-9 near h* = 6 and good to 1e-12 elsewhere.
    np.testing.assert_allclose(
        KogutEtsion(elastic).stiffness_pressure(H_STAR), elastic_pressure(elastic), rtol=2e-9
    )


#: Laws of Hertzian asperities against a plane; the others count pairs of asperities, or none.
ONE_ROUGH_SURFACE = [name for name in LAWS if issubclass(LAWS[name], AsperityLaw)]


@pytest.mark.parametrize("name", ONE_ROUGH_SURFACE)
def test_all_laws_are_that_of_greenwood_and_williamson_when_nothing_yields(elastic, name):
    found, gw = law(name, elastic), law("gw", elastic)
    # scipy's D in `elastic_pressure` is off by 1e-9 near h* = 6; the laws differ by rounding.
    np.testing.assert_allclose(found.stiffness_pressure(H_STAR), elastic_pressure(elastic), rtol=2e-9)
    np.testing.assert_allclose(found.stiffness_pressure(H_STAR), gw.stiffness_pressure(H_STAR), rtol=1e-12)
    np.testing.assert_allclose(found.real_area_fraction(H_STAR), gw.real_area_fraction(H_STAR), rtol=1e-12)
    np.testing.assert_array_equal(found.contact_count(H_STAR), gw.contact_count(H_STAR))


@pytest.mark.parametrize("name", ONE_ROUGH_SURFACE)
def test_laws_tend_to_the_elastic_one_as_the_plasticity_index_falls(table_1_pair, name):
    h_star = np.array([0.0, 1.0, 2.0, 3.0])
    off = []
    for index in (1.0, 0.7, 0.5, 0.35):
        # ψ = 1/√δ_c*, and δ_c* grows with the square of the hardness.
        hardness = table_1_pair.hardness / (index * table_1_pair.critical_interference_star**0.5)
        pair = dataclasses.replace(table_1_pair, hardness=hardness)
        elastic = law("gw", pair).stiffness_pressure(h_star)
        off.append(np.abs(law(name, pair).stiffness_pressure(h_star) / elastic - 1.0).max())
    assert off == sorted(off, reverse=True)
    # At ψ = 0.35 an asperity must stick out by 8 σ more than the separation to yield.
    assert off[-1] < 1e-9


def test_two_rough_surfaces_stay_elastic(table_1_pair: SurfacePair, elastic: SurfacePair) -> None:
    found = GreenwoodTripp(table_1_pair).stiffness_pressure(H_STAR)
    np.testing.assert_array_equal(found, GreenwoodTripp(elastic).stiffness_pressure(H_STAR))
    product = table_1_pair.asperity_parameter
    ratio = greenwood_williamson(2.5, H_STAR) / greenwood_williamson(1.5, H_STAR)
    expected = 0.8 * math.sqrt(2.0) * math.pi * product * ratio * elastic_pressure(table_1_pair)
    # The tolerance is that of scipy's D.
    np.testing.assert_allclose(found, expected, rtol=5e-9)


def test_soft_surfaces_are_plastic(plastic: SurfacePair) -> None:
    tail = 0.5 * erfc(H_STAR / math.sqrt(2.0))
    # ∫_0^∞ s Φ(h* + s) ds = Φ(h*) − h*·tail cancels to 1/h*² of its terms: it is taken below h* = 4 only.
    mean = np.exp(-0.5 * H_STAR**2) / math.sqrt(2.0 * math.pi) - H_STAR * tail
    expected = 2.0 * math.pi * plastic.hardness * plastic.asperity_parameter * mean
    low = H_STAR <= 4.0
    pressure = KogutEtsion(plastic).stiffness_pressure(H_STAR)
    np.testing.assert_allclose(pressure[low], expected[low], rtol=1e-12)


def test_works_are_the_integrals_of_their_pressures(table_1_pair: SurfacePair) -> None:
    law, d = RSDC(table_1_pair), 1e-3
    elastic, first, second, plastic = (regime.integral(H_STAR) for regime in law.regimes)
    stencil = [law.works(H_STAR + k * d) for k in (-2, -1, 1, 2)]
    for part, pressure in enumerate((elastic + first + second, plastic + first + second)):
        w = [works[part] for works in stencil]
        slope = (w[0] - 8.0 * w[1] + 8.0 * w[2] - w[3]) / (12.0 * d)
        # The difference errs by d⁴/30 of the fifth derivative, below 1e5 times P: 3e-9; rounding adds 1e-11.
        np.testing.assert_allclose(-slope, pressure, rtol=3e-9)


def test_hard_surfaces_lose_nothing(elastic: SurfacePair) -> None:
    law = RSDC(elastic)
    np.testing.assert_array_equal(law.loss_factor(H_STAR), 0.0)
    np.testing.assert_array_equal(law.damping_pressure(H_STAR), 0.0)


def test_soft_surfaces_lose_everything(plastic: SurfacePair) -> None:
    law = RSDC(plastic)
    np.testing.assert_allclose(law.meant_restitution(H_STAR), 0.0, atol=1e-12)
    # μ/(μ + 1) = 1, and C is then 3/4 of the elastic pressure; the tolerance is that of scipy's D.
    np.testing.assert_allclose(law.damping_pressure(H_STAR), 0.75 * elastic_pressure(plastic), rtol=2e-9)


def test_pressure_is_proportional_to_the_density_of_asperities(table_1_pair: SurfacePair) -> None:
    denser = dataclasses.replace(table_1_pair, asperity_density=2.0 * table_1_pair.asperity_density)
    for method in ("stiffness_pressure", "damping_pressure"):
        single = getattr(RSDC(table_1_pair), method)(H_STAR)
        np.testing.assert_allclose(getattr(RSDC(denser), method)(H_STAR), 2.0 * single, rtol=1e-14)
