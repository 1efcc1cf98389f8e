"""What else holds."""

import numpy as np

from tribodyn.wear import JumpControl, load_change

CONTROL = JumpControl(limit=0.05, depth=0.25, roughness=1.6e-6)


RATE = np.array([[0.0, 1e-11], [5e-12, 0.0]])


def test_no_jump_gains_more_than_the_depth_allowed():
    assert CONTROL.next(0.2, 0.0) == 0.25


def test_a_jump_takes_a_cycle_at_least_and_no_more_than_are_left():
    assert CONTROL.cycles(0.02, np.array([[1e-3]]), 100) == 1
    assert CONTROL.cycles(0.02, RATE, 100) == 100
    assert CONTROL.cycles(0.02, np.zeros((2, 2)), 10**12) == 10**12


def test_the_change_of_a_load_is_relative_to_its_peak():
    before = np.array([[4.0, 1.0], [0.0, 0.0]])
    after = np.array([[3.0, 1.5], [0.0, 0.2]])
    assert load_change(after, before) == 0.25
    assert load_change(after, np.zeros((2, 2))) == 0.0
