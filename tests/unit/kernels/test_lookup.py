"""What else holds."""

import math

import pytest

from tribodyn.contact import RSDC, SurfacePair, tabulate
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy


@pytest.fixture(scope="module")
def table(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(RSDC(table_1_pair))


def test_goes_on_linearly_below_the_table(table: ContactTable) -> None:
    p_0, dp_0, c_0, dc_0 = pressure_and_damping(table, -4.0)
    expected = (p_0 - 3.0 * dp_0, dp_0, c_0 - 3.0 * dc_0, dc_0)
    assert pressure_and_damping(table, -7.0) == pytest.approx(expected, rel=1e-14)
    energy = stored_energy(table, -4.0) + 3.0 * p_0 - 4.5 * dp_0
    assert stored_energy(table, -7.0) == pytest.approx(energy, rel=1e-14)


@pytest.mark.parametrize("h_star", [8.0, 8.5, 1e6, 1e300])
def test_is_zero_above_the_table(table: ContactTable, h_star: float) -> None:
    assert pressure_and_damping(table, h_star) == (0.0, 0.0, 0.0, 0.0)
    assert stored_energy(table, h_star) == 0.0


def test_the_last_number_below_the_end_stays_inside(table: ContactTable) -> None:
    last = math.nextafter(8.0, 0.0)
    # Rounding may put it on the last node, above which everything is zero.
    pressure = pressure_and_damping(table, last)[0]
    assert pressure == 0.0 or pressure == pytest.approx(table.nodes[-1, 0], rel=1e-10)
    assert stored_energy(table, last) == pytest.approx(0.0, abs=1e-20)
