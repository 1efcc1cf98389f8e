"""Work and heat of the bushing joint: virtual work, stored energy, damping heat and friction power."""

import numpy as np
import pytest

from tribodyn.joints.bushing import joint_report, joint_wrench

STENCIL = np.arange(-3.0, 4.0)
WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
#: A hundred-thousandth of what changes the pressure by about e.
STEP = 1e-5 * np.array([1.6e-6, 1.6e-6, 1.6e-4, 1.6e-4])
#: The stored energy is the exact integral of the tabulated pressure; the rest is rounding of differences.
AGREE = 1e-8


def out_of(data, y, omega, sign, entry):
    return joint_report(data, y, omega=omega, sign=sign, entry_velocity=entry)


def stored(data, q):
    y = np.concatenate([q, np.zeros(4)])
    return out_of(data, y, 0.0, 1.0, np.zeros(data.wear.shape))["energy_contact"]


def energy_slope(data, q, direction, step):
    """Return dU along ``direction`` by differences."""
    return WEIGHTS @ [stored(data, q + k * step * direction) for k in STENCIL] / step


def draw(seed, data):
    random = np.random.default_rng(seed)
    tilt = random.uniform(-1.4e-3, 1.4e-3, 2)
    eccentricity = data.clearance - random.uniform(-0.5, 3.5) * data.roughness - 0.01 * np.hypot(*tilt)
    angle = random.uniform(0.0, 2.0 * np.pi)
    rates = random.uniform(-1.0, 1.0, 4) * [3e-3, 3e-3, 0.3, 0.3]
    y = np.array([eccentricity * np.cos(angle), eccentricity * np.sin(angle), *tilt, *rates])
    return y, random.uniform(-0.4, 0.4), random.choice([0.0, 1e-3, 4e-3], size=data.wear.shape)


def powers(y, force_x, force_y, moment_x, moment_y):
    """Return the power of a wrench on the trunnion axis: a tilt moves a point at z by −z sec²φ dφ."""
    sec2 = 1.0 / np.cos(y[2:4]) ** 2
    return np.array([force_x * y[4], force_y * y[5], sec2[0] * moment_x * y[6], sec2[1] * moment_y * y[7]])


@pytest.mark.parametrize("seed", range(6))
def test_rigid_wrench_is_the_slope_of_the_stored_energy(make_joint, seed):
    # dU = −F·de − sec²φ M·dφ with no rates, so that there is no damping, and no friction.
    joint = make_joint(coefficient=0.0)
    wear = 2e-6 * np.random.default_rng(seed).random(joint.field_shape) if seed % 2 else None
    data = joint.data(wear)
    y, _, _ = draw(seed, data)
    y[4:] = 0.0
    wrench = joint_wrench(data, y)[:4] / np.array([1.0, 1.0, *np.cos(y[2:4]) ** 2])
    slope = np.array([energy_slope(data, y[:4], np.eye(4)[k], STEP[k]) for k in range(4)])
    scale = STEP / STEP[0]
    size = np.abs(wrench * scale).max()
    np.testing.assert_allclose(slope * scale, -wrench * scale, rtol=0.0, atol=AGREE * size)


@pytest.mark.parametrize("clip", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_normal_power_is_stored_energy_and_damping_heat(make_joint, seed, clip):
    data = make_joint(clip=clip).data()
    y, omega, entry = draw(seed, data)
    out = out_of(data, y, omega, 1.0, entry)
    terms = powers(y, out["F_cx"], out["F_cy"], out["M_jcx"], out["M_jcy"])
    rate = energy_slope(data, y[:4], y[4:], 1e-9 / np.abs(y[4:6]).max() * 1e-2)
    assert terms.sum() + rate + out["damping_power"] == pytest.approx(0.0, abs=AGREE * np.abs(terms).max())


def test_damping_takes_and_never_gives(make_joint):
    # The heat is ∬(P_c − P_k) δ̇: damping pressure has the sign of δ̇, and so has what is left of it
    # where the clip cuts it off.
    data = make_joint().data()
    heats = []
    for seed in range(40):
        y, omega, entry = draw(seed, data)
        heats.append(out_of(data, y, omega, 1.0, entry)["damping_power"])
    assert min(heats) >= 0.0
    assert np.count_nonzero(heats) > 30


@pytest.mark.parametrize("friction", ["traction", "moment"])
@pytest.mark.parametrize("seed", range(6))
def test_friction_power_is_that_of_the_friction_wrench(make_joint, seed, friction):
    # With traction Σ τ u over the nodes; with the friction moment M_jf ω_v. Both only ever take power,
    # the moment with the sign that opposes the turning.
    data = make_joint(friction=friction).data()
    y, omega, entry = draw(seed, data)
    out = out_of(data, y, omega, -np.sign(omega), entry)
    terms = powers(y, out["F_fx"], out["F_fy"], out["M_fx"], out["M_fy"])
    every = [*terms, out["M_jf"] * omega]
    assert out["friction_power"] == pytest.approx(sum(every), rel=1e-11)
    assert out["friction_power"] < 0.0


def test_the_opposite_tangent_would_conserve_power_too(make_joint):
    # Why the sign of t is tested by hand in test_joint_limits.py: for the same slip and traction the force
    # of −t does the same work on −u. Here the slip of the bearing point itself decides: the trunnion slides
    # along X without turning, touching the bushing on its −Y side, and is held back.
    data = make_joint().data()
    y = np.zeros(8)
    y[1], y[4] = -19e-6, 1e-3
    out = out_of(data, y, 0.0, 1.0, np.zeros(data.wear.shape))
    assert out["F_cy"] > 1.0
    assert out["F_fx"] == pytest.approx(-0.1 * out["F_cy"], rel=0.05)
    # Sliding along +X below its axis, the surface is dragged towards −X: a moment r_j F about −Z... r × F
    # = (−r_j ŷ) × (−F x̂) = −r_j F ẑ.
    assert out["M_jf"] == pytest.approx(6e-3 * out["F_fx"], rel=0.05)
