"""The point contact of a trunnion: its force, its derivatives, its power, and the laws themselves."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.bushings import joint_jacobian

from mebdf.arrays import FloatArray
from tribodyn.contact import RSDC, SurfacePair, law
from tribodyn.contact.bounce import bounce
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint, point_table
from tribodyn.joints.bushing import contact_energy, joint_report, joint_wrench, new_memory, pose_at
from tribodyn.joints.point_contact import POINT_CONTACTS, johnson, lankarani_nikravesh
from tribodyn.kernels.joints.bushing import pressure_field, update_entry_velocity

MakeJoint = Callable[..., BushingJoint]


@pytest.fixture(params=POINT_CONTACTS)
def joint(request: pytest.FixtureRequest, make_joint: MakeJoint, table_1_pair: SurfacePair) -> BushingJoint:
    return make_point(request.param, make_joint, table_1_pair)


def make_point(name: str, make_joint: MakeJoint, pair: SurfacePair, **options: object) -> BushingJoint:
    surface = make_joint(**options)
    table = point_table(name, RSDC(pair), surface.geometry)
    return dataclasses.replace(surface, contact=name, table=table)


def test_force_stands_on_the_line_of_centres(joint: BushingJoint) -> None:
    data = joint.data()
    y = np.zeros(8)
    y[:2] = 21e-6 * np.cos(0.7), 21e-6 * np.sin(0.7)
    wrench = joint_wrench(data, y)
    expected, _ = POINT_CONTACTS[joint.contact](np.array([1e-6]), 7.818e9, joint.geometry)
    # The composite modulus is given to four digits.
    np.testing.assert_allclose(wrench[:2], -expected[0] * np.array([np.cos(0.7), np.sin(0.7)]), rtol=1e-4)
    assert wrench[2:4] == pytest.approx(0.0, abs=1e-12)  # both ends carry the same


def test_each_end_remembers_its_own_entry(joint: BushingJoint) -> None:
    data = joint.data()
    memory = new_memory(data)
    lower, upper = 0, 1  # places of the two ends among the nodes
    entry = memory.entry_velocity.ravel()
    # The top leans outwards: it is 22 µm off the axis, the bottom 18 µm.
    y = np.array([20e-6, 0.0, 0.0, -2e-4, 5e-3, 0.0, 0.0, 0.0])
    update_entry_velocity(data, memory, pose_at(y), 0.0)
    assert entry[upper] == pytest.approx(5e-3)
    assert entry[lower] == 0.0
    y[4] = 9e-3
    update_entry_velocity(data, memory, pose_at(y), 0.0)
    assert entry[upper] == pytest.approx(5e-3)  # kept
    update_entry_velocity(data, memory, pose_at(np.zeros(8)), 0.0)
    assert not entry.any()  # forgotten
    update_entry_velocity(data, memory, pose_at(y), 1.0)
    assert entry[upper] == pytest.approx(1e-3)  # v_min at the start


def test_lankarani_and_nikravesh_is_the_sphere_of_hertz(joint: BushingJoint) -> None:
    modulus, depth = 7.8e9, np.array([1e-7, 1e-6, 5e-6])
    force, _ = lankarani_nikravesh(depth, modulus, joint.geometry)
    # Published: K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i − R_j)), σ = (1 − ν²)/E.
    expected = 4.0 / 3.0 * modulus * math.sqrt(6.02e-3 * 6e-3 / 20e-6) * depth**1.5
    np.testing.assert_allclose(force, expected, rtol=1e-12)


def test_johnson_satisfies_its_implicit_formula(joint: BushingJoint) -> None:
    modulus, geometry = 7.8e9, joint.geometry
    for depth in (1e-9, 1e-7, 1e-6, 7e-6):

        def excess(load: float, depth: float = depth) -> float:
            ratio = 4.0 * math.pi * modulus * geometry.clearance / load
            return load / (math.pi * modulus) * (math.log(ratio) - 1.0) - depth

        load = brentq(excess, 1e-6, 4.0 * math.pi * modulus * geometry.clearance * math.exp(-2.0))
        force, slope = johnson(np.array([depth]), modulus, geometry)
        assert force[0] == pytest.approx(load * geometry.length, rel=1e-9)
        ahead, _ = johnson(np.array([depth * (1 + 1e-5), depth * (1 - 1e-5)]), modulus, geometry)
        assert slope[0] == pytest.approx((ahead[0] - ahead[1]) / (2e-5 * depth), rel=1e-8)
    # Beyond 8c/e³, where the formula turns steep before it ends, it goes on as a straight line.
    edge = 8.0 * geometry.clearance * math.exp(-3.0)
    force, slope = johnson(np.array([edge, edge + 1e-6, edge + 2e-6]), modulus, geometry)
    np.testing.assert_allclose(np.diff(force), slope[0] * 1e-6, rtol=1e-9)


def test_table_follows_the_law(joint: BushingJoint) -> None:
    depth = np.linspace(0.2e-6, 12e-6, 37)
    expected, _ = POINT_CONTACTS[joint.contact](depth, joint_modulus(joint), joint.geometry)
    found = [-joint_wrench(joint.data(), np.array([20e-6 + d, 0.0, *np.zeros(6)]))[0] for d in depth]
    # Cubic interpolation on 4096 intervals of 5 nm.
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def joint_modulus(joint: BushingJoint) -> float:
    return 1.0 / ((1.0 - 0.27**2) / 203e9 + (1.0 - 0.34**2) / 7.17e9)


@pytest.mark.parametrize("name", POINT_CONTACTS)
@pytest.mark.parametrize("wanted", [0.3, 0.7, 0.95])
def test_calibrated_point_contact_returns_what_is_asked(name, wanted, make_joint, table_1_pair):
    chosen = law("gw", table_1_pair, damping_factor="calibrated", restitution=wanted)
    table = point_table(name, chosen, make_joint().geometry)
    # An impact that reaches 50 N on each end without damping. 1e-3 is asked for.
    made = bounce(table, onset=0.0, design_pressure=50.0)
    assert made.restitution == pytest.approx(wanted, abs=1e-5)


def test_a_dashpot_is_refused(make_joint: MakeJoint, table_1_pair: SurfacePair) -> None:
    chosen = law("gw", table_1_pair, damping_factor="kelvin-voigt", restitution=0.7)
    with pytest.raises(InputError) as caught:
        point_table("point-johnson", chosen, make_joint().geometry)
    assert caught.value.key == "contact.damping_factor"


#: What makes about the same difference in each argument.
SCALE = np.array([1e-6, 1e-6, 1e-4, 1e-4, 1e-3, 1e-3, 0.1, 0.1, 0.17])


STENCIL = np.arange(-3.0, 4.0)


WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0


def draw(seed: int) -> tuple[FloatArray, FloatArray]:
    """Return arguments, both ends or one of them in contact, and entry velocities of (18, 96) nodes."""
    random = np.random.default_rng(seed)
    arguments = random.uniform(-1.0, 1.0, 9) * [0, 0, 5e-4, 5e-4, 3e-3, 3e-3, 0.3, 0.3, 0.4]
    angle, reach = random.uniform(0.0, 2.0 * np.pi), random.uniform(19e-6, 26e-6)
    arguments[:2] = reach * np.cos(angle), reach * np.sin(angle)
    memory = np.zeros((18, 96))
    memory[[0, -1], 0] = random.choice([0.0, 1e-3, 3e-3], size=2)
    return arguments, memory


@pytest.mark.parametrize("friction", ["traction", "moment"])
@pytest.mark.parametrize("name", POINT_CONTACTS)
def test_derivatives(name: str, friction: str, make_joint: MakeJoint, table_1_pair: SurfacePair) -> None:
    data = make_point(name, make_joint, table_1_pair, friction=friction, slip_velocity=1e-4).data()
    compared = 0
    for seed in range(60):
        x, memory = draw(seed)
        memory[memory == 0.0] = 2e-3  # without a memory there is a kink at v_min
        state = dict(sign=1.0 if seed % 2 else -1.0, entry_velocity=memory)
        found = joint_jacobian(data, x[:8], omega=x[8], **state)
        columns = []
        for k in range(9):
            step = 1e-4 * SCALE[k]
            points = x + np.outer(STENCIL * step, np.eye(9)[k])
            values = [joint_wrench(data, p[:8], omega=p[8], **state) for p in points]
            columns.append(WEIGHTS @ np.array(values) / step)
        largest = np.maximum(np.abs(found * SCALE).max(axis=1), 1e-2)
        error = np.abs(found - np.array(columns).T) * SCALE
        # The table is a cubic on intervals of 5 nm, of which the stencil may pass one corner of third order.
        assert (error.max(axis=1) <= 1e-5 * largest).all(), f"state {seed}"
        compared += bool(found.any())
    assert compared > 40


def test_tilt_is_resisted(joint: BushingJoint) -> None:
    data = joint.data()
    y = np.array([0.0, 0.0, 3e-3, 2e-3, 0.0, 0.0, 0.0, 0.0])
    wrench = joint_wrench(data, y)
    assert wrench[:2] == pytest.approx(0.0, abs=1e-9)  # the ends push in opposite directions
    assert wrench[2] * y[2] < 0.0
    assert wrench[3] * y[3] < 0.0
    np.testing.assert_allclose(wrench[2] / wrench[3], 1.5, rtol=1e-5)  # tan of 3 and 2 mrad


def test_no_force_inside_the_clearance_circle(joint: BushingJoint) -> None:
    y = np.array([14e-6, -14e-6, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    assert not joint_wrench(joint.data(), y, omega=1.0).any()
    assert not joint_jacobian(joint.data(), y, omega=1.0).any()


def test_report_agrees_with_the_wrench_and_its_power(joint: BushingJoint) -> None:
    data = joint.data()
    for seed in range(20):
        x, memory = draw(seed)
        y, omega = x[:8], x[8]
        out = joint_report(data, y, omega=omega, entry_velocity=memory)
        wrench = joint_wrench(data, y, omega=omega, entry_velocity=memory)
        normal, friction = np.array([out["F_cx"], out["F_cy"]]), np.array([out["F_fx"], out["F_fy"]])
        np.testing.assert_allclose(normal + friction, wrench[:2], rtol=1e-12, atol=1e-12)
        tilts = np.array([out["M_jcx"], out["M_jcy"]]) + np.array([out["M_fx"], out["M_fy"]])
        np.testing.assert_allclose(tilts, wrench[2:4], rtol=1e-12, atol=1e-12)
        assert out["M_jf"] == pytest.approx(wrench[4], rel=1e-12, abs=1e-15)
        rates = np.array([y[4], y[5], y[6] / np.cos(y[2]) ** 2, y[7] / np.cos(y[3]) ** 2, omega])
        h = 1e-7
        later, before = (
            contact_energy(data, y + s * h * np.append(y[4:], np.zeros(4)), memory) for s in (1, -1)
        )
        rate = (later - before) / (2.0 * h)
        power = out["friction_power"] - out["damping_power"] - rate
        # The stored energy is differenced over 0.1 µs, in which its rate changes by some 1e-6.
        assert wrench @ rates == pytest.approx(power, rel=1e-4, abs=1e-8)


def test_a_point_has_no_pressure_field(joint: BushingJoint) -> None:
    pressure = np.ones(joint.field_shape)
    data = joint.data()
    pressure_field(data, new_memory(data), pose_at(np.array([22e-6, *np.zeros(7)])), pressure)
    assert not pressure.any()
