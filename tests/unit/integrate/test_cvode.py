"""CVODE under the rules of a method."""

import sys

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.core.problem import Statistics
from tribodyn.integrate.base import Segment
from tribodyn.integrate.scipy_steps import CVODE


def rhs(t, y):
    return np.array([y[1], 20.0 * (1.0 - y[0] ** 2) * y[1] - y[0]])


def jac(t, y):
    return np.array([[0.0, 1.0], [-40.0 * y[0] * y[1] - 1.0, 20.0 * (1.0 - y[0] ** 2)]])


def steps(t_end=20.0):
    start = np.array([2.0, 0.0])
    return CVODE.steps(Segment(rhs, jac, 0.0, start, t_end, 1e-6, np.full(2, 1e-8), Statistics()))


def test_interpolation_does_not_disturb_the_steps():
    pytest.importorskip("sksundae")
    plain = [(step.t, *step.y) for step in steps()]
    looked_into = []
    for step in steps():
        for share in (0.1, 0.5, 1.0, 0.0):
            step.interpolate(step.t_old + share * (step.t - step.t_old))
        looked_into.append((step.t, *step.y))
    np.testing.assert_array_equal(looked_into, plain)
    assert plain[-1][0] == 20.0


def test_without_the_package_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "sksundae.cvode", None)
    with pytest.raises(InputError, match=r"tribodyn\[sundials\]"):
        CVODE.prepare()
