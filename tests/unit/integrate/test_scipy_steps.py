"""SciPy's solver classes under the rules of a method."""

import numpy as np
import pytest
import scipy.integrate

from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Statistics
from tribodyn.integrate.base import Segment
from tribodyn.integrate.scipy_steps import BDF, LSODA, RADAU

METHODS = [BDF, RADAU, LSODA]


def rhs(t, y):
    return np.array([y[1], 20.0 * (1.0 - y[0] ** 2) * y[1] - y[0]])


def jac(t, y):
    return np.array([[0.0, 1.0], [-40.0 * y[0] * y[1] - 1.0, 20.0 * (1.0 - y[0] ** 2)]])


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.class_name)
def test_interpolant_is_that_of_scipy(method):
    solver = getattr(scipy.integrate, method.class_name)(
        rhs, 0.0, [2.0, 0.0], 40.0, rtol=1e-5, atol=1e-8, jac=jac
    )
    interpolate = method.interpolant(solver)
    while solver.status == "running":
        solver.step()
        for t in np.linspace(solver.t_old, solver.t, 4):
            # 1e-11: sums of backward differences in another order, of terms a thousand times larger.
            np.testing.assert_allclose(interpolate(t), solver.dense_output()(t), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.class_name)
def test_steps_follow_each_other_to_the_end(method):
    statistics = Statistics()
    t = 0.0
    segment = Segment(rhs, jac, 0.0, np.array([2.0, 0.0]), 3.0, 1e-4, np.full(2, 1e-6), statistics)
    for step in method.steps(segment):
        assert step.t_old == t < step.t
        t = step.t
    assert t == 3.0
    assert statistics.lu_decompositions > 0 or method is LSODA


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.class_name)
def test_a_blow_up_ends_with_a_failure(method):
    segment = Segment(
        lambda t, y: y**2,
        lambda t, y: np.diag(2.0 * y),
        0.0,
        np.ones(1),
        2.0,
        1e-6,
        np.full(1, 1e-9),
        Statistics(),
    )
    with pytest.raises(IntegrationFailure, match=r"step|progress") as failure:
        list(method.steps(segment))
    assert failure.value.time == pytest.approx(1.0, abs=1e-3)


def test_radau_sees_a_right_hand_side_that_changed_when_the_step_was_accepted():
    damping = [1.0]
    segment = Segment(
        lambda t, y: np.array([y[1], -1e4 * y[0] - damping[0] * y[1]]),
        lambda t, y: np.array([[0.0, 1.0], [-1e4, -damping[0]]]),
        0.0,
        np.array([0.0, 1.0]),
        1.0,
        1e-4,
        np.full(2, 1e-9),
        Statistics(),
    )
    count = 0
    for _ in RADAU.steps(segment):
        count += 1
        damping[0] = 40.0 if count % 10 < 5 else 1.0
    # 534 steps with the stale derivative in the error estimate, 344 with the renewed one.
    assert count < 440
