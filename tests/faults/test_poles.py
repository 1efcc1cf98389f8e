"""Solutions with a pole: success beyond it only where an error of the tolerance moves the pole there."""

import itertools

import pytest
from scipy.integrate import solve_ivp

from tribodyn.integrate import MEBDF

BEYOND = (1.02, 1.05, 1.1, 1.2, 2.0, 100.0)  #: Ends over the time of the pole.
STARTS = (0.1, 1.0, 3.0, 10.0)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("rtol", [3e-2, 1e-2, 3e-3, 1e-3, 1e-5])
@pytest.mark.parametrize("power", [2, 3])
def test_no_success_beyond_a_pole_but_what_the_tolerance_explains(rtol, power):
    """An error e of y(0) moves the pole of y' = y^p, at y(0)^(1 - p)/(p - 1), by the share (p - 1) e/y(0)."""
    for ratio, beyond, start in itertools.product((1.0, 0.1, 1e-3), BEYOND, STARTS):
        pole = start ** (1 - power) / (power - 1)
        solution = solve_ivp(
            lambda t, y: y**power, (0.0, beyond * pole), [start], method=MEBDF, rtol=rtol, atol=rtol * ratio
        )
        displaced = (power - 1) * rtol * (1.0 + ratio / start)
        assert not solution.success or beyond - 1.0 <= 2.0 * displaced
