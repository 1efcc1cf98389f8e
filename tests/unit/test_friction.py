"""The friction limit against its special cases."""

import math

import numpy as np
import pytest

from tribodyn.friction import FrictionLimit, stribeck_share


def test_coulomb_and_viscous_friction_do_not_depend_on_the_direction() -> None:
    law = FrictionLimit(coulomb=2.0, viscous=0.5)
    np.testing.assert_allclose(law(np.array([-4.0, 0.0, 4.0])), [4.0, 2.0, 4.0])


def test_stribeck_friction_falls_from_static_to_coulomb() -> None:
    law = FrictionLimit(coulomb=1.0, stribeck=0.5, stribeck_speed=2.0, stribeck_exponent=1.0)
    np.testing.assert_allclose(law(np.array([0.0, 2.0, 1e3])), [1.5, 1.0 + 0.5 / math.e, 1.0])
    assert stribeck_share(np.array(0.0), 1.0) == 1.0


@pytest.mark.parametrize(
    ("motor", "external", "expected"), [(3.0, 1.0, 0.4), (-3.0, 1.0, 0.8), (0.0, 2.0, 0.4)]
)
def test_equal_coefficients_give_friction_of_the_difference(motor, external, expected):
    law = FrictionLimit(motor_load=0.2, external_load=0.2)
    assert float(law(np.array(1.0), motor, external)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("motor", "external", "expected"),
    [(3.0, -1.0, 10.0), (1.0, -3.0, 1.0), (3.0, 1.0, 0.0), (2.0, -2.0, 0.0)],
)
def test_quadratic_friction_acts_against_the_direction_of_power(motor, external, expected):
    law = FrictionLimit(motor_load_quadratic=1.0, external_load_quadratic=10.0)
    assert float(law(np.array(0.0), motor, external)) == pytest.approx(expected)
