"""Rows of an end face follow those of the barrel: their quadrature is as fine up to the largest tilt."""

import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.joints.shapes.cylinder import FEWEST_ACROSS, Cylinder
from tribodyn.kernels.lookup import pressure_and_damping
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of

LOADED = 0.1  #: Force [N] from which a relative error means anything; the face of the vane carries a few.


@pytest.fixture(scope="module")
def trunnion():
    return clearances_of(td.load_case("vsv-free"))["trunnion"]


def _wrench(clearance, grid, tilt, least):
    """Return force and moment about x of the upper face, tilted, whose least gap is given."""
    face = clearance.shape.surfaces(grid)[1]
    turned = np.cross([tilt, 0.0, 0.0], face.position)
    gap = face.gap - np.sum(face.normal * turned, axis=1)
    gap += least - gap.min()  # at the edge, which is a row of nodes
    rigid = [pressure_and_damping(clearance.table, h)[0] for h in gap / clearance.roughness]
    force = face.area * np.array(rigid)
    return force.sum(), force @ face.position[:, 1]


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75, 1.0])
def test_face_on_the_default_grid(trunnion, share):
    # Measured: 3e-5 at the largest tilt, less below it; with six rows 2e-2.
    shape, (n_theta, n_z) = trunnion.shape, trunnion.grid
    tilt = share * 2.0 * shape.clearance / shape.length
    compared = 0
    for least in (3.0, 2.0, 1.0):
        force, moment = _wrench(trunnion, trunnion.grid, tilt, least * trunnion.roughness)
        exact, about = _wrench(trunnion, (n_theta, 4 * n_z), tilt, least * trunnion.roughness)
        if exact > LOADED:
            compared += 1
            assert force == pytest.approx(exact, rel=1e-4)
            assert moment == pytest.approx(about, rel=1e-4)
    assert compared > 0


@pytest.mark.parametrize(("flange", "rows"), [(7.02e-3, FEWEST_ACROSS), (11.02e-3, 8), (46.02e-3, 16)])
def test_number_of_rows(flange, rows):
    shape = Cylinder(radius=6e-3, clearance=20e-6, length=20e-3, axial=50e-6, flange=flange)
    rho = shape.surfaces((64, 16))[1].axes["rho"]
    assert rho.size == rows + 2  # the edges are rows, too
    assert math.isclose(rho[-1], flange)
