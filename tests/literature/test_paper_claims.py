"""What the source paper says of its mechanism, from the formulation that its figures were made with.

Smooth motion is what is left without the first 0.3 s after each reversal, where the trunnion crosses its
clearance and rings. The angles of contact are θ of the gap, h = c + e_x cos θ + …, Eq. 48: the bushing point
that is named θ stands at −(cos θ, sin θ).
"""

import numpy as np
import pytest

from tribodyn.core.quantities import names
from tribodyn.joints.bushing import new_memory, pose_at
from tribodyn.kernels.joints.bushing import pressure_field
from tribodyn.kernels.joints.quantities import STATES


@pytest.fixture(scope="module", params=[20e-6, 40e-6], ids=["20um", "40um"])
def clearance(request):
    return request.param


@pytest.fixture(scope="module")
def run(clearance, vsv_run):
    return vsv_run("paper", clearance)


def smooth(run):
    return np.mod(run["t"], np.pi) > 0.3


def angle_error(run):
    return np.degrees(np.abs(run["theta_v"] - run["theta_v_ideal"]))


def test_vane_angle_error(run, clearance):
    # Section 5.3: "about 0.02°" at 20 µm and 0.043° at 40 µm. Measured: 0.0197° and 0.0468° at the most of
    # the smooth motion, 0.0172° and 0.0405° in the mean.
    low, high = {20e-6: (0.018, 0.022), 40e-6: (0.043, 0.050)}[clearance]
    assert low < angle_error(run)[smooth(run)].max() < high


def test_tilt_about_x_is_positive_and_about_y_alternates(run):
    # Section 5.3: "φ_x is always positive, φ_y is alternating positive and negative".
    phi_x, phi_y = run["phi_x"][smooth(run)], run["phi_y"][smooth(run)]
    assert phi_x.min() > 0.5e-3
    assert phi_y.min() < -0.05e-3
    assert phi_y.max() > 0.02e-3
    # In both directions it changes sign on the way, with F_airx at θ_v = 90° going forward.
    forward = run["t"][smooth(run)] < np.pi
    for direction in (forward, ~forward):
        assert phi_y[direction].min() < 0.0 < phi_y[direction].max()


def test_contact_forces(run):
    # Section 5.2: F_cx changes sign with the direction, F_cy is almost always negative, |F_cx| > |F_cy|, the
    # rigid forces are dominant.
    forward = run["t"] < np.pi
    f_x, f_y = run["F_cx"], run["F_cy"]
    assert f_x[smooth(run) & forward].min() > 15.0
    assert f_x[smooth(run) & ~forward].max() < -15.0
    assert np.mean(f_y[smooth(run)] < 0.0) > 0.9
    assert (np.abs(f_x) > np.abs(f_y))[smooth(run)].all()
    rigid = np.hypot(run["F_kx"], run["F_ky"])[smooth(run)]
    assert np.median(rigid / np.hypot(f_x, f_y)[smooth(run)]) == pytest.approx(1.0, abs=0.01)


def zone(data, theta, state):
    """Return whether each angle sees more than 5 % of the peak pressure at any height."""
    pressure = np.empty(data.wear.shape)
    pressure_field(data, new_memory(data), pose_at(state), pressure)
    return theta[(pressure > 0.05 * pressure.max()).any(axis=0)]


def test_contact_zone(run, clearance, make_joint):
    # Fig. 15: 300° to 45° going forward, 135° to 225° in reverse. Measured at 20 µm, where the zone is wider:
    # 300° to 55° and 127° to 241°; at 40 µm 310° to 48° and 139° to 229°.
    joint = make_joint(clearance, friction="moment", grid=(720, 16))
    data, theta = joint.data(), np.degrees(joint.theta)
    states = np.column_stack([run[name] for name in names(STATES)])
    settled = np.flatnonzero(np.mod(run["t"], np.pi) > 0.5)[::20]
    touched = {True: [], False: []}
    for row in settled:
        touched[bool(run["t"][row] < np.pi)].append(zone(data, theta, states[row]))
    forward = np.concatenate(touched[True])
    forward = np.where(forward > 180.0, forward - 360.0, forward)
    reverse = np.concatenate(touched[False])
    # Within 15°, and one more degree at the upper end in reverse.
    assert -60.0 - 15.0 <= forward.min() <= -60.0 + 15.0
    assert 45.0 - 15.0 <= forward.max() <= 45.0 + 15.0
    assert 135.0 - 15.0 <= reverse.min() <= 135.0 + 15.0
    assert 225.0 - 15.0 <= reverse.max() <= 225.0 + 16.5


def test_contact_is_at_the_edges(run, clearance, make_joint):
    # "The contact areas are concentrated at the edge": no pressure in the middle half of the bushing.
    joint = make_joint(clearance, friction="moment")
    data, pressure = joint.data(), np.empty(joint.field_shape)
    states = np.column_stack([run[name] for name in names(STATES)])
    for row in np.flatnonzero(np.mod(run["t"], np.pi) > 0.5)[::40]:
        pressure_field(data, new_memory(data), pose_at(states[row]), pressure)
        peaks = pressure.max(axis=1)
        assert joint.z[np.argmax(peaks)] in (joint.z[0], joint.z[-1])
        assert peaks[np.abs(joint.z) < 0.2 * 20e-3].max() < 0.05 * peaks.max()


def test_what_the_left_out_lever_moment_does(run, clearance, vsv_run):
    # The printed rows 2 and 3 of Eq. 46 leave out Z_S3 F_43, which Eqs. 41 and 42 have. With it φ_y is more
    # than ten times larger, the edge pressure four to five times, the angle error a third or more, and the
    # two ends of the trunnion bear on opposite sides.
    exact = vsv_run("exact", clearance)

    def peak(one, name):
        return np.abs(one[name])[smooth(one)].max()

    assert peak(exact, "phi_y") > 9.0 * peak(run, "phi_y")
    assert 3.5 < peak(exact, "p_max") / peak(run, "p_max") < 6.0
    low, high = {20e-6: (0.026, 0.029), 40e-6: (0.058, 0.063)}[clearance]
    assert low < angle_error(exact)[smooth(exact)].max() < high
    assert exact["phi_x"][smooth(exact)].min() > 0.0
