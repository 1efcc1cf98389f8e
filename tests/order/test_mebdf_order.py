"""Order k + 1 with every number k of back values, at fixed step from exact starting values.

The global error of y' = −2 t y², y = 1/(1 + t²), beside a linear oscillator.
"""

from itertools import pairwise

import numpy as np
import pytest

from mebdf.kernels import phases
from mebdf.kernels import state as entry
from mebdf.kernels.coefficients import MAX_K
from mebdf.kernels.core import resume


def rational(t, y):
    return np.array([-2.0 * t * y[0] ** 2, y[2], -y[1]])


def rational_jacobian(t, y):
    return np.array([[-4.0 * t * y[0], 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


def exact(t):
    return np.array([1.0 / (1.0 + t * t), np.cos(t), -np.sin(t)])


def global_error(k, n_steps):
    """Integrate over [0, 2] with ``n_steps`` equal steps; return the largest error."""
    h = 2.0 / n_steps
    state = entry.new_state(0.0, exact(0.0), 100.0, 1e-13, np.full(3, 1e-13), first_step=h)
    values = [exact(-j * h) for j in range(k + 1)]
    for m in range(k + 1):
        state.rows[entry.HISTORY + m] = values[0]
        values = [a - b for a, b in pairwise(values)]
    numbers = state.numbers[0]
    numbers.k, numbers.fixed, numbers.phase = k, 1, phases.STEP
    # A new Jacobian each step: Newton reaches rounding.
    numbers.settings.renew = numbers.settings.old_jacobian = 0.0
    error = 0.0
    while numbers.steps < n_steps:
        request = resume(*state)
        assert request != phases.FAILED
        if request == phases.STEP_ACCEPTED:
            error = max(error, np.abs(state.rows[entry.HISTORY] - exact(numbers.t)).max())
        t, y = numbers.t_eval, state.rows[entry.Y]
        if request == phases.NEED_F:
            state.rows[entry.F] = rational(t, y)
        elif request == phases.NEED_JACOBIAN:
            state.matrices[entry.JACOBIAN] = rational_jacobian(t, y)
    assert numbers.rejected == 0
    return error


@pytest.mark.parametrize("k", range(1, MAX_K + 1))
def test_order_is_one_more_than_the_back_values(k):
    # Steps short enough for the leading term, long enough to stay clear of rounding.
    steps = {
        1: (320, 640),
        2: (320, 640),
        3: (160, 320),
        4: (160, 226),
        5: (112, 160),
        6: (96, 136),
        7: (80, 112),
    }
    coarse, fine = steps[k]
    order = np.log(global_error(k, coarse) / global_error(k, fine)) / np.log(fine / coarse)
    # The next term of the error is a multiple of h times the first. Up to order 6 it has shrunk to a few
    # hundredths of it before rounding sets in; at orders 7 and 8 the error is 1e-10 when a tenth is left.
    assert order == pytest.approx(k + 1, abs=0.05 if k <= 5 else 0.2)
