"""Roughness of a surface whose tops are worn off."""

import math

import numpy as np
import pytest

from tribodyn.wear import loaded_depth, worn_roughness

SIGMA = 1.6e-6


def test_half_worn_is_half_normal() -> None:
    # Cut at the mean plane, min(z, 0): mean −1/√(2π), variance 1/2 − 1/(2π).
    found = worn_roughness(SIGMA, SIGMA / math.sqrt(2.0 * math.pi), 0.0)
    assert found == pytest.approx(SIGMA * math.sqrt(0.5 - 0.5 / math.pi), rel=1e-12)


@pytest.mark.parametrize("level", [-2.0, -0.5, 0.7, 2.0])
def test_against_the_heights_themselves(level: float) -> None:
    z = np.linspace(-9.0, 9.0, 200_001)
    weight = np.exp(-0.5 * z**2) / math.sqrt(2.0 * math.pi) * (z[1] - z[0])
    cut = np.minimum(z, level)
    depth = float(np.sum(weight * (z - cut)))
    rms = math.sqrt(float(np.sum(weight * cut**2)) - depth**2)
    # Trapezium over a kink: (1e-4)².
    assert worn_roughness(SIGMA, depth * SIGMA, 0.0) == pytest.approx(rms * SIGMA, rel=1e-7)


def test_it_falls_from_the_first_to_the_last() -> None:
    depths = np.linspace(0.0, 5.0, 101) * SIGMA
    found = np.array([worn_roughness(SIGMA, depth, 0.3e-6) for depth in depths])
    assert found[0] == SIGMA
    assert np.all(np.diff(found) <= 0.0)
    assert found[-1] == 0.3e-6 == worn_roughness(SIGMA, math.inf, 0.3e-6)
    assert worn_roughness(SIGMA, 1e-6, 2.0 * SIGMA) == SIGMA


def test_the_loaded_depth_is_that_of_the_volume() -> None:
    depth, area = np.array([[0.0, 2e-6], [1e-6, 9e-6]]), np.array([[1.0, 1.0], [2.0, 0.0]])
    # Volumes of 2 and 2; the edge has a depth and no area.
    assert loaded_depth(depth, area) == pytest.approx(1.5e-6)
    assert loaded_depth(0.0 * depth, area) == 0.0
