import numpy as np
import pytest

from tribodyn.wear import Archard, worn_volume


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
