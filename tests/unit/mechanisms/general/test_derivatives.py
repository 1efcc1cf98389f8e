"""Derivatives of the equations of motion, and the blocks of the iteration matrix, against differences."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.core.signals import sinusoid
from tribodyn.mechanisms.general.assembly import assemble
from tribodyn.mechanisms.general.description import GROUND, Body, Description, Drive, Joint, Load, Spring
from tribodyn.mechanisms.general.problem import mechanism_problem

T = 0.3


def _everything() -> Description:
    """Return a mechanism with every kind of row, drive, load and spring, anywhere in space."""
    rng = np.random.default_rng(1)

    def signal() -> object:
        return sinusoid(*rng.normal(size=4))

    def body(number: int) -> Body:
        root = rng.normal(size=(3, 3))
        return Body(f"body {number}", rng.uniform(0.5, 2.0), rng.normal(size=3), root @ root.T + np.eye(3))

    def joint(kind: str, bodies: tuple[int, int], *springs: FloatArray) -> Joint:
        points = np.tile(rng.normal(size=3), (2, 1))
        given = springs or (np.zeros(0), np.zeros(0))
        return Joint(kind, kind, bodies, points, rng.normal(size=(2, 3)), None, *given)

    joints = (
        *(joint("revolute", (GROUND, 0)), joint("universal", (0, 1)), joint("cylindrical", (1, 2))),
        joint("prismatic", (2, 3)),
        # None about the axis: its turning moment is differentiated but for the second order of the tilt.
        joint("spring-damper", (GROUND, 3), np.array([3.0, 4.0, 5.0, 0.0, 2.0, 1.0]), np.full(6, 0.3)),
        joint("spherical", (3, 0)),
    )
    drives = (
        Drive("turn", 0, "angle", 0, signal()),
        Drive("slide", 2, "position", 1, signal()),
        Drive("push", 3, "position", 2, signal()),
    )
    frames = ("ground", "body", "motion", "line")
    loads = tuple(
        Load(frame, k, rng.normal(size=3), frame, tuple(signal() for _ in range(6)), -1, 0.3)
        for k, frame in enumerate(frames)
    )
    springs = (Spring("spring", (0, 3), rng.normal(size=(2, 3)), 3.0, 0.7, 0.2),)
    return Description(
        tuple(body(k) for k in range(4)), joints, drives, loads, springs, rng.normal(size=3), ()
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
