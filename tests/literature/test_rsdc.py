"""Rough-surface damping against numbers computed independently of this project."""

import numpy as np
import pytest

from tribodyn.contact import RSDC, SurfacePair

# Surfaces of Table 1 of the source paper, computed independently: h*, μ, e, C [Pa],
# and half a unit of the last printed digit of C.
TABLE_1 = [
    (0.0, 1.1465, 0.6825, 407.3e6, 0.05e6),
    (2.0, 1.0122, 0.7050, 5.930e6, 0.0005e6),
    (3.0, 1.0025, 0.7067, 0.2343e6, 0.00005e6),
]


@pytest.mark.parametrize(("h_star", "mu", "restitution", "damping", "last_digit"), TABLE_1)
def test_damping_of_table_1(
    table_1_pair: SurfacePair, h_star: float, mu: float, restitution: float, damping: float, last_digit: float
) -> None:
    law, h = RSDC(table_1_pair), np.array([h_star])
    # Half a unit of the last printed digit.
    assert law.loss_factor(h)[0] == pytest.approx(mu, abs=0.5001e-4)
    assert law.meant_restitution(h)[0] == pytest.approx(restitution, abs=0.5001e-4)
    assert law.damping_pressure(h)[0] == pytest.approx(damping, abs=last_digit)
