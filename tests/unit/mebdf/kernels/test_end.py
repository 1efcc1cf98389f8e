"""The end of an integration that may look beyond it: the last step goes on, and the solution comes back."""

from __future__ import annotations

import numpy as np
import pytest

from mebdf.kernels import phases
from mebdf.kernels import state as entry
from mebdf.kernels.core import resume
from mebdf.kernels.history import state_at

RTOL = 1e-6


def integrate(t, t_end):
    """Integrate the oscillator y = (cos t, −sin t); return the state at the end and the steps."""
    state = entry.new_state(t, np.array([np.cos(t), -np.sin(t)]), t_end, RTOL, np.full(2, RTOL))
    steps = []
    while True:
        request = resume(*state)
        y = state.rows[entry.Y]
        if request == phases.NEED_F:
            state.rows[entry.F] = y[1], -y[0]
        elif request == phases.NEED_JACOBIAN:
            state.matrices[entry.JACOBIAN] = [[0.0, 1.0], [-1.0, 0.0]]
        else:
            assert request == phases.STEP_ACCEPTED
            steps.append(state.number("h_last"))
            if state.number("t") == t_end:
                return state, np.array(steps)


def error(state, t):
    y = np.empty(2)
    state_at(state.numbers[0], state.rows, t, y)
    return np.abs(y - [np.cos(t), -np.sin(t)]).max()


@pytest.mark.parametrize(("t", "t_end"), [(0.0, 7.0), (7.0, 0.0), (0.0, 1e-9), (3.0, 3.0 + 1e-4)])
def test_the_solution_ends_at_the_end(t, t_end):
    state, steps = integrate(t, t_end)
    np.testing.assert_allclose(steps.sum(), t_end - t, rtol=1e-10)  # time is rounded to 1e-16
    # Some fifty errors within the tolerance add up, at the end as inside the last step.
    assert max(error(state, time) for time in np.linspace(t_end, t_end - steps[-1], 7)) < 10.0 * RTOL


def test_no_matrix_is_spent_on_the_end():
    ends = np.linspace(6.0, 6.5, 21)
    matrices = {integrate(0.0, end)[0].number("n_lu") for end in ends.tolist()}
    # Nothing but the number of steps depends on the end: at most one change of step lies within it.
    assert len(matrices) <= 2
