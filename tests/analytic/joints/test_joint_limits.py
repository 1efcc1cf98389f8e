"""The bushing joint in cases that can be done by hand, and node by node without a window.

Signs: the bushing point named θ lies at −(cos θ, sin θ), and its pressure pushes the trunnion along
+(cos θ, sin θ). M_x is right-handed about X, M_y left-handed about Y.
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact import law
from tribodyn.joints.bushing import joint_report, joint_wrench

C, R_J, LENGTH = 20e-6, 6e-3, 20e-3
R_B = R_J + C
FINE = (384, 16)


def state(e_x=0.0, e_y=0.0, phi_x=0.0, phi_y=0.0, rates=(0.0, 0.0, 0.0, 0.0)):
    return np.array([e_x, e_y, phi_x, phi_y, *rates])


def seen(data, y, *, omega=0.0, sign=1.0, entry=None):
    """Return the joint's report by name."""
    return joint_report(data, y, omega=omega, sign=sign, entry_velocity=entry)


def line_load(pair, eccentricity, weight):
    """Return r_b l_z ∫P_k w(θ) dθ [N] of an untilted trunnion by adaptive quadrature, any law table aside."""
    contact, sigma = law("ke", pair), pair.roughness_rms

    def integrand(theta):
        h_star = (C - eccentricity * math.cos(theta)) / sigma
        return float(contact.stiffness_pressure(np.array([h_star]))[0]) * weight(theta)

    end = math.acos((C - 8.0 * sigma) / eccentricity)
    half = quad(integrand, 0.0, end, limit=100, epsrel=1e-9)[0]
    return 2.0 * R_B * LENGTH * half


@pytest.mark.parametrize("depth", [0.0, 1.0, 2.5])
@pytest.mark.parametrize("direction", [0.0, 1.0, 2.4, -0.3])
def test_untilted_trunnion_is_a_line_integral(make_joint, table_1_pair, depth, direction):
    eccentricity = C - depth * table_1_pair.roughness_rms
    push = np.array([math.cos(direction), math.sin(direction)])
    wrench = joint_wrench(make_joint(grid=FINE, coefficient=0.0).data(), state(*(eccentricity * push)))
    force = line_load(table_1_pair, eccentricity, math.cos)
    # Pushed back along the line of centres, to the error of the table (1e-6) and of the fine grid.
    np.testing.assert_allclose(wrench[:2], -force * push, rtol=0.0, atol=2e-6 * force)
    np.testing.assert_allclose(wrench[2:], 0.0, atol=1e-12 * force)


def test_a_centred_trunnion_in_a_narrow_clearance_is_pushed_evenly(make_joint):
    found = seen(make_joint(2e-6).data(), state(), omega=0.3)
    assert found["p_max"] > 1e7
    pressure_load = found["p_max"] * 2.0 * math.pi * (R_J + 2e-6) * LENGTH
    for name in ("F_cx", "F_cy", "F_fx", "F_fy"):
        assert abs(found[name]) < 1e-12 * pressure_load
    ratio = 0.1 / math.hypot(1.0, 1e-5 / (0.3 * R_J))
    assert found["M_jf"] == pytest.approx(-ratio * pressure_load * R_J, rel=1e-9)
    assert found["contact_fraction"] == pytest.approx(1.0)


@pytest.mark.parametrize(("tilt", "moment", "other"), [("phi_x", 2, 3), ("phi_y", 3, 2)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_tilt_is_opposed_by_its_moment(make_joint, tilt, moment, other, sign):
    # φ_x > 0 takes the top to −Y. There the bushing, named θ = 90°, pushes towards +Y: M_x = −∬z dF_y < 0.
    # φ_y > 0, left-handed, takes the top to −X; θ = 0 pushes it towards +X: M_y = −∬z dF_x < 0.
    wrench = joint_wrench(make_joint(coefficient=0.0).data(), state(**{tilt: sign * 1.95e-3}))
    assert wrench[moment] * sign < -0.01
    np.testing.assert_allclose(wrench[[0, 1, other, 4]], 0.0, atol=1e-10 * abs(wrench[moment]))


def test_moment_of_one_end(make_joint):
    # Leaning by 1.3 mrad and shifted by 8 µm, the axis meets the bushing at its top only, at −Y. The force
    # is along +Y; its arm falls short of half the length by the way over which the gap grows by about σ/2.
    found = seen(make_joint(coefficient=0.0).data(), state(e_y=-8e-6, phi_x=1.3e-3))
    assert found["F_cy"] > 1.0
    assert 0.9 < found["M_jcx"] / -found["F_cy"] / (0.5 * LENGTH) < 0.95


@pytest.mark.parametrize("angle", np.radians([0.0, 90.0, 200.0]))
@pytest.mark.parametrize("omega", [0.3, -0.3])
def test_sliding_friction_by_hand(make_joint, angle, omega):
    # Contact at the bushing point θ, which is at −(cos θ, sin θ): there the turning surface moves along
    # ω × r = ω r_j (sin θ, −cos θ) and friction holds it back. At θ = 0, ω > 0: surface −Y, friction +Y.
    push = np.array([math.cos(angle), math.sin(angle)])
    found = seen(make_joint().data(), state(*(-19e-6 * push)), omega=omega)
    normal = np.array([found["F_cx"], found["F_cy"]])
    assert normal @ push == pytest.approx(np.hypot(*normal), rel=1e-9)
    u = omega * R_J
    ratio = 0.1 * u / math.hypot(u, 1e-5)
    friction = np.array([found["F_fx"], found["F_fy"]])
    np.testing.assert_allclose(friction, -ratio * np.array([normal[1], -normal[0]]), rtol=1e-9, atol=1e-12)
    assert found["M_jf"] * omega < 0.0
    # The torque is r_j μ ∬P; ∬P exceeds the force by what its directions spread.
    assert abs(found["M_jf"]) == pytest.approx(R_J * abs(ratio) * np.hypot(*normal), rel=0.03)
    assert abs(found["M_jf"]) > R_J * abs(ratio) * np.hypot(*normal)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_friction_moment_of_the_paper(make_joint, table_1_pair, sign):
    # Eq. 45: s' μ_f ∬P r_b dA and no tangential force, whatever the speed.
    eccentricity = C - table_1_pair.roughness_rms
    found = seen(make_joint(friction="moment", grid=FINE).data(), state(-eccentricity), omega=0.3, sign=sign)
    load = line_load(table_1_pair, eccentricity, lambda theta: 1.0)
    assert found["M_jf"] == pytest.approx(sign * 0.1 * R_B * load, rel=2e-6)
    assert (found["F_fx"], found["F_fy"], found["M_fx"], found["M_fy"]) == (0.0, 0.0, 0.0, 0.0)


def test_a_centred_trunnion_in_a_wide_clearance_feels_nothing(make_joint):
    # 20 µm are 12 σ, beyond the contact law's 8.
    y = state(rates=(1e-3, -2e-3, 0.1, 0.2))
    assert not joint_wrench(make_joint().data(), y, omega=0.3).any()
    assert seen(make_joint().data(), y)["separation_min"] == pytest.approx(C)


def test_uniform_wear_is_clearance(make_joint):
    depth = 3e-6
    joint, wider = make_joint(20e-6), make_joint(23e-6)
    y = state(17e-6, 9e-6, 2e-4, -1e-4, rates=(1e-3, 0.0, 0.01, 0.0))
    worn = joint_wrench(joint.data(np.full(joint.field_shape, depth)), y, omega=0.2)
    expected = joint_wrench(wider.data(), y, omega=0.2)
    # The wider bushing also has the wider bore; its area is that of the kernel.
    np.testing.assert_allclose(worn / R_B, expected / (R_J + 23e-6), rtol=1e-12)


def test_wear_relieves_only_where_it_is(make_joint):
    joint = make_joint()
    y = state(-19e-6)
    whole = joint_wrench(joint.data(), y)
    depth = np.zeros(joint.field_shape)
    depth[:, 40:56] = 5e-6  # opposite to the contact at θ = 0
    np.testing.assert_array_equal(joint_wrench(joint.data(depth), y), whole)
    depth = np.zeros(joint.field_shape)
    depth[joint.z > 0.0] = 50e-6
    half = joint_wrench(joint.data(depth), y)
    assert half[0] == pytest.approx(0.5 * whole[0], rel=1e-12)
    # What is left carries at z < 0: M_y = −∬z dF_x > 0, with the arm l_z/4.
    assert half[3] == pytest.approx(0.25 * LENGTH * half[0], rel=5e-3)  # Gauss nodes of half an interval
