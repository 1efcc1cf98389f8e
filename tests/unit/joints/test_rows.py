"""Rings of nodes, as kernels take them four at a time."""

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.joints.rows import angles_of, rows_of
from tribodyn.joints.shapes import Cylinder
from tribodyn.kernels.joints.surface.data import AREA, COS, GAP, LIFT, N_ANGLE, N_NODE, NORMAL, POSITION, SIN


def nodes_and_rows(n_theta=12):
    """Return nodes and rows of a cylinder, and their number in a ring."""
    (surface,) = Cylinder(6e-3, 20e-6, 20e-3).surfaces((n_theta, 3))
    nodes = np.zeros((N_NODE, surface.area.size))
    nodes[POSITION:NORMAL], nodes[NORMAL:AREA], nodes[AREA] = (
        surface.position.T,
        surface.normal.T,
        surface.area,
    )
    return nodes, surface.rows


@pytest.mark.parametrize("n_theta", [12, 13, 14, 15])
def test_groups_hold_each_node_once(n_theta):
    nodes, own = nodes_and_rows(n_theta)
    angles = angles_of(rows_of([(own, 0)], nodes))
    assert angles.shape[1] % 4 == 0
    once = angles[LIFT] == 0.0
    theta = np.mod(np.arctan2(angles[SIN], angles[COS])[once], 2.0 * np.pi)
    np.testing.assert_allclose(theta, 2.0 * np.pi * np.arange(n_theta) / n_theta, atol=1e-12)


@pytest.mark.parametrize("entry", [POSITION, POSITION + 2, NORMAL + 1, AREA])
def test_nodes_that_are_no_ring_are_refused(entry):
    nodes, own = nodes_and_rows()
    rows_of([(own, 0)], nodes)
    nodes[entry, 17] += 1e-6
    with pytest.raises(InputError, match="equal a"):
        rows_of([(own, 0)], nodes)


def test_a_ring_has_four_nodes():
    nodes, own = nodes_and_rows(3)
    with pytest.raises(InputError, match="at least 4"):
        angles_of(rows_of([(own, 0)], nodes))


def test_a_mechanism_of_ideal_joints_has_no_rows():
    rows = rows_of([], np.zeros((N_NODE, 0)))
    assert rows.size == 0
    assert angles_of(rows).shape == (N_ANGLE, 0)


def test_rows_that_end_where_others_begin_have_gaps_of_their_own():
    nodes, own = nodes_and_rows()
    nodes[GAP] = np.arange(nodes.shape[1])[::-1]
    rows = rows_of([(own, 0), (own[:2], 0)], nodes)
    np.testing.assert_array_equal(
        rows["least"], [nodes[GAP, first + count - 1] for first, count in rows[["first", "count"]].tolist()]
    )
