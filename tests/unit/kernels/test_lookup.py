from __future__ import annotations

import math

import numpy as np
import pytest

from tribodyn.contact import RSDC, SurfacePair, tabulate
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.arrays import FloatArray
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy


class Cubic(ContactLaw):
    """A law that cubic interpolation and sixth-order differences reproduce."""

    name = "cubic"

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        return (8.0 - h_star) ** 3

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        return 2.0 * (8.0 - h_star) ** 2


@pytest.fixture(scope="module")
def cubic(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(Cubic(table_1_pair), onset=8.0)


@pytest.fixture(scope="module")
def table(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(RSDC(table_1_pair))


@pytest.mark.parametrize("h_star", [-4.0, -3.999, -1.2345, 0.0, 3.3, 6.9999])
def test_a_cubic_law_is_reproduced(cubic: ContactTable, h_star: float) -> None:
    x = 8.0 - h_star
    # Rounding: the slopes are differences of numbers of size x³ over a step of 1/128.
    expected = (x**3, -3.0 * x**2, 2.0 * x**2, -4.0 * x)
    assert pressure_and_damping(cubic, h_star) == pytest.approx(expected, rel=1e-10)
    assert stored_energy(cubic, h_star) == pytest.approx(x**4 / 4.0, rel=1e-11)


def test_slopes_are_those_of_the_interpolant(table: ContactTable) -> None:
    # The interpolant is a cubic on each interval, where a fourth-order difference is exact up to rounding.
    step, inside = 1.0 / table.inverse_step, 1e-3
    for h_star in -4.0 + step * (np.arange(7, 1500, 83) + 0.37):
        values = [np.array(pressure_and_damping(table, h_star + k * inside)) for k in (-2, -1, 1, 2)]
        difference = (values[0] - 8.0 * values[1] + 8.0 * values[2] - values[3]) / (12.0 * inside)
        p, dp, c, dc = pressure_and_damping(table, h_star)
        # Rounding of values of size p over 1e-3, and where the smoothed C fades out, of C itself.
        assert dp == pytest.approx(difference[0], abs=1e-12 * p / inside)
        assert dc == pytest.approx(difference[2], abs=1e-12 * c / inside)


def test_energy_slope_is_minus_the_pressure(table: ContactTable) -> None:
    rng = np.random.default_rng(1)
    for h_star in rng.uniform(-4.5, 4.0, 40):
        d = 1e-4
        slope = (stored_energy(table, h_star + d) - stored_energy(table, h_star - d)) / (2.0 * d)
        # d²/6 of the second derivative of P, which is below 30 P here, is 5e-8 P; rounding adds 1e-11 W/P.
        assert -slope == pytest.approx(pressure_and_damping(table, h_star)[0], rel=2e-7)


def test_values_and_slopes_join_at_nodes_and_at_the_lower_end(table: ContactTable) -> None:
    step = 1.0 / table.inverse_step
    for node in [-4.0, -4.0 + step, 0.0, 3.0, 4.0 - step]:
        below = pressure_and_damping(table, node - 1e-12)
        above = pressure_and_damping(table, node)
        assert below == pytest.approx(above, rel=1e-8)
        assert stored_energy(table, node - 1e-12) == pytest.approx(stored_energy(table, node), rel=1e-10)


def test_not_a_number_stays_not_a_number(table: ContactTable) -> None:
    p, _, c, _ = pressure_and_damping(table, math.nan)
    assert math.isnan(p)
    assert math.isnan(c)
    assert math.isnan(stored_energy(table, math.nan))
