"""Oblique impacts against momentum, Coulomb's law and Mindlin's solution."""

import math

import numpy as np
import pytest

from tribodyn.validation.sets.oblique_impact import ImpactingSphere, TangentialLaw, _Compliant, rebound

SPHERE = ImpactingSphere(2.5e-3, 4000.0, (380e9, 70e9), (0.23, 0.25), friction=0.092, restitution=0.98)
LAWS: tuple[TangentialLaw, ...] = ("regularised", "compliant")


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("angle", [40.0, 50.0, 70.0])
def test_gross_sliding_is_momentum_and_coulombs_law(law: TangentialLaw, angle: float) -> None:
    after = rebound(SPHERE, 3.9, math.radians(angle), law)
    lost = 0.092 * (1.0 + after.normal) / math.tan(math.radians(angle))
    assert after.tangential == pytest.approx(1.0 - lost, abs=2e-4)
    assert after.normal == pytest.approx(0.98, abs=2e-3)


def test_regularised_friction_ends_in_rolling() -> None:
    after = rebound(SPHERE, 3.9, math.radians(10.0), "regularised")
    assert after.tangential == pytest.approx(5.0 / 7.0, abs=1e-6)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("angle", [2.0, 20.0, 60.0])
def test_spin_balances_the_tangential_impulse_and_energy_falls(law: TangentialLaw, angle: float) -> None:
    slide, approach = 3.9 * math.sin(math.radians(angle)), 3.9 * math.cos(math.radians(angle))
    after = rebound(SPHERE, 3.9, math.radians(angle), law)
    assert SPHERE.radius * after.spin == pytest.approx(2.5 * slide * (1.0 - after.tangential))
    energy = (approach * after.normal) ** 2 + (slide * after.tangential) ** 2
    energy += 0.4 * (SPHERE.radius * after.spin) ** 2
    assert energy < 3.9**2


@pytest.mark.parametrize("share", [0.2, 0.6, 0.95])
def test_the_compliant_contact_is_that_of_cattaneo_and_mindlin(share: float) -> None:
    """At constant normal force T = μN [1 − (1 − s/s_max)^1.5], s_max = μ δ E/G."""
    depth, mu = 1e-6, SPHERE.friction
    contact = _Compliant(SPHERE, depth, 1.0)
    last = mu * depth * SPHERE.normal_modulus / SPHERE.tangential_modulus
    force = -contact.impulse(depth, 1.0, share * last)
    normal = 4.0 / 3.0 * SPHERE.normal_modulus * math.sqrt(SPHERE.radius) * depth**1.5
    assert force == pytest.approx(mu * normal * (1.0 - (1.0 - share) ** 1.5), rel=2e-4)


def test_no_friction_leaves_the_tangential_velocity() -> None:
    smooth = ImpactingSphere(2.5e-3, 4000.0, (380e9, 70e9), (0.23, 0.25), friction=0.0, restitution=1.0)
    assert rebound(smooth, 1.0, 0.5, "compliant").tangential == 1.0


def test_halved_steps_change_little() -> None:
    fine, coarse = (rebound(SPHERE, 3.9, 0.1, "compliant", steps=n).tangential for n in (4000, 2000))
    np.testing.assert_allclose(fine, coarse, atol=3e-4)
