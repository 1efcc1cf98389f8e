"""The derivative of the joint's wrench is exact, in and out of contact, with and without memory.

Compared with sixth-order differences. The pressure of a node has kinks: where the tensile clip begins,
and, as long as a node has no memory, where its approach speed passes the least entry velocity. A state
with a node that a kink separates from one of its difference points has no difference to compare with;
such states are left out and counted.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from tribodyn.joints.bushing import joint_jacobian, joint_wrench, new_memory, pose_at
from tribodyn.kernels.joints.bushing import wrench, wrench_and_jacobian
from tribodyn.kernels.joints.surface.data import COS, SIN, table_of

STENCIL = np.arange(-3.0, 4.0)
WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
#: What makes about the same difference in each argument: σ, σ over half the length, v_min, and the like.
SCALE = np.array([1.6e-6, 1.6e-6, 1.6e-4, 1.6e-4, 1e-3, 1e-3, 0.1, 0.1, 0.17])
#: Small against the 1/128 σ between nodes of the contact table, where its second derivative jumps, and
#: against the slip velocity of 1e-2 of v_min; large against rounding, 1e-15 σ of a gap.
STEP = SCALE * np.array([1e-5] * 4 + [1e-4] * 5)
#: Of the largest entry of the row, in the units of :data:`SCALE`; 5e-10 is what these states reach.
AGREE = 1e-8
NEGLIGIBLE = 1e-6  #: Row [N or N m] below which only the end of the contact table, 8 σ apart, is felt.
STATES = 80


def draw(seed, data):
    """Return arguments (8 states and ω_v) and entry velocities, from deep contact to none."""
    random = np.random.default_rng(seed)
    arguments = random.uniform(-1.0, 1.0, 9) * [0, 0, 1.5e-3, 1.5e-3, 3e-3, 3e-3, 0.3, 0.3, 0.4]
    slow = random.random() < 0.3
    if slow:  # slip of the order of the slip velocity
        arguments[4:] *= 1e-3
    nearest = random.uniform(-1.0, 9.0) * data.roughness
    eccentricity = data.clearance - nearest - 0.01 * np.hypot(*arguments[2:4])
    angle = random.uniform(0.0, 2.0 * np.pi)
    arguments[:2] = eccentricity * np.cos(angle), eccentricity * np.sin(angle)
    entry = random.choice([0.0, 1e-3, 3e-3], size=data.wear.shape)
    return arguments, entry


def pressures(table, h_star):
    """Return P_k and C [Pa] from the contact table."""
    nodes = np.linspace(table.h_first, table.h_last, table.nodes.shape[0])
    return [
        CubicHermiteSpline(nodes, table.nodes[:, k], table.nodes[:, k + 1] * table.inverse_step)(
            np.clip(h_star, table.h_first, table.h_last)
        )
        for k in (0, 2)
    ]


def side_of_kinks(data, arguments, entry):
    """Return for each node in reach on which side of its kinks it is."""
    e_x, e_y, phi_x, phi_y, v_x, v_y, w_x, w_y, _ = arguments
    surface, n_theta = data.surface.surfaces[0], data.wear.shape[1]
    cos, sin = data.surface.angles[COS, :n_theta], data.surface.angles[SIN, :n_theta]
    z = data.z[:, None]
    gap = data.clearance + (e_x - z * np.tan(phi_y)) * cos + (e_y - z * np.tan(phi_x)) * sin + data.wear
    v_a, v_b = v_x - z * w_y / np.cos(phi_y) ** 2, v_y - z * w_x / np.cos(phi_x) ** 2
    approach = -(v_a * cos + v_b * sin)
    fresh = np.maximum(np.abs(approach), surface["minimum_entry_velocity"])
    reference = np.where(entry > 0.0, entry, fresh)
    rigid, damping = pressures(table_of.py_func(data.surface, surface), gap / data.roughness)
    tensile = rigid + damping * approach / reference <= 0.0
    slower = (entry == 0.0) & (damping > 0.0) & (np.abs(approach) < surface["minimum_entry_velocity"])
    # The outermost rows stand on the edges and carry no area.
    return np.stack([tensile & (damping > 0.0), slower])[:, 1:-1]


def differences(data, arguments, entry, sign):
    """Return ∂wrench/∂arguments (5, 9), or None where a kink is in the way."""
    here = side_of_kinks(data, arguments, entry)
    columns = []
    for k in range(9):
        points = arguments + np.outer(STENCIL * STEP[k], np.eye(9)[k])
        if any((side_of_kinks(data, point, entry) != here).any() for point in points[[0, -1]]):
            return None
        values = [joint_wrench(data, p[:8], omega=p[8], sign=sign, entry_velocity=entry) for p in points]
        columns.append(WEIGHTS @ np.array(values) / STEP[k])
    return np.array(columns).T


def wear_of(grid):
    """Return a wear depth of up to 1 µm that differs from node to node [m]."""
    return 1e-6 * np.random.default_rng(7).random((grid[1] + 2, grid[0]))


@pytest.mark.parametrize("worn", [False, True])
@pytest.mark.parametrize("friction", ["traction", "moment"])
def test_jacobian_against_differences(make_joint, friction, worn):
    grid = (48, 8)
    data = make_joint(friction=friction, grid=grid).data(wear_of(grid) if worn else None)
    skipped = touching = clipped = 0
    for seed in range(STATES):
        arguments, entry = draw(seed, data)
        sign = 1.0 if seed % 2 else -1.0
        expected = differences(data, arguments, entry, sign)
        if expected is None:
            skipped += 1
            continue
        found = joint_jacobian(data, arguments[:8], omega=arguments[8], sign=sign, entry_velocity=entry)
        error = np.abs(found - expected) * SCALE
        largest = np.maximum(np.abs(expected * SCALE).max(axis=1), NEGLIGIBLE)
        assert (error.max(axis=1) <= AGREE * largest).all(), f"state {seed}"
        touching += largest[0] > NEGLIGIBLE
        clipped += side_of_kinks(data, arguments, entry)[0].any()
    assert skipped < STATES / 20
    assert touching > STATES / 2
    assert clipped > STATES / 10


def test_wrench_of_both_kernels_is_the_same(make_joint):
    data = make_joint().data()
    for seed in range(20):
        arguments, entry = draw(seed, data)
        out, alone, jacobian = np.empty(6), np.empty(6), np.empty((6, 12))
        memory, pose = new_memory(data, entry), pose_at(arguments[:8], omega=arguments[8])
        wrench_and_jacobian(data, memory, pose, out, jacobian)
        wrench(data, memory, pose, alone)
        # Two orders of the same sums over some hundred nodes.
        np.testing.assert_allclose(out, alone, rtol=0.0, atol=1e-13 * np.abs(out).max())


def test_no_contact_no_derivative(make_joint):
    data = make_joint().data()
    y = np.array([1e-6, -2e-6, 1e-4, 2e-4, 1e-3, 1e-3, 0.1, 0.1])
    assert not joint_jacobian(data, y, omega=0.2).any()
    assert not joint_wrench(data, y, omega=0.2).any()
