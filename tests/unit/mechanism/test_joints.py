"""What every type of joint keeps: equations, reactions, power, derivatives, refusals, over the list of types.

Two free bodies are joined, the ground takes no part, so that reactions on both bodies show.
"""

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints.clearances import assemble as surfaces
from tribodyn.joints.clearances import pose_at
from tribodyn.kernels.joints.surface.joint import wrench
from tribodyn.kernels.joints.surface.memory import new_memory
from tribodyn.kernels.mechanism.bodies import move
from tribodyn.kernels.mechanism.data import DIRECTION, N_STATES, TURNING, VELOCITY
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import Model, model_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.joints.joint_type import ALIGNED, AT_POINT, NO_TURN
from tribodyn.mechanism.shapes import SHAPES, shapes_of

OVER_ALL = pytest.mark.parametrize("kind", JOINTS)
CONSTRAINTS = [name for name, kind in JOINTS.items() if kind.ROWS]
REAL = [(name, shape) for name, kind in JOINTS.items() for shape in shapes_of(kind)]
FACES = {"axial": "30 um"}


def drawn(kind: str, **clearance: Any) -> Mechanism:
    """Return two free bodies that a joint connects, under weight."""
    found = Mechanism("Two bodies", gravity="3, -9, 2 m/s^2", run={"duration": "5 ms"})
    for name, mass, x in (("base", 5.0, -40.0), ("arm", 1.0, 60.0)):
        inertia = ", ".join(f"{mass * factor:g}" for factor in (1e-3, 2e-3, 2.5e-3))
        found.body(name, mass=f"{mass} kg", centre=f"{x}, 20, 30 mm", inertia=f"{inertia} kg m^2")
    found.joint("link", kind, "base", "arm", **JOINTS[kind].example)
    return found.clearance("link", **clearance) if clearance else found


def two_bodies(kind: str) -> Model:
    """Return two bodies and their joint; a fixed one makes no piece of them."""
    model = model_of(drawn(kind).case())
    return replace(model, apart=frozenset(model.joints))


def disturbed(kind: str) -> System:
    """Return the two bodies somewhat off, so that the joint is open, and moving."""
    system, chance = System(two_bodies(kind)), np.random.default_rng(1)
    for body in range(system.n):
        move(system.now.bodies[body], 0.1 * chance.normal(size=6) * np.repeat([0.1, 1.0], 3), np.zeros(4))
    system.now.bodies.v[:-1], system.now.bodies.w[:-1] = chance.normal(size=(2, system.n, 3))
    system.refresh()
    return system


def require_sound(kind: str) -> None:
    """Refuse equations that are open as drawn or depend on each other, and coordinates that they hold."""
    system, about = System(two_bodies(kind)), JOINTS[kind]
    assert system.entries("residual") == pytest.approx(np.zeros(len(about.ROWS)), abs=1e-12)
    matrix = system.matrix().reshape(len(about.ROWS), 6 * system.n)
    assert not about.ROWS or np.linalg.matrix_rank(matrix) == len(about.ROWS)
    axis, arm = np.array([0.0, 0.0, 1.0]), system.now.bodies.r[1]
    free = {"angle": [*np.cross(axis, arm), *axis], "position": [*axis, 0.0, 0.0, 0.0]}
    for coordinate in about.COORDINATES:
        moved = matrix @ np.concatenate([np.zeros(6), free[coordinate]])
        assert moved == pytest.approx(np.zeros(len(about.ROWS)), abs=1e-12)


@OVER_ALL
def test_constraint_equations_are_independent_and_leave_the_coordinates_free(kind: str) -> None:
    require_sound(kind)


@pytest.mark.parametrize(
    "wrong",
    [
        {"ROWS": (*AT_POINT, AT_POINT[0], *ALIGNED)},  # one equation twice
        {"ROWS": (*AT_POINT, *ALIGNED, (DIRECTION, 2, 0))},  # one that follows from the others
        {"ROWS": (*AT_POINT, *ALIGNED, NO_TURN)},  # the angle is held
        {"COORDINATES": ("angle", "position")},  # the position is held
        {"ROWS": (*AT_POINT, (DIRECTION, 2, 2))},  # parallel axes are not at right angles
    ],
)
def test_a_wrong_joint_is_found(wrong: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in wrong.items():
        monkeypatch.setattr(type(JOINTS["revolute"]), name, value)
    with pytest.raises(AssertionError):
        require_sound("revolute")


@pytest.mark.parametrize("kind", CONSTRAINTS)
def test_jacobian_times_velocities_is_the_rate_of_the_residual(kind: str) -> None:
    system, step = disturbed(kind), 1e-5
    bodies = system.now.bodies
    velocity = np.hstack([bodies.v, bodies.w])[:-1].copy()
    rate = system.matrix() @ velocity.ravel()
    assert rate == pytest.approx(system.entries("rate"), rel=1e-12, abs=1e-13)
    start, gaps = system.position(), []
    for way in (-step, step):
        system.restore(start)
        for body, change in enumerate(way * velocity):
            move(bodies[body], change, np.zeros(4))
        system.refresh()
        gaps.append(system.entries("residual"))
    assert (gaps[1] - gaps[0]) / (2.0 * step) == pytest.approx(rate, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("kind", CONSTRAINTS)
def test_reactions_on_both_bodies_have_no_resultant(kind: str) -> None:
    system = disturbed(kind)
    for row in system.matrix().reshape(-1, system.n, 6):
        force = row[:, :3].sum(axis=0)
        loads = zip(system.now.bodies[:-1], row, strict=True)
        moment = sum(body.A @ load[3:] + np.cross(body.r, load[:3]) for body, load in loads)
        assert force == pytest.approx(np.zeros(3), abs=1e-15)
        assert moment == pytest.approx(np.zeros(3), abs=1e-15)
        assert np.max(np.abs(row)) > 0.01


@OVER_ALL
def test_power_is_the_rate_of_the_energy(kind: str) -> None:
    found = assemble(two_bodies(kind))
    found.require_sound()
    problem = mechanism_problem(found, duration=1.0, rtol=1e-6, dense=True)
    y, chance, f = problem.y0.copy(), np.random.default_rng(3), np.zeros(problem.y0.size)
    states = y.reshape(-1, N_STATES)
    states[:, VELOCITY:] += chance.normal(size=(len(states), 6))
    states[:, :VELOCITY] += 1e-3 * chance.normal(size=(len(states), VELOCITY))
    problem.functions.enter(0.0, y, problem.data, problem.memory)
    problem.functions.rhs(0.0, y, problem.data, problem.memory, f)
    parts, joint = problem.data.parts, problem.memory.now.couplings[0]
    kinetic = sum(
        body.mass * state[VELOCITY:TURNING] @ change[VELOCITY:TURNING]
        + state[TURNING:] @ body.inertia @ change[TURNING:]
        for body, state, change in zip(parts.bodies, states, f.reshape(-1, N_STATES), strict=True)
    )
    weight = float(np.sum(parts.bodies.mass[:, None] * states[:, VELOCITY:TURNING] @ parts.constants.gravity))
    # Reactions do no work; springs do, and a joint has the one or the other.
    springs = float(joint.wrench @ joint.twist) if not JOINTS[kind].ROWS else 0.0
    reaction = float(np.max(np.abs(joint.multiplier[: len(JOINTS[kind].ROWS)]), initial=0.0))
    assert reaction > 1e-3 or springs != 0.0
    assert kinetic == pytest.approx(weight + springs, rel=1e-9)


@OVER_ALL
def test_derivatives_are_those_of_differences(kind: str) -> None:
    problem = mechanism_problem(assemble(two_bodies(kind)), duration=1.0, rtol=1e-6, dense=True)
    y = problem.y0 + 0.01 * np.random.default_rng(2).normal(size=problem.y0.size)
    y.reshape(-1, N_STATES)[:, VELOCITY:] *= 100.0

    def rates(at: FloatArray) -> FloatArray:
        f = np.zeros(at.size)
        problem.functions.rhs(0.0, at, problem.data, problem.memory, f)
        return f

    jacobian, step = np.zeros((y.size, y.size)), 1e-5
    problem.functions.jac(0.0, y, problem.data, problem.memory, np.zeros(y.size), jacobian)
    columns = [(rates(y + e) - rates(y - e)) / (2.0 * step) for e in step * np.eye(y.size)]
    differences = np.array(columns).T
    assert np.abs(jacobian - differences).max() < 1e-6 * np.abs(differences).max()


def refused(kind: str, reason: str, **keys: Any) -> None:
    given = {key: value for key, value in (JOINTS[kind].example | keys).items() if value is not None}
    found = drawn(kind)
    found._tables["joints"]["link"] = {"type": kind, "between": ["base", "arm"], **given}
    with pytest.raises(InputError, match=reason):
        found.case()


@OVER_ALL
def test_a_misdescribed_joint_is_refused_with_the_reason(kind: str) -> None:
    about = JOINTS[kind]
    refused(kind, "a joint connects two different bodies", between=["arm", "arm"])
    refused(kind, '"nowhere" is no body', between=["arm", "nowhere"])
    refused(kind, "it must not be parallel to axis", axis=[0, 1, 0], second_axis=[0, 2, 0])
    if about.AXIS:
        refused(kind, f"{about.named} needs the {about.AXIS}, such as axis", axis=None)
    if about.SECOND_AXIS:
        refused(kind, f"{about.named} needs the {about.SECOND_AXIS}", second_axis=None)
    for coordinate, key, value in (
        ("angle", "start_speed", "1 rad/s"),
        ("position", "start_velocity", "1 m/s"),
    ):
        if coordinate not in about.COORDINATES:
            refused(kind, f"{about.named} has no {coordinate} of its own", **{key: value})
    for other in JOINTS.values():
        if other is not about and other.NEEDED:
            refused(kind, f"this belongs to a {other.NAME}, not {about.named}", **other.NEEDED)
    if not about.SHAPE:
        refused(kind, f"{about.named} is always ideal", clearance=SHAPES["ball"].EXAMPLE)


@pytest.mark.parametrize(("kind", "shape"), REAL)
def test_a_clearance_of_another_shape_or_without_a_size_is_refused(kind: str, shape: str) -> None:
    sizes = SHAPES[shape].EXAMPLE | {"shape": shape}
    for key, meant in SHAPES[shape].NEEDED.items():
        reason = f"clearance.{key}: .*needs {meant.split(',')[0]}"
        refused(kind, reason, clearance={k: value for k, value in sizes.items() if k != key})
    for other, about in SHAPES.items():
        if other not in shapes_of(JOINTS[kind]):
            refused(kind, f"{JOINTS[kind].named} has the shape", clearance=about.EXAMPLE | {"shape": other})
        for key in about.KEYS.model_fields.keys() - SHAPES[shape].KEYS.model_fields.keys():
            if key in about.EXAMPLE:
                owners = "|".join(name for name, one in SHAPES.items() if key in one.KEYS.model_fields)
                reason = f"clearance.{key}: .*this belongs to the shape ({owners}), not to {shape}"
                refused(kind, reason, clearance=sizes | {key: about.EXAMPLE[key]})


def about_x(angle: float) -> FloatArray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


PLAYS: list[tuple[str, str, dict[str, str]]] = [(*pair, {}) for pair in REAL if pair[1] != "mesh"]
PLAYS += [(kind, "cylinder", FACES) for kind, about in JOINTS.items() if about.FACES]


@pytest.mark.parametrize(("kind", "shape", "more"), PLAYS)
def test_a_clearance_holds_what_its_ideal_counterpart_holds(kind, shape, more):
    """Beyond the play the surfaces push back along what the ideal joint holds, else nowhere."""
    model = model_of(drawn(kind, shape=shape, **SHAPES[shape].EXAMPLE, **more).case())
    clearance = model.clearances["link"]
    ideal, data = JOINTS[model.counterpart.kind("link")], surfaces([clearance])
    play, keys = SHAPES[shape].room(clearance.shape), model.case.joints["link"].real
    assert keys is not None
    assert play[0] == pytest.approx(keys.radial, rel=1e-12)
    for axis, share in itertools.product(range(3), (0.25, 2.0)):
        out, way = np.zeros(6), np.zeros(3)
        way[axis] = share * (play[1] if axis == 2 else play[0])
        wrench(data, new_memory(data), 0, pose_at(way), out)
        if axis in ideal.held and share > 1.0:
            assert out[axis] < -1.0
        else:
            assert not out.any()
    # Tilted by twice what the play allows over the length of a pin; a ball of that length turns freely.
    turned, tilt = np.zeros(6), 4.0 * play[0] / 20e-3
    wrench(data, new_memory(data), 0, pose_at(rotation=about_x(tilt)), turned)
    assert (turned[3] < -1e-3) == (ALIGNED[1] in ideal.ROWS)


def test_an_oldham_coupling_turns_shafts_at_one_speed_and_transmits_the_torque() -> None:
    # 0.3 N m on 2e-3 and 5e-3 kg m² whose axes are 4 mm apart.
    found = Mechanism("Oldham", run={"duration": "20 ms"}, solver={"rtol": 1e-8})
    for name, spin, x in (("a", 2e-3, 0.0), ("b", 5e-3, 4.0)):
        inertia = f"{spin}, {spin}, {spin} kg m^2"
        found.body(name, mass="1 kg", centre=f"{x}, 0, 0 mm", inertia=inertia)
        found.revolute(f"of-{name}", "ground", name, point=f"{x}, 0, 0 mm", axis=[0, 0, 1])
    found.oldham("coupling", "a", "b", point="0, 0, 0 mm", other_point="4, 0, 0 mm", axis=[0, 0, 1])
    result = td.simulate(found.drive("motor", "of-a", torque="0.3 N m"))
    rate = 0.3 / 7e-3
    for body in "ab":
        speed = result["angular_velocity"].sel(body=body, axis="z").values
        assert speed == pytest.approx(rate * result["time"].values, rel=1e-9, abs=1e-9)
    moment = result["reaction_moment_global"].sel(joint="coupling", axis="z").values
    assert moment == pytest.approx(5e-3 * rate, rel=1e-9)
    across = result["reaction_force_global"].sel(joint="coupling", axis=["x", "y"]).values
    assert across == pytest.approx(np.zeros(across.shape), abs=1e-12)


@pytest.mark.parametrize("kind", [name for name, about in JOINTS.items() if about.COORDINATES])
def test_friction_by_the_reaction_of_a_joint_is_refused_where_it_has_none_across_its_axis(kind: str) -> None:
    found, about = drawn(kind), JOINTS[kind]
    radius = {"radius": "10 mm"} if "angle" in about.COORDINATES else {}
    found.friction("rub", joint="link", **radius)
    if about.holds_across:
        assert found.case().frictions["rub"].normal_load is None
        return
    with pytest.raises(InputError, match=f"{about.named} has no reaction across its axis: give normal_load"):
        found.case()
