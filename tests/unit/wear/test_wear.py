"""Wear: the law, jumps of a campaign, worn profiles and running-in."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.joints import Grid
from tribodyn.wear import Archard, JumpControl, loaded_depth, resampled, worn_roughness, worn_volume


def test_depth_is_the_rate_times_the_sliding_load():
    # 10 MPa at 3 mm/s for 100 s.
    load = np.array([10e6 * 3e-3 * 100.0])
    assert Archard(1.1e-15).depth(load)[0] == pytest.approx(3.3e-9)


def test_the_papers_convention_divides_by_its_bare_number():
    load = np.array([1e6])
    assert Archard(1.1e-15, 65.0).depth(load)[0] == pytest.approx(1.1e-15 * 1e6 / 65.0)
    assert Archard(1.1e-15, 0.0).rate == 1.1e-15


def test_an_even_depth_takes_the_bore_times_the_depth(make_joint):
    joint = make_joint()
    area = 2.0 * np.pi * joint.geometry.bore_radius * joint.geometry.length
    volume = worn_volume(np.full(joint.field_shape, 1e-6), joint.node_area[:, None])
    assert volume == pytest.approx(area * 1e-6, rel=1e-13)  # rounding


def test_the_edges_have_a_depth_but_no_volume(make_joint):
    joint = make_joint()
    depth = np.zeros(joint.field_shape)
    depth[[0, -1]] = 1e-6
    assert worn_volume(depth, joint.node_area[:, None]) == 0.0


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


SIGMA = 1.6e-6


def test_half_worn_is_half_normal() -> None:
    # Cut at the mean plane, min(z, 0): mean −1/√(2π), variance 1/2 − 1/(2π).
    found = worn_roughness(SIGMA, SIGMA / math.sqrt(2.0 * math.pi), 0.0)
    assert found == pytest.approx(SIGMA * math.sqrt(0.5 - 0.5 / math.pi), rel=1e-12)


@pytest.mark.parametrize("level", [-2.0, -0.5, 0.7, 2.0])
def test_against_the_heights_themselves(level: float) -> None:
    z = np.linspace(-9.0, 9.0, 200_001)
    weight = np.exp(-0.5 * z**2) / math.sqrt(2.0 * math.pi) * (z[1] - z[0])
    cut = np.minimum(z, level)
    depth = float(np.sum(weight * (z - cut)))
    rms = math.sqrt(float(np.sum(weight * cut**2)) - depth**2)
    # Trapezium over a kink: (1e-4)².
    assert worn_roughness(SIGMA, depth * SIGMA, 0.0) == pytest.approx(rms * SIGMA, rel=1e-7)


def test_it_falls_from_the_first_to_the_last() -> None:
    depths = np.linspace(0.0, 5.0, 101) * SIGMA
    found = np.array([worn_roughness(SIGMA, depth, 0.3e-6) for depth in depths])
    assert found[0] == SIGMA
    assert np.all(np.diff(found) <= 0.0)
    assert found[-1] == 0.3e-6 == worn_roughness(SIGMA, math.inf, 0.3e-6)
    assert worn_roughness(SIGMA, 1e-6, 2.0 * SIGMA) == SIGMA


def test_the_loaded_depth_is_that_of_the_volume() -> None:
    depth, area = np.array([[0.0, 2e-6], [1e-6, 9e-6]]), np.array([[1.0, 1.0], [2.0, 0.0]])
    # Volumes of 2 and 2; the edge has a depth and no area.
    assert loaded_depth(depth, area) == pytest.approx(1.5e-6)
    assert loaded_depth(0.0 * depth, area) == 0.0


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
