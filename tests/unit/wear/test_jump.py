import numpy as np
import pytest

from tribodyn.wear import JumpControl

CONTROL = JumpControl(limit=0.05, depth=0.25, roughness=1.6e-6)
RATE = np.array([[0.0, 1e-11], [5e-12, 0.0]])


def test_the_first_jump_gains_half_the_limit_of_the_roughness():
    assert CONTROL.cycles(CONTROL.first, RATE, 10**6) == int(0.025 * 1.6e-6 / 1e-11)


def test_jumps_grow_while_the_load_stays_and_shrink_when_it_does_not():
    assert CONTROL.next(0.02, 0.04) == pytest.approx(0.025)
    assert CONTROL.next(0.02, 0.001) == pytest.approx(0.04)
    assert CONTROL.next(0.02, 0.0) == pytest.approx(0.04)
    assert CONTROL.next(0.02, 0.5) == pytest.approx(0.01)


def test_scatter_between_cycles_does_not_stop_a_campaign():
    gain = CONTROL.first
    for _ in range(20):
        gain = CONTROL.next(gain, 1.0)
    assert gain == pytest.approx(0.1 * CONTROL.first)
