"""A case of the disc as a system to integrate."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from falling_disc.case import DiscCase

from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.kernels.jit import entry
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart

GRAVITY = 9.81
NAMES = ("height", "floor_force", "energy_lost")


class Data(NamedTuple):
    """Mass [kg], stiffness [N/m], height at the start [m]."""

    mass: float
    stiffness: float
    height: float


@entry
def rhs(t, y, data, memory, f):
    f[0] = y[1]
    f[1] = data.stiffness * max(-y[0], 0.0) / data.mass - 9.81


@entry
def jac(t, y, data, memory, f, jacobian):
    rhs(t, y, data, memory, f)
    jacobian[0, 1] = 1.0
    jacobian[1, 0] = -data.stiffness / data.mass if y[0] < 0.0 else 0.0


@entry
def enter(t, y, data, memory):
    pass


@entry
def advance(t_a, t_b, y_b, data, memory):
    pass


@entry
def accept(t, y, data, memory):
    pass


@entry
def observe(t, y, data, memory, row):
    force = data.stiffness * max(-y[0], 0.0)
    row[0] = y[0]
    row[1] = force
    row[2] = (
        data.mass * 9.81 * (data.height - y[0])
        - 0.5 * data.mass * y[1] ** 2
        - 0.5 * force**2 / data.stiffness
    )


@entry
def picture(t, y, data, memory, fields):
    pass


@dataclass(frozen=True)
class DiscSystem:
    """The disc of a case."""

    case: DiscCase

    def check(self) -> Sequence[str]:
        """There is nothing to refuse."""
        return ()

    def problem(self, duration: float, worn: Any = None) -> Problem:
        disc = self.case.disc
        return Problem(
            functions=CompiledFunctions(rhs, jac, enter, advance, accept, observe, picture),
            data=Data(disc.mass, disc.stiffness, disc.height),
            memory=np.zeros(1),
            y0=np.array([disc.height, 0.0]),
            t_span=(0.0, duration),
            breakpoints=(),
            atol=np.array([1e-12, 1e-9]),
            state_names=("height", "speed"),
            n_observed=len(NAMES),
            field_shape=(1, 1, 1),
        )

    def output_times(self, duration: float) -> np.ndarray:
        return np.linspace(0.0, duration, 201)

    def picture_times(self, duration: float) -> np.ndarray:
        return np.empty(0)

    def gather(self, run: FinishedRun) -> ResultPart:
        return ResultPart(columns=run.rows(NAMES), failure=run.solution.failure or "")


SYSTEM = DiscSystem
