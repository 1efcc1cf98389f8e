from dataclasses import replace

import numpy as np
import pytest

from tribodyn.joints import Grid
from tribodyn.wear import resampled, worn_volume


@pytest.fixture(scope="module")
def joints(make_joint):
    coarse = make_joint()
    return coarse, replace(coarse, grid=Grid(4 * coarse.grid.theta, 4 * coarse.grid.z))


def edge_worn(joint):
    """Return a depth that fades away from the upper edge within 1 mm, as wear does [m]."""
    around = np.exp(-(((joint.theta - np.pi) / 0.3) ** 2))
    return 1e-6 * np.outer(np.exp((joint.z - joint.z[-1]) / 1e-3), around)


def test_nodes_of_both_grids_keep_their_depth(joints):
    coarse, fine = joints
    depth = edge_worn(coarse)
    finer = resampled(depth, coarse.z, fine.z, fine.grid.theta)
    np.testing.assert_allclose(finer[[0, -1], ::4], depth[[0, -1]], rtol=1e-12, atol=1e-24)


def test_no_depth_appears_where_there_is_none_and_none_overshoots(joints):
    coarse, fine = joints
    depth = np.zeros(coarse.field_shape)
    depth[-2:, 40:43] = 1e-6
    finer = resampled(depth, coarse.z, fine.z, fine.grid.theta)
    assert finer.min() >= 0.0
    assert finer.max() <= 1e-6 * (1.0 + 1e-12)
    assert not finer[: fine.grid.z // 2].any()


def test_volume_is_kept_as_well_as_the_rows_resolve_the_profile(joints):
    coarse, fine = joints
    finer = resampled(edge_worn(coarse), coarse.z, fine.z, fine.grid.theta)
    # Gauss rows lie 0.1, 0.5, 1.3 mm from the edge, where the depth falls by e in 1 mm: between them the
    # interpolant is off by some percent, the quadrature of the rows themselves is not.
    assert worn_volume(finer, fine.node_area[:, None]) == pytest.approx(
        worn_volume(edge_worn(coarse), coarse.node_area[:, None]), rel=0.05
    )
    assert worn_volume(edge_worn(coarse), coarse.node_area[:, None]) == pytest.approx(
        worn_volume(edge_worn(fine), fine.node_area[:, None]), rel=1e-6
    )


def test_the_profile_is_the_same_wherever_the_bushing_is_cut(joints):
    coarse, fine = joints
    depth = edge_worn(coarse)
    turned = resampled(np.roll(depth, 50, axis=1), coarse.z, fine.z, fine.grid.theta)
    finer = resampled(depth, coarse.z, fine.z, fine.grid.theta)
    np.testing.assert_allclose(turned, np.roll(finer, 200, axis=1), rtol=1e-9, atol=1e-24)
