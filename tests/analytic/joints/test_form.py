"""Crown and chamfers of a bushing against quadratures of the pressure, and how fast they converge."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.core.signals import spline
from tribodyn.joints import Form, Grid
from tribodyn.joints.bushing import joint_wrench
from tribodyn.joints.rows import Bore
from tribodyn.mechanisms.bushing import bushing_of
from tribodyn.mechanisms.catalogue import parse_case

LENGTH = 20e-3
#: Offset and tilt that press one end: the edge would be 1.2 σ deep in the other surface.
TILTED = np.array([16e-6, 0.0, 0.0, -6e-4, 0.0, 0.0, 0.0, 0.0])
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
    shift = joint.geometry.radius * np.tan(TILTED[3]) * np.cos(theta)  # the cross-section is an ellipse
    gap = gap + (TILTED[0] - z * np.tan(TILTED[3])) * np.cos(theta)
    gap = gap - 0.5 * shift * np.tan(TILTED[3]) * np.cos(theta)
    area = LENGTH / n_z * 2.0 * np.pi / n_theta * joint.geometry.bore_radius
    force = np.where(gap < table.h_last * sigma, pressure(np.minimum(gap / sigma, table.h_last)), 0.0)
    force = force * np.cos(theta) * area
    return force.sum(), -((z + shift) * force).sum()


@pytest.mark.parametrize("form", FORMS)
def test_wrench_is_the_integral_over_the_formed_gap(make_joint, form):
    joint = replace(make_joint(grid=(384, 64), coefficient=0.0), form=form)
    wrench = joint_wrench(joint.data(), TILTED)
    force, moment = by_hand(joint, form)
    # Midpoints on 4000 lines: 1e-5 where a chamfer's corner lies between two.
    assert wrench[0] == pytest.approx(force, rel=1e-4)
    assert wrench[3] == pytest.approx(moment, rel=1e-4)


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
            {"joint.form.chamfer_length": "1 mm", "joint.form.chamfer_depth": "1 um", "solver.grid.z": 4},
            "points of their own",
        ),
    ],
)
def test_forms_that_cannot_be(changes, words):
    with pytest.raises(InputError, match=words):
        td.simulate(td.load_case("vsv").replace(changes))


ANGLES = np.radians(np.arange(0.0, 360.0, 15.0))
HEIGHTS = np.linspace(-0.5 * LENGTH, 0.5 * LENGTH, 5)


def bore(deviation):
    """Return the measured form of a bushing from a function of angle and height [m]."""
    values = [deviation(theta, z) for theta in ANGLES for z in HEIGHTS]
    return Form(bore=Bore(ANGLES, HEIGHTS, values))


def test_a_bore_out_of_centre_is_a_trunnion_out_of_centre(make_joint):
    plain = make_joint(coefficient=0.0)
    shifted = replace(plain, form=bore(lambda theta, z: (2e-6 + 1e-4 * z) * np.cos(theta)))
    # e_x cos θ, and a tilt: z tan φ_y is subtracted.
    moved = TILTED + np.array([2e-6, 0, 0, -math.atan(1e-4), 0, 0, 0, 0])
    moved[3] = -math.atan(math.tan(-TILTED[3]) + 1e-4)
    found, expected = joint_wrench(shifted.data(), TILTED), joint_wrench(plain.data(), moved)
    # A periodic spline through 24 rows misses a cosine by 5/384 (2π/24)⁴: 6e-5 of 3 µm, or 1e-4 σ.
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-3 * np.abs(expected).max())


def test_a_measured_parabola_is_a_crown(make_joint):
    drop = spline(HEIGHTS, -4e-6 * (HEIGHTS / (0.5 * LENGTH)) ** 2)
    crowned = replace(make_joint(), form=Form(crown=4e-6))
    measured = replace(make_joint(), form=Form(profile=drop))
    np.testing.assert_allclose(measured.form_gap, crowned.form_gap, atol=1e-18)
    expected = joint_wrench(crowned.data(), TILTED)
    np.testing.assert_allclose(joint_wrench(measured.data(), TILTED), expected, atol=1e-9)


def test_a_lobed_bore_presses_where_it_is_narrow(make_joint):
    joint = replace(
        make_joint(grid=(384, 64), coefficient=0.0), form=bore(lambda t, z: 3e-6 * np.cos(2.0 * t))
    )
    theta, z = joint.theta, joint.z
    np.testing.assert_allclose(joint.form_gap, 3e-6 * np.cos(2.0 * theta) + 0.0 * z[:, None], atol=3e-9)
    along_x, along_y = np.zeros(8), np.zeros(8)
    along_x[0] = along_y[1] = 17e-6
    # At θ = 180° the bore is wide, at 270° narrow.
    assert joint_wrench(joint.data(), along_y)[1] < 5.0 * joint_wrench(joint.data(), along_x)[0] < 0.0


BORE = "angle [deg], -10 mm [um], 10 mm [um]\n0, 1, 1\n90, -1, -1\n180, 1, 1\n270, -1, -1\n"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (BORE.replace("-10 mm", "-9 mm"), "must reach its ends"),
        (BORE.replace("270, -1, -1\n", ""), "once around"),
        (BORE.replace("270", "360"), "once around"),
        (BORE.replace("180", "45"), "greater than the one before"),
        (BORE.replace("-10 mm", "left"), "names no time or length"),
        (BORE.replace("[um]", "[N]"), "not a unit of length"),
        (BORE.replace("90, -1, -1", "90, -1"), "lacks a number"),
        (BORE.replace("90, -1, -1", "90, -1, inf"), "lacks a number"),
    ],
)
def test_a_map_that_is_no_bore_is_refused(content, words, tmp_path):
    (tmp_path / "bore.csv").write_text(content)
    (tmp_path / "case.toml").write_text('case = "vsv"\n[joint.form.bushing]\nmap = "bore.csv"\n')
    with pytest.raises(InputError, match=words):
        td.load_case(tmp_path / "case.toml")


def test_measured_forms_of_a_case(tmp_path):
    (tmp_path / "bore.csv").write_text(BORE)
    (tmp_path / "pin.csv").write_text("height [mm], radius [um]\n-12, -2\n0, 0\n12, -2\n")
    (tmp_path / "case.toml").write_text(
        'case = "vsv"\n[joint.form]\nbushing.map = "bore.csv"\ntrunnion.table = "pin.csv"\n'
        '[run]\nduration = "20 ms"\n'
    )
    case = td.load_case(tmp_path / "case.toml")
    gap = bushing_of(case).form_gap
    # Two lobes of 1 µm, and 2 µm (10/12)² at the ends; the nodes next to the middle stand 1 mm off it.
    assert gap.max() == pytest.approx(1e-6 + 2e-6 * (10.0 / 12.0) ** 2, rel=1e-9)
    assert gap.min() == pytest.approx(-1e-6, abs=2e-8)
    assert not td.simulate(case).attrs["failure"]
    assert parse_case(case.to_toml(), "again") == case


def test_the_film_knows_no_form():
    with pytest.raises(InputError, match="oil film"):
        td.load_case("journal-oil").replace({"joints.bearing.clearance.form.crown": "1 um"})
