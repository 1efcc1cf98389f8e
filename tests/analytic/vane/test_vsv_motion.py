"""Every column of the motion table is the derivative that it is said to be.

States are drawn a hundred times larger than clearances allow, where the second-order terms count.
"""

from dataclasses import replace

import numpy as np
import pytest

from tribodyn.kernels.vsv import data as layout
from tribodyn.kernels.vsv.closure import sinusoid
from tribodyn.kernels.vsv.motion import fill_motion
from tribodyn.papers.cheng_2022.reduced.parameters import CrankMotion
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data

SCALE = np.array([1e-3, 1e-3, 0.05, 0.05])  #: Offsets [m] and tilts [rad]; rates are as many per second.
PARTIAL_STEP = np.array([3e-3, 1e-4, 1e-4, 1e-2, 1e-2])
TIME_STEP = 0.02
#: Differences of positions that are known to 1e-16 m: with these steps they are good to 3e-10.
ROUNDING = 1e-9

FORMULATIONS = ("exact", "paper")


def motion_table(vsv, t, q, rates):
    motion = np.zeros((layout.N_ROWS, layout.N_COLUMNS))
    mechanism = vsv_data(vsv).mechanism
    fill_motion(mechanism, sinusoid(mechanism, t), np.concatenate([q, rates]), motion)
    return motion


def draw(seed):
    """Return a time, an attitude, its rates and its accelerations."""
    random = np.random.default_rng(seed)
    q, rates, accelerations = (SCALE * random.uniform(-1.0, 1.0, 4) for _ in range(3))
    return random.uniform(0.0, 2.0 * np.pi), q, rates, accelerations


def assert_close(found, expected):
    """Compare to the largest entry of each row, or to 1e-2 where a row has nothing larger."""
    found, expected = found.reshape(layout.N_ROWS, -1), expected.reshape(layout.N_ROWS, -1)
    scale = np.maximum(np.abs(expected).max(axis=1), 1e-2)
    assert (np.abs(found - expected).max(axis=1) / scale).max() < ROUNDING


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("seed", range(4))
def test_values(make_vsv, make_positions, formulation, seed):
    vsv = make_vsv(formulation)
    t, q, rates, _ = draw(seed)
    positions = make_positions(vsv)
    value = motion_table(vsv, t, q, rates)[:, layout.VALUE]
    np.testing.assert_allclose(value, positions.at(positions.crank(t), q), rtol=0.0, atol=5e-15)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("seed", range(4))
def test_partial_derivatives(make_vsv, make_positions, formulation, seed):
    vsv = make_vsv(formulation)
    t, q, rates, _ = draw(seed)
    positions = make_positions(vsv)
    start = np.concatenate([[positions.crank(t)], q])
    expected = np.empty((layout.N_ROWS, 5))
    weights = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
    for k, step in enumerate(PARTIAL_STEP):
        line = [start + step * m * np.eye(5)[k] for m in range(-3, 4)]
        expected[:, k] = weights @ np.array([positions.at(x[0], x[1:]) for x in line]) / step
    assert_close(motion_table(vsv, t, q, rates)[:, :5], expected)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("seed", range(4))
def test_velocity_and_acceleration_along_a_path(make_vsv, make_positions, formulation, seed):
    vsv = make_vsv(formulation)
    t, q, rates, accelerations = draw(seed)

    def path(time):
        s = time - t
        return q + rates * s + 0.5 * accelerations * s**2 + 0.3 * SCALE * s**3

    velocity, acceleration = make_positions(vsv).along(path, t, TIME_STEP)
    motion = motion_table(vsv, t, q, rates)
    assert_close(motion[:, layout.VELOCITY], velocity)
    assert_close(motion[:, layout.BIAS] + motion[:, 1:5] @ accelerations, acceleration)


@pytest.mark.parametrize("seed", range(4))
def test_bias_is_the_acceleration_of_uniform_clearance_motion(make_vsv, make_positions, seed):
    vsv = make_vsv("exact")
    t, q, rates, _ = draw(seed)
    _, acceleration = make_positions(vsv).along(lambda time: q + rates * (time - t), t, TIME_STEP)
    assert_close(motion_table(vsv, t, q, rates)[:, layout.BIAS], acceleration)


def test_paper_shifts_the_rods_but_does_not_turn_them(make_vsv):
    # The clearance moves O2 by (e_x/2, e_y/2) and O3 by (e_x/2, e_y); vane, ring and link turn as the ideal.
    t, q, rates, _ = draw(0)
    motion = motion_table(make_vsv("paper"), t, q, rates)
    moved = {layout.O2_X: (1, 0.5), layout.O2_Y: (2, 0.5), layout.O3_X: (1, 0.5), layout.O3_Y: (2, 1.0)}
    for row in range(layout.OV_X):
        expected = np.zeros(4)
        if row in moved:
            expected[moved[row][0] - 1] = moved[row][1]
        np.testing.assert_array_equal(motion[row, 1:5], expected)


def test_where_the_loop_cannot_close_there_is_no_number(make_vsv):
    # At −23.57° the assemblies are about to merge; 40 µm towards the crank opens the loop.
    vsv = make_vsv("exact")
    vsv = replace(vsv, drive=CrankMotion(np.radians(-23.57), np.radians(5.0), 1.0))
    inside = motion_table(vsv, 0.0, np.array([40e-6, 0.0, 0.0, 0.0]), np.zeros(4))
    beyond = motion_table(vsv, 0.0, np.array([-40e-6, 0.0, 0.0, 0.0]), np.zeros(4))
    assert np.degrees(inside[layout.THETA_V, layout.VALUE]) == pytest.approx(30.8, abs=0.1)
    assert np.isnan(beyond[layout.THETA_V, layout.VALUE])
