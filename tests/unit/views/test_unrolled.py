"""Angles of nodes and where a bushing is cut."""

import numpy as np
import pytest
import xarray as xr

from tribodyn.views.bushing import rolled, wall_angles


def test_wall_angles_point_where_the_shaft_touches() -> None:
    """Check that the contact force at a node, along its theta, pushes away from its wall angle."""
    theta = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    angles = wall_angles(xr.Dataset(coords={"theta": theta}))
    np.testing.assert_allclose(np.cos(angles), -np.cos(theta), atol=1e-15)
    np.testing.assert_allclose(np.sin(angles), -np.sin(theta), atol=1e-15)
    assert np.all((angles >= 0.0) & (angles < 2.0 * np.pi))


@pytest.mark.parametrize("cut", [90.0, 270.0])
def test_an_angle_at_the_cut_comes_first_whatever_its_rounding(cut: float) -> None:
    theta = np.deg2rad([0.0, 90.0, 180.0, 270.0]) * (1.0 - 1e-15)
    angle, values = rolled(theta, np.arange(4.0), cut)
    assert angle[1] - angle[0] == pytest.approx(90.0)
    assert values[0] == values[-1] == cut / 90.0
