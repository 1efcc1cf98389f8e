"""Derivatives of the equations of motion, and the blocks of the iteration matrix, against differences."""

import numpy as np
import pytest
from tests.unit.mechanism.drawings import body, joint, mechanism, vector

from mebdf.arrays import FloatArray
from tribodyn.cases.signals import AngleSignal, ForceMap, ForceSignal, TorqueMap, VelocitySignal
from tribodyn.core.problem import Problem
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import JointKeys, SpringKeys

Signal = AngleSignal | ForceSignal | ForceMap | TorqueMap | VelocitySignal
T = 0.3
FRAMES = ("ground", "body", "motion")
WRENCH = ("force", "moment")


def _everything() -> Model:
    """Return a mechanism with every kind of row, drive, load and spring, anywhere in space."""
    rng = np.random.default_rng(1)

    def signal(kind: type[Signal]) -> Signal:
        value, amplitude, phase = rng.normal(size=3).tolist()
        frequency = float(np.abs(rng.normal()))
        return kind(value=value, amplitude=amplitude, angular_frequency=frequency, phase=phase)

    def any_body() -> BodyKeys:
        root = rng.normal(size=(3, 3))
        moments, axes = np.linalg.eigh(root @ root.T)
        # Moments of three masses along these axes.
        inertia = axes @ np.diag(sum(moments) - moments) @ axes.T
        return body(rng.uniform(0.5, 2.0), rng.normal(size=3), inertia)

    def any_joint(kind: str, between: tuple[str, str], *springs: FloatArray) -> JointKeys:
        return joint(kind, between, *rng.normal(size=(3, 3)), *springs)

    bodies = {f"body {k}": any_body() for k in range(4)}
    b = list(bodies)
    # None about the axis: its turning moment is differentiated but for the second order of the tilt.
    springs = np.array([3.0, 4.0, 5.0, 0.0, 2.0, 1.0]), np.full(6, 0.3)
    joints = {
        "revolute": any_joint("revolute", ("ground", b[0])),
        "universal": any_joint("universal", (b[0], b[1])),
        "cylindrical": any_joint("cylindrical", (b[1], b[2])),
        "prismatic": any_joint("prismatic", (b[2], b[3])),
        "soft": any_joint("spring-damper", ("ground", b[3]), *springs),
        "spherical": any_joint("spherical", (b[3], b[0])),
    }
    drives = {
        "turn": DriveKeys(joint="revolute", angle=signal(AngleSignal)),
        "slide": DriveKeys(joint="cylindrical", velocity=signal(VelocitySignal)),
        "push": DriveKeys(joint="prismatic", force=signal(ForceSignal)),
    }

    def load(k: int, frame: str, kind: str, *, aimed: bool = True) -> LoadKeys:
        what = {"force": ForceMap, "moment": TorqueMap}[kind]
        return LoadKeys(
            body=b[k],
            point=vector(rng.normal(size=3)),
            frame=frame,
            direction=vector(rng.normal(size=3)) if aimed else None,
            slip_velocity=0.3,
            slip_rate=0.3,
            **{kind: signal(what)},
        )

    def over_speed(kind: str, *, aimed: bool) -> LoadKeys:
        name, what = {"force": ("velocities", ForceMap), "moment": ("speeds", TorqueMap)}[kind]
        table = what(values=tuple(rng.normal(size=4).tolist()), **{name: (0.0, 1.0, 2.0, 9.0)})
        return load(1, "motion", kind, aimed=aimed).model_copy(update={kind: table})

    loads = {f"{frame} {kind}": load(k, frame, kind) for k, frame in enumerate(FRAMES) for kind in WRENCH}
    loads |= {f"against {kind}": load(3, "motion", kind, aimed=False) for kind in WRENCH}
    loads |= {
        f"over the speed {kind} {aimed}": over_speed(kind, aimed=aimed)
        for kind in WRENCH
        for aimed in (True, False)
    }
    between = SpringKeys(
        between=(b[0], b[3]),
        first_point=vector(rng.normal(size=3)),
        second_point=vector(rng.normal(size=3)),
        stiffness=3.0,
        damping=0.7,
        length=0.2,
    )
    return mechanism(
        bodies, joints, rng.normal(size=3), drives=drives, loads=loads, springs={"spring": between}
    )


def _state(problem: Problem) -> FloatArray:
    """Return a state that is not on the constraints, its quaternions not of length one."""
    return problem.y0 + 0.2 * np.random.default_rng(2).normal(size=problem.y0.size)


def _rhs(problem: Problem, y: FloatArray) -> FloatArray:
    f = np.zeros(y.size)
    problem.functions.rhs(T, y, problem.data, problem.memory, f)
    return f


def _jacobian(problem: Problem, y: FloatArray) -> FloatArray:
    jacobian, f = np.zeros((y.size, y.size)), np.zeros(y.size)
    problem.functions.jac(T, y, problem.data, problem.memory, f, jacobian)
    assert f == pytest.approx(_rhs(problem, y), rel=1e-12)
    return jacobian


def test_jacobian_is_that_of_differences() -> None:
    problem = mechanism_problem(assemble(_everything()), duration=1.0, rtol=1e-6, dense=True)
    y = _state(problem)
    jacobian = _jacobian(problem, y)
    step = 3e-4
    columns = [(_rhs(problem, y + e) - _rhs(problem, y - e)) / (2.0 * step) for e in step * np.eye(y.size)]
    differences = np.array(columns).T
    # The error of differences, step² times a third derivative, a thousand times the first.
    assert np.abs(jacobian - differences).max() < 1e-4 * np.abs(differences).max()


@pytest.mark.parametrize("gamma", [1e-3, 0.1, -0.3])
def test_blocks_solve_as_the_full_matrix_does(gamma: float) -> None:
    assembly = assemble(_everything())
    problem = mechanism_problem(assembly, duration=1.0, rtol=1e-6)
    y = _state(problem)
    full = np.eye(y.size) - gamma * _jacobian(
        mechanism_problem(assembly, duration=1.0, rtol=1e-6, dense=True), y
    )
    algebra = problem.algebra
    assert algebra is not None
    entries, factors, pivots = (
        np.zeros(algebra.n_entries),
        np.zeros(algebra.n_factors),
        np.zeros(0, dtype=int),
    )
    problem.functions.jac(T, y, problem.data, problem.memory, np.zeros(y.size), entries)
    sign = algebra.factorise(gamma, problem.data, entries, factors, pivots)
    assert sign == np.linalg.slogdet(full)[0]
    right = np.random.default_rng(3).normal(size=y.size)
    x = right.copy()
    algebra.solve(problem.data, factors, pivots, x)
    exact = np.linalg.solve(full, right)
    # Both are rounded by the condition of the matrix, some 1e5 here.
    assert np.abs(x - exact).max() < 1e-9 * np.abs(exact).max()
