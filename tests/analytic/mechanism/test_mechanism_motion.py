"""Mechanisms with solutions in closed form, conservation laws, and their books."""

import numpy as np
import pytest
from scipy.special import ellipk
from tests.unit.mechanism.drawings import (
    body,
    bricard,
    changed,
    joint,
    mechanism,
    rod,
    run,
    slider_crank,
    spatial_slider_crank,
    vector,
    with_joints,
)

from tribodyn.cases.signals import AngleSignal, ForceMap, TorqueSignal
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.model.drives_and_loads import DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import SpringKeys

RTOL = 1e-8
TIMES = np.linspace(0.0, 2.0, 41)


CENTRE = (0.3, 0.2, 0.1)


def free_body(inertia: object = (0.02, 0.03, 0.04), spin: float = 0.0, **parts: object) -> Model:
    """Return a body of 2 kg with springs so weak that it is free, turning about z at the start."""
    weak = np.full(6, 1e-30)
    held = joint("spring-damper", ("ground", "body"), (0.0, 0.0, 0.0), stiffness=weak, damping=weak)
    joints = {"held": held.model_copy(update={"start_speed": spin})}
    return changed(mechanism({"body": body(2.0, CENTRE, inertia)}, joints), **parts)


def load(frame: str, *force: float, name: str = "body", slip: float = 1e-3) -> dict[str, LoadKeys]:
    """Return a constant force on a body at its mass centre; one number is its size against the motion."""
    size = float(np.linalg.norm(force))
    direction = vector(np.array(force) / size) if len(force) == 3 else None
    signal = ForceMap(value=size)
    keys = LoadKeys(body=name, frame=frame, direction=direction, force=signal, slip_velocity=slip)
    return {"load": keys}


def test_a_pendulum_swings_with_the_period_of_the_elliptic_integral() -> None:
    angle, length = np.radians(60.0), 1.0
    end = length * np.array([np.sin(angle), -np.cos(angle), 0.0])
    pendulum = mechanism(
        {"rod": rod((0.0, 0.0, 0.0), end)},
        {"pin": joint("revolute", ("ground", "rod"), (0.0, 0.0, 0.0))},
        gravity=(0.0, -9.81, 0.0),
    )
    period = 4.0 * np.sqrt(2.0 * length / (3.0 * 9.81)) * ellipk(np.sin(0.5 * angle) ** 2)
    result = run(pendulum, [0.0, 0.25 * period, 0.5 * period, period], RTOL)
    # A quarter later it hangs, then it has turned by twice the angle, and it comes back.
    assert result.joint(0, "joint_angle") == pytest.approx([0.0, -angle, -2.0 * angle, 0.0], abs=1e-6)
    assert np.ptp(result.energy) < 1e-6 * result.whole("energy_kinetic").max()


def test_a_free_body_tumbles_with_constant_energy_and_momentum() -> None:
    inertia = [[0.03, 0.004, 0.0], [0.004, 0.02, 0.005], [0.0, 0.005, 0.04]]
    result = run(free_body(inertia, spin=3.0), TIMES, RTOL)
    assert np.ptp(result.body(0, "angular_velocity", "x")) > 0.1
    assert np.ptp(result.energy) < 1e-6 * result.energy[0]
    for axis in "xyz":
        assert np.ptp(result.whole(f"spin_{axis}")) < 1e-6 * result.whole("spin_z")[0]


def test_a_constant_force_accelerates_and_its_work_is_booked() -> None:
    result = run(free_body(loads=load("ground", 3.0, 0.0, 1.0)), TIMES, RTOL)
    assert result.body(0, "position", "x") == pytest.approx(0.3 + 0.75 * TIMES**2, abs=1e-7)
    assert result.body(0, "velocity", "z") == pytest.approx(0.5 * TIMES, abs=1e-7)
    assert result.whole("impulse_x") == pytest.approx(3.0 * TIMES, abs=1e-9)
    assert result.imbalance < 1e-6


def test_a_force_that_turns_with_the_body_runs_on_a_circle() -> None:
    # Speed v and angular velocity v/r with the force m v²/r always across it.
    spin, radius = 2.0, 0.25
    force = 2.0 * spin**2 * radius
    # Turning about the origin as drawn: the circle is that about the joint.
    bodies = {"body": body(2.0, (radius, 0.0, 0.0), (0.02, 0.03, 0.04))}
    turning = mechanism(
        bodies,
        {"held": joint("cylindrical", ("ground", "body"), (0.0, 0.0, 0.0))},
        loads=load("body", -force, 0.0, 0.0),
    )
    pinned = run(with_joints(turning, start_speed=spin), TIMES, RTOL)
    # The load is all the centripetal force there is; nothing is left for the joint.
    assert np.abs(pinned.joint(0, "reaction_force", "x")).max() < 1e-6 * force
    assert np.abs(pinned.joint(0, "reaction_force", "y")).max() < 1e-6 * force


def test_a_load_against_the_motion_brakes_to_rest() -> None:
    sliding = mechanism(
        {"block": body(2.0, (0.0, 0.0, 0.0), (0.01, 0.01, 0.01))},
        {"guide": joint("prismatic", ("ground", "block"), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))},
        loads=load("motion", 4.0, slip=1e-6, name="block"),
    )
    result = run(with_joints(sliding, start_velocity=1.0), TIMES, 1e-7)
    # 1 m/s less 2 m/s² t until 0.5 s.
    wanted = np.where(TIMES < 0.5, TIMES - TIMES**2, 0.25)
    assert result.joint(0, "displacement", "z") == pytest.approx(wanted, abs=1e-4)


def test_a_load_against_the_motion_along_a_line_brakes_only_along_it() -> None:
    # A weight of 10 N along x, and a brake of 5 N along (0.6, 0.8).
    thrown = free_body(gravity=(5.0, 0.0, 0.0), loads=load("motion", 3.0, 4.0, 0.0, slip=1e-9))
    result = run(thrown, TIMES, RTOL)
    # The weight is more than the brake along its line holds, 6 N.
    assert result.body(0, "velocity", "x") == pytest.approx((5.0 - 2.5 * 0.6) * TIMES, abs=1e-5)
    assert result.body(0, "velocity", "y") == pytest.approx(-2.5 * 0.8 * TIMES, abs=1e-5)
    assert result.imbalance < 1e-5


def test_a_torque_and_a_spring_with_damper_on_a_shaft() -> None:
    inertia, stiffness, damping, torque = 0.04, 4.0, 0.08, 0.5
    springs = np.array([0.0, 0.0, 0.0, stiffness, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, damping, 0.0, 0.0])
    shaft = mechanism(
        {"shaft": body(1.0, (0.0, 0.0, 0.0), (0.03, 0.03, inertia))},
        {
            "bearing": joint("revolute", ("ground", "shaft"), (0.0, 0.0, 0.0)),
            "spring": joint(
                "spring-damper",
                ("ground", "shaft"),
                (0.0, 0.0, 0.0),
                stiffness=springs[0],
                damping=springs[1],
            ),
        },
        drives={"motor": DriveKeys(joint="bearing", torque=TorqueSignal(value=torque))},
    )
    result = run(shaft, TIMES, 0.25 * RTOL)
    decay, natural = 0.5 * damping / inertia, np.sqrt(stiffness / inertia)
    damped = np.sqrt(natural**2 - decay**2)
    swing = np.exp(-decay * TIMES) * (np.cos(damped * TIMES) + decay / damped * np.sin(damped * TIMES))
    assert result.joint(0, "joint_angle") == pytest.approx(torque / stiffness * (1.0 - swing), abs=1e-6)
    # Heat and work are integrals of parabolas through the ends of steps.
    assert result.imbalance < 1e-4


def test_a_drive_with_a_kink_changes_the_speed_by_an_impulse() -> None:
    knots, values = [0.0, 0.5, 1.0, 1.0, 1.5, 2.0], [0.0, 0.5, 1.0, 1.0, 1.0, 1.0]
    angle = AngleSignal(times=tuple(knots), values=tuple(values))
    driven = changed(slider_crank(), drives={"motor": DriveKeys(joint="main", angle=angle)})
    result = run(driven, TIMES, 1e-7)
    assert result.joint(0, "joint_angle") == pytest.approx(np.minimum(TIMES, 1.0), abs=1e-9)
    assert result.body(0, "angular_velocity", "z")[TIMES < 0.99] == pytest.approx(1.0, abs=1e-9)
    assert result.body(0, "angular_velocity", "z")[TIMES > 1.01] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("make", [spatial_slider_crank, bricard], ids=["spatial", "Bricard"])
def test_momentum_changes_by_gravity_and_ground_alone(make: object) -> None:
    result = run(make(), np.linspace(0.0, 1.0, 21), 1e-7)
    for name in ("momentum", "spin"):
        impulse = "impulse" if name == "momentum" else "spin_impulse"
        for axis in "xyz":
            change = result.whole(f"{name}_{axis}") - result.whole(f"{name}_{axis}")[0]
            scale = max(np.abs(result.whole(f"{name}_{a}")).max() for a in "xyz")
            # Integrals of parabolas through the ends of steps.
            assert np.abs(change - result.whole(f"{impulse}_{axis}")).max() < 1e-3 * scale


def test_other_integrators_agree() -> None:
    times = np.linspace(0.0, 0.5, 6)
    ours, other = (run(spatial_slider_crank(), times, 1e-8, solver) for solver in ("mebdf", "radau"))
    assert ours.body(2, "position", "x") == pytest.approx(other.body(2, "position", "x"), abs=1e-6)


def test_a_spring_between_two_bodies_conserves_their_momentum() -> None:
    weak = np.full(6, 1e-30)
    pair = mechanism(
        {
            "one": body(1.0, (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)),
            "two": body(3.0, (1.0, 0.2, 0.0), (0.1, 0.2, 0.15)),
        },
        {"held": joint("spring-damper", ("ground", "one"), (0.0, 0.0, 0.0), stiffness=weak, damping=weak)},
        springs={
            "spring": SpringKeys(
                between=("one", "two"),
                first_point=(0.1, 0.0, 0.0),
                second_point=(0.9, 0.0, 0.1),
                stiffness=50.0,
                damping=0.5,
                length=0.5,
            )
        },
    )
    result = run(pair, TIMES, RTOL)
    assert np.ptp(result.body(0, "position", "x")) > 0.1
    for name in ("momentum", "spin"):
        for axis in "xyz":
            assert np.abs(result.whole(f"{name}_{axis}")).max() < 1e-9
    assert result.imbalance < 1e-4
