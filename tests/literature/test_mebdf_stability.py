"""Coefficients and stability of the MEBDF.

Angles: Cash (1983) and Hairer and Wanner, Solving Ordinary Differential Equations II, V.3, recomputed by root
locus to two decimals in ``docs/theory/mebdf.md``.
"""

from math import comb

import numpy as np
import pytest

from mebdf.kernels.coefficients import BDF_HISTORY, EXTENDED_HISTORY, MAX_K, SCALARS

ANGLES = {1: 90.0, 2: 90.0, 3: 90.0, 4: 88.36, 5: 83.07, 6: 74.48, 7: 61.98}


def of_values(weights):
    """Turn weights of ∇^i y_n into weights of y_{n-j}."""
    values = np.zeros(len(weights))
    for i, weight in enumerate(weights):
        for j in range(i + 1):
            values[j] += weight * (-1) ** j * comb(i, j)
    return values


def growth(k, z):
    """Return the largest |w| of solutions y_n = w^n of y' = λ y with z = h λ, for an array of z.

    The three stages give (1 − zβ)³ w^k = Σ_j c_j(z) w^{k−1−j}.
    """
    beta, b_0, b_1 = SCALARS[k, :3]
    p, e = of_values(BDF_HISTORY[k, :k]), of_values(EXTENDED_HISTORY[k, :k])
    d = 1.0 - beta * z
    shifted = np.append(p[1:], 0.0)
    stage_1 = p / d[:, None]
    stage_2 = (p[0] * stage_1 + shifted) / d[:, None]
    row = (z[:, None] * ((b_0 - beta) * stage_1 + b_1 * stage_2) + e) / d[:, None]
    companion = np.zeros((z.size, k, k), dtype=complex)
    companion[:, 0, :] = row
    companion[:, np.arange(1, k), np.arange(k - 1)] = 1.0
    return np.abs(np.linalg.eigvals(companion)).max(axis=1)


def stable_on_ray(k, angle):
    radii = np.geomspace(1e-2, 1e4, 3000)
    return np.all(growth(k, -radii * np.exp(1j * np.radians(angle))) <= 1.0 + 1e-10)


@pytest.mark.parametrize("k", range(1, MAX_K + 1))
def test_angle_of_stability(k):
    assert stable_on_ray(k, ANGLES[k] - 0.01)
    if ANGLES[k] < 90.0:
        assert not stable_on_ray(k, ANGLES[k] + 0.02)


@pytest.mark.parametrize("k", range(1, MAX_K + 1))
def test_stiff_components_vanish_at_infinity(k):
    assert growth(k, np.array([-1e40 + 0j]))[0] < 1e-4


@pytest.mark.parametrize("k", range(1, MAX_K + 1))
def test_formulae_are_exact_for_polynomials(k):
    beta, b_0, b_1, _ = SCALARS[k]
    times = -np.arange(k, dtype=float)  # t_n = 0 and back, step one
    for degree in range(k + 2):
        slope = {t: degree * t ** (degree - 1.0) if degree else 0.0 for t in (1.0, 2.0)}
        past = times**degree
        if degree <= k:
            assert of_values(BDF_HISTORY[k, :k]) @ past + beta * slope[1.0] == pytest.approx(1.0, abs=1e-9)
        extended = of_values(EXTENDED_HISTORY[k, :k]) @ past + b_0 * slope[1.0] + b_1 * slope[2.0]
        assert extended == pytest.approx(1.0, abs=1e-8)
