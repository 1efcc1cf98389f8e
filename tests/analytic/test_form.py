"""Crown and chamfers of a bushing against quadratures of the pressure, and how fast they converge."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints import Form, Grid
from tribodyn.joints.bushing import joint_wrench

LENGTH = 20e-3
TILTED = np.array([16e-6, 0.0, 0.0, -6e-4, 0.0, 0.0, 0.0, 0.0])
"""Offset and tilt that press one end: the edge would be 1.2 σ deep in the other surface."""
FORMS = [Form(crown=4e-6), Form(0.0, 1e-3, 10e-6), Form(2e-6, 2e-3, 5e-6)]


def by_hand(joint, form):
    """Return F_x and M_y of the tilted trunnion on a fine mesh of midpoints, node by node."""
    table, sigma = joint.table, joint.roughness
    nodes = table.h_first + np.arange(len(table.nodes)) / table.inverse_step
    pressure = CubicHermiteSpline(nodes, table.nodes[:, 0], table.nodes[:, 1] * table.inverse_step)
    n_z, n_theta = 4000, 720
    z = LENGTH * ((np.arange(n_z) + 0.5) / n_z - 0.5)[:, None]
    theta = 2.0 * np.pi * np.arange(n_theta) / n_theta
    gap = joint.geometry.clearance + form.gap(z, LENGTH)
    gap = gap + (TILTED[0] - z * np.tan(TILTED[3])) * np.cos(theta)
    area = LENGTH / n_z * 2.0 * np.pi / n_theta * joint.geometry.bore_radius
    force = np.where(gap < table.h_last * sigma, pressure(np.minimum(gap / sigma, table.h_last)), 0.0)
    force = force * np.cos(theta) * area
    return force.sum(), -(z * force).sum()


@pytest.mark.parametrize("form", FORMS)
def test_wrench_is_the_integral_over_the_formed_gap(make_joint, form):
    joint = replace(make_joint(grid=(384, 64), coefficient=0.0), form=form)
    wrench = joint_wrench(joint.data(), TILTED)
    force, moment = by_hand(joint, form)
    # Midpoints on 4000 lines: 1e-5 where a chamfer's corner lies between two.
    assert wrench[0] == pytest.approx(force, rel=1e-4)
    assert wrench[3] == pytest.approx(moment, rel=1e-4)


def test_nodes_measure_the_bushing(make_joint):
    for form in FORMS:
        joint = replace(make_joint(grid=(96, 16)), form=form)
        whole = 2.0 * np.pi * joint.geometry.bore_radius * LENGTH
        assert joint.node_area.sum() * 96 == pytest.approx(whole, rel=1e-13)
        assert np.all(np.diff(joint.z) > 0.0)


def test_a_corner_costs_no_order(make_joint):
    """Points on each side of the corner: a rule over all would be of order 2."""
    form = Form(0.0, 2e-3, 5e-6)
    exact = joint_wrench(replace(make_joint(grid=(384, 128), coefficient=0.0), form=form).data(), TILTED)[0]
    errors = []
    for n in (8, 16, 32):
        joint = replace(make_joint(grid=(384, 16), coefficient=0.0), grid=Grid(384, n), form=form)
        errors.append(abs(joint_wrench(joint.data(), TILTED)[0] / exact - 1.0))
    # Between the second and third grid the order is above 4: that of a Gauss rule over a smooth piece.
    assert errors[0] > errors[1] > errors[2]
    assert np.log2(errors[1] / errors[2]) > 4.0


def test_a_crown_takes_pressure_from_the_edge():
    sharp = td.load_case("vsv").replace({"run.duration": "1.6 s"})
    crowned = td.simulate(sharp.replace({"joint.form.crown": "3 um"}))
    assert float(crowned.p_max[-1]) < 0.9 * float(td.simulate(sharp).p_max[-1])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"joint.form.chamfer_length": "0.5 mm"}, "both or neither"),
        ({"joint.form.chamfer_length": "9 mm", "joint.form.chamfer_depth": "1 um"}, "too little"),
        ({"joint.form.crown": "1 um", "joint.contact": "point-johnson"}, "no form"),
        (
            {
                "joint.form.chamfer_length": "1 mm",
                "joint.form.chamfer_depth": "1 um",
                "solver.grid.z": 4,
            },
            "points of their own",
        ),
    ],
)
def test_forms_that_cannot_be(changes, words):
    with pytest.raises(InputError, match=words):
        td.simulate(td.load_case("vsv").replace(changes))


def test_the_film_knows_no_form():
    with pytest.raises(InputError, match="oil film"):
        td.load_case("journal-oil").replace({"joint.form.crown": "1 um"})
