"""Problems with memory, restarts and path integrals whose answers are known."""

import numpy as np
import pytest

from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.integrate import SOLVERS, integrate
from tribodyn.kernels import ledger


def nothing(*_):
    return None


def make_problem(functions, memory, y0, end, breakpoints, atol, n_observed):
    return Problem(
        functions=functions,
        data=None,
        memory=memory,
        y0=np.array(y0),
        t_span=(0.0, end),
        breakpoints=breakpoints,
        atol=np.array(atol),
        state_names=("position", "velocity"),
        n_observed=n_observed,
        field_shape=(),
    )


class Ledger:
    """A damped oscillator, mass and stiffness 1, with its heat and the work of a force in turns +1 and -1.

    Memory: the books of the heat and the work, and the force of the segment.
    """

    breakpoints = (1.3, 2.9, 5.0)
    damping = 0.3

    def enter_forces(self, y, books, force):
        books.forces[ledger.NOW, 0] = self.damping * y[1], force[0]
        books.motion[ledger.NOW, :2, 0] = y

    def rhs(self, t, y, data, memory, f):
        f[:] = y[1], memory[1][0] - self.damping * y[1] - y[0]

    def jac(self, t, y, data, memory, f, jacobian):
        jacobian[:] = [[0.0, 1.0], [-1.0, -self.damping]]

    def enter(self, t, y, data, memory):
        memory[1][0] = 1.0 if sum(b <= t for b in self.breakpoints) % 2 == 0 else -1.0
        self.enter_forces(y, *memory)
        ledger.begin(memory[0], t)

    def advance(self, t_a, t_b, y_b, data, memory):
        self.enter_forces(y_b, *memory)
        ledger.add_part(memory[0], t_b)

    def observe(self, t, y, data, memory, row):
        row[:2] = memory[0].works[:2]
        row[2] = 0.5 * y @ y

    def problem(self, end, rtol):
        functions = CompiledFunctions(
            self.rhs, self.jac, self.enter, self.advance, nothing, self.observe, nothing
        )
        inside = tuple(b for b in self.breakpoints if b < end)
        memory = ledger.new_books(ledger.books_type(0, 2, 1)), np.zeros(1)
        return make_problem(functions, memory, [1.0, 0.0], end, inside, [rtol, rtol], 3)


@pytest.mark.parametrize("n_outputs", [2, 1001])
@pytest.mark.parametrize("solver", SOLVERS)
def test_energy_ledger_closes_with_restarts(solver, n_outputs):
    rtol = 1e-7
    outputs = np.linspace(0.0, 8.0, n_outputs)
    solution = integrate(Ledger().problem(8.0, rtol), solver=solver, rtol=rtol, output_times=outputs)
    heat, work, energy = solution.rows.T
    residual = energy + heat - work - energy[0]
    # The state of size 2 is in error by up to 60 rtol (tests/order), its energy by twice that and
    # more.
    np.testing.assert_allclose(residual, 0.0, atol=300 * rtol)
    assert heat[-1] > 0.5


@pytest.mark.parametrize("solver", SOLVERS)
def test_dissipation_of_a_free_decay(solver):
    """Heat of x'' + c x' + x = 1 from (1 + 1, 0) until its rest at 1: the energy it began with."""
    oscillator = Ledger()
    oscillator.breakpoints = ()
    problem = oscillator.problem(120.0, 1e-6)
    problem.y0[:] = 2.0, 0.0
    solution = integrate(problem, solver=solver, rtol=1e-6, output_times=[120.0])
    # Begun with 1/2 about its rest; exp(-0.3 * 120) of it is left.
    assert solution.rows[0, 0] == pytest.approx(0.5, rel=2e-4)
