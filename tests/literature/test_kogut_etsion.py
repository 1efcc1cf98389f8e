"""Kogut and Etsion and the law of the paper against published tables."""

import dataclasses
import math

import numpy as np
import pytest

from tribodyn.contact import RSDC, KogutEtsion, SurfacePair

# Surfaces of Table 1 of the source paper, computed independently.
TABLE_1_PROPERTIES = [
    ("composite_modulus", 7.818e9, 0.0005e9),
    ("hardness_coefficient", 0.5934, 0.00005),
    ("roughness_rms", 1.634e-6, 0.0005e-6),
    ("critical_interference", 0.02811e-6, 0.000005e-6),
    ("critical_interference_star", 0.01721, 0.000005),
    ("asperity_parameter", 0.5072, 0.00005),
]
TABLE_1_PRESSURE = [
    (0.0, 518.2e6, 0.05e6),
    (1.0, 98.78e6, 0.005e6),
    (2.0, 9.287e6, 0.0005e6),
    (3.0, 0.3904e6, 0.00005e6),
    (4.0, 0.006889e6, 0.0000005e6),
]

# Dimensionless load F/(A_n H) and real area A/A_n by plasticity index, after Kogut and Etsion (2003), with
# ηRσ = 0.04 and ν = 0.3. The separation is measured from the mean of surface heights.
SEPARATIONS = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 3.0])
DIMENSIONLESS_LOAD = {
    0.5: [3.94187e-02, 2.28604e-02, 1.15229e-02, 4.89120e-03, 1.69827e-03, 1.01883e-04],
    1.0: [7.68165e-02, 4.50192e-02, 2.28722e-02, 9.75983e-03, 3.39883e-03, 2.04251e-04],
    2.0: [1.33168e-01, 7.97206e-02, 4.12545e-02, 1.78850e-02, 6.31484e-03, 3.88186e-04],
    2.5: [1.51768e-01, 9.17302e-02, 4.79933e-02, 2.10316e-02, 7.49584e-03, 4.66965e-04],
    4.0: [1.95403e-01, 1.18844e-01, 6.27714e-02, 2.78467e-02, 1.00650e-02, 6.45480e-04],
    8.0: [2.78207e-01, 1.71272e-01, 9.09959e-02, 4.04893e-02, 1.46740e-02, 9.49146e-04],
}

REAL_AREA = {
    0.5: [1.49132e-01, 9.61759e-02, 5.38902e-02, 2.53318e-02, 9.67809e-03, 6.86942e-04],
    1.0: [1.52563e-01, 9.68017e-02, 5.36984e-02, 2.51229e-02, 9.58798e-03, 6.82277e-04],
    2.0: [1.86151e-01, 1.15843e-01, 6.27249e-02, 2.85858e-02, 1.06346e-02, 7.25303e-04],
    2.5: [1.99505e-01, 1.24291e-01, 6.72833e-02, 3.06046e-02, 1.13470e-02, 7.66703e-04],
    4.0: [2.29282e-01, 1.43054e-01, 7.75629e-02, 3.53202e-02, 1.30980e-02, 8.82219e-04],
    8.0: [2.83786e-01, 1.77337e-01, 9.59945e-02, 4.36066e-02, 1.61400e-02, 1.08570e-03],
}


@pytest.mark.parametrize(("name", "expected", "last_digit"), TABLE_1_PROPERTIES)
def test_properties_of_table_1(table_1_pair, name, expected, last_digit):
    # Half a unit of the last printed digit.
    assert getattr(table_1_pair, name) == pytest.approx(expected, abs=last_digit)


@pytest.mark.parametrize(("h_star", "expected", "last_digit"), TABLE_1_PRESSURE)
def test_pressure_of_table_1(table_1_pair, h_star, expected, last_digit):
    # Half a unit of the last printed digit.
    pressure = KogutEtsion(table_1_pair).stiffness_pressure(np.array([h_star]))[0]
    assert pressure == pytest.approx(expected, abs=last_digit)


@pytest.mark.parametrize("plasticity_index", DIMENSIONLESS_LOAD)
def test_dimensionless_load_and_real_area(plasticity_index: float) -> None:
    beta, radius, roughness = 0.04, 10e-6, 1e-6
    pair = pair_of(plasticity_index, beta / (radius * roughness), radius, roughness)
    law = KogutEtsion(pair, separation_from="surface")
    # Six printed digits: half a unit of the last is at most 5e-6 of the smallest leading digits here.
    load = law.stiffness_pressure(SEPARATIONS) / pair.hardness
    np.testing.assert_allclose(load, DIMENSIONLESS_LOAD[plasticity_index], rtol=6e-6)
    area = law.real_area_fraction(SEPARATIONS)
    np.testing.assert_allclose(area, REAL_AREA[plasticity_index], rtol=6e-6)


def test_separation_from_the_asperities_is_the_default() -> None:
    pair = pair_of(2.0, 4e9, 10e-6, 1e-6)
    law, other = KogutEtsion(pair), KogutEtsion(pair, separation_from="surface")
    spread = math.sqrt(1.0 - 3.717e-4 / 0.04**2)
    narrow = KogutEtsion(dataclasses.replace(pair, roughness=(0.0, spread * 1e-6)))
    above = (SEPARATIONS - 0.045944 / 0.04) / spread
    np.testing.assert_allclose(
        other.stiffness_pressure(SEPARATIONS), narrow.stiffness_pressure(above), rtol=1e-13
    )
    assert np.all(other.stiffness_pressure(SEPARATIONS) > law.stiffness_pressure(SEPARATIONS))


def pair_of(plasticity_index: float, density: float, radius: float, roughness: float) -> SurfacePair:
    """Return surfaces whose critical interference is σ/ψ², with ν = 0.3.

    ψ of the source is made with the spread of the asperities, σ_s; ψ² δ_c = σ_s.
    """
    hardness, nu = 1e9, 0.3
    spread = roughness * math.sqrt(1.0 - 3.717e-4 / (density * radius * roughness) ** 2)
    slope = math.sqrt(spread / radius) / plasticity_index
    modulus = math.pi * (0.454 + 0.41 * nu) * hardness / (2.0 * slope)
    young = 2.0 * (1.0 - nu**2) * modulus
    return SurfacePair((young, young), (nu, nu), (0.0, roughness), hardness, density, radius)


# Surfaces of Table 1 of the source paper, computed independently: h*, μ, e, C [Pa],
# and half a unit of the last printed digit of C.
TABLE_1 = [
    (0.0, 1.1465, 0.6825, 407.3e6, 0.05e6),
    (2.0, 1.0122, 0.7050, 5.930e6, 0.0005e6),
    (3.0, 1.0025, 0.7067, 0.2343e6, 0.00005e6),
]


@pytest.mark.parametrize(("h_star", "mu", "restitution", "damping", "last_digit"), TABLE_1)
def test_damping_of_table_1(table_1_pair, h_star, mu, restitution, damping, last_digit):
    law, h = RSDC(table_1_pair), np.array([h_star])
    # Half a unit of the last printed digit.
    assert law.loss_factor(h)[0] == pytest.approx(mu, abs=0.5001e-4)
    assert law.meant_restitution(h)[0] == pytest.approx(restitution, abs=0.5001e-4)
    assert law.damping_pressure(h)[0] == pytest.approx(damping, abs=last_digit)
