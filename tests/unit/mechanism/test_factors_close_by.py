"""Velocities and reactions with the factors of another position are those with the position's own."""

from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.mechanism.data import N_STATES, VELOCITY
from tribodyn.kernels.mechanism.solution import correct_velocities, take_accelerations
from tribodyn.mechanisms.catalogue import MECHANISMS

SAME = 1e-9  #: Part of the largest: one rounding of the state moves reactions by as much.


@pytest.fixture(scope="module")
def problem() -> Any:
    """Return the equations of a slider-crank in three dimensions."""
    case = td.load_case("slider-crank-3d")
    return MECHANISMS["mechanism"].system(case).problem(case.duration)


def solved(problem: Any, shift: float, near: float) -> tuple[FloatArray, FloatArray]:
    """Return velocities off the constraints, corrected, and reactions, with the factors of ``shift`` away."""
    y, data, memory = problem.y0.copy(), problem.data, problem.memory
    f, chance = np.empty_like(y), np.random.default_rng(3)
    problem.functions.enter(0.0, y, data, memory)
    away = y * (1.0 + shift * chance.normal(size=y.size))
    states = y.reshape(-1, N_STATES)
    states[:, VELOCITY:] += chance.normal(size=states[:, VELOCITY:].shape)
    problem.functions.rhs(0.0, away, data, memory, f)
    factors = memory.blocks.copy()
    problem.functions.rhs(0.0, y, data, memory, f)
    memory.blocks[:] = factors
    parts, now = data.parts, memory.now
    correct_velocities(parts, now, data.mass, memory.blocks, near)
    if near == 1.0:
        memory.blocks[:] = factors
    take_accelerations(parts, now, data.mass, memory.blocks, near)
    return np.append(now.bodies.v, now.bodies.w), now.couplings.constraint.copy()


@pytest.mark.parametrize("shift", [0.0, 1e-8, 1e-4, 0.1])
def test_near_or_not_near_enough(problem: Any, shift: float) -> None:
    for found, wanted in zip(solved(problem, shift, 1.0), solved(problem, 0.0, 0.0), strict=True):
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=SAME * np.abs(wanted).max())
