"""Flow, shear, contact and friction factors of rough surfaces."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.core.errors import InputError
from tribodyn.kernels.film.gap import cubic, mean_gap, place
from tribodyn.lubrication import Roughness
from tribodyn.lubrication.factors import (
    PEKLENIK,
    SHEAR,
    contact_factor,
    couette_factor,
    flow_table,
    pressure_factor,
    pressure_shear_factor,
    reach,
    shear_factor,
)


@pytest.mark.parametrize(
    ("peklenik", "expected"),
    [
        (1.0, 1.0 - 0.9 * np.exp(-0.56 * 3.0)),
        (3.0, 1.0 + 0.225 * 3.0**-1.5),
        (1 / 9, 1.0 - 1.48 * np.exp(-1.26)),
    ],
)
def test_pressure_factor_follows_the_published_fit(peklenik: float, expected: float) -> None:
    assert pressure_factor(np.array(3.0), peklenik) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("row", range(len(PEKLENIK)))
def test_shear_factor_is_joined_within_the_published_rounding(row: int) -> None:
    # The data page: both branches agree to 2e-4 at H = 5; A_2 has four digits.
    assert shear_factor(np.array(5.0), PEKLENIK[row]) == pytest.approx(
        SHEAR[row][4] * np.exp(-1.25), abs=2e-4
    )
    jump = np.diff(shear_factor(np.array([5.0 - 1e-9, 5.0 + 1e-9]), PEKLENIK[row]))
    assert abs(jump[0]) < 1e-8


def test_fits_of_another_program_agree() -> None:
    # Log fits in γ quoted on the data page; they differ from the table by up to .0183 in C and .0014 in r.
    h = np.linspace(1.0, 6.0, 11)
    for g in (1 / 9, 1 / 6, 1 / 3):
        c, r = 0.89679 - 0.26591 * np.log(g), 0.43006 - 0.10828 * g + 0.23821 * g**2
        np.testing.assert_allclose(pressure_factor(h, g), 1.0 - c * np.exp(-r * h), atol=0.02)


def test_contact_factor_is_continuous_and_grows() -> None:
    h = np.linspace(-4.0, 4.0, 4001)
    phi = contact_factor(h)
    assert np.all(np.diff(phi) >= 0.0)
    assert np.abs(np.diff(phi)).max() < 1e-3
    assert phi[0] == phi[2000] == pytest.approx(np.exp(-0.6912))
    assert phi[-1] == 1.0


def test_mean_gap_is_the_integral_of_the_contact_factor() -> None:
    table = flow_table(Roughness((1e-6, 0.0)))
    for h in (-2.0, -0.3, 0.0, 0.4, 1.7, 2.9, 3.5):
        expected = (
            reach() - quad(contact_factor, h, reach(), points=[0.0] if h < 0 else None, epsabs=1e-13)[0]
        )
        value, slope, _ = mean_gap(table, 1e-6, h * 1e-6)
        assert value == pytest.approx(1e-6 * expected, abs=1e-6 * 1e-9)  # cubics on steps of σ/43
        assert slope == pytest.approx(contact_factor(np.array(h)), abs=1e-6)  # slope of a cubic on that step


@pytest.mark.parametrize("separation", [0.5, 0.8, 1.0, 2.2, 3.0, 4.4, 5.0, 7.7, 30.0, 200.0])
def test_tables_reproduce_the_formulas(separation: float) -> None:
    table = flow_table(Roughness((1e-6, 0.0), (3.0, 1.0)))
    k, x, _ = place(table, 1e-6, separation * 1e-6)
    found = [cubic(table.factors[k, member], x) for member in range(5)]
    h = np.array(separation)
    expected = [
        pressure_factor(h, 3.0),
        pressure_factor(h, 1 / 3),
        shear_factor(h, 3.0),
        couette_factor(h),
        pressure_shear_factor(h),
    ]
    # Cubics on steps of 1/300 in 1/H; H^−1.5 has no third derivative at 1/H = 0, hence 1e-5 at H = 200.
    np.testing.assert_allclose(found, expected, atol=1e-5 if separation > 100 else 1e-7)


@pytest.mark.parametrize("z", [0.3, 0.9, 1.5, 4.0, 9.9, 10.1, 50.0])
def test_couette_factor_is_the_mean_of_the_inverse_gap(z: float) -> None:
    density = np.polynomial.Polynomial([35 / 32]) * np.polynomial.Polynomial([1.0, 0.0, -1.0]) ** 3
    low = max(-1.0, -z + 1.0 / 300.0)  # σ/100, in units of 3σ: the smallest local gap that counts
    expected = quad(lambda x: z * density(x) / (z + x), low, 1.0, epsabs=1e-12, epsrel=1e-11, limit=200)[0]
    # Below z = 1 the published form drops what the cut at 1/300 adds beyond its logarithm: terms of 1/300.
    assert couette_factor(np.array(3.0 * z)) == pytest.approx(expected, rel=4e-3 if z < 1 else 1e-8)


H = np.array([0.5, 0.75, 1.0, 2.0, 3.0, 4.9, 5.0, 6.0, 10.0, 40.0])


@pytest.mark.parametrize("peklenik", PEKLENIK)
def test_factors_end_at_smooth_surfaces(peklenik: float) -> None:
    # The slowest tail is H^−1.5: 0.87e-6 at H = 1e4.
    assert pressure_factor(np.array(1e4), peklenik) == pytest.approx(1.0, abs=1e-6)
    assert shear_factor(np.array(1e4), peklenik) == pytest.approx(0.0, abs=1e-6)


def test_interpolation_meets_the_tables_and_stays_between() -> None:
    for low, high in itertools.pairwise(PEKLENIK):
        ends = np.sort([pressure_factor(H, low), pressure_factor(H, high)], axis=0)
        between = pressure_factor(H, np.sqrt(low * high))
        assert np.all((ends[0] <= between) & (between <= ends[1]))
        np.testing.assert_allclose(pressure_factor(H, high * (1 - 1e-9)), pressure_factor(H, high), atol=1e-8)


@pytest.mark.parametrize("peklenik", [0.1, 9.1, 0.0])
def test_unknown_peklenik_number_is_refused(peklenik: float) -> None:
    with pytest.raises(InputError, match="1/9 to 9"):
        pressure_factor(H, peklenik)


def test_isotropic_surfaces_conduct_alike_in_both_directions() -> None:
    factors = flow_table(Roughness((1e-6, 2e-6))).factors
    np.testing.assert_array_equal(factors[:, 0], factors[:, 1])


def test_like_surfaces_have_no_shear_flow_and_exchange_reverses_it() -> None:
    alike = flow_table(Roughness((1e-6, 1e-6), (3.0, 3.0))).factors[:, 2]
    assert not alike.any()
    one = flow_table(Roughness((1e-6, 2e-6), (3.0, 1 / 3))).factors[:, 2]
    other = flow_table(Roughness((2e-6, 1e-6), (1 / 3, 3.0))).factors[:, 2]
    np.testing.assert_allclose(one, -other, atol=1e-15)
