"""Problems with memory, restarts and path integrals whose answers are known."""

import numpy as np
import pytest
from scipy.optimize import brentq

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


class Walls:
    """A body flies between two walls that push with ``k d (1 + b d' / v_entry)``, depth ``d``.

    The velocity of entry is memory: that of the last accepted step out of contact. No
    other force acts. From ``m v dv/dd = -k d (1 + b v / v_entry)`` follows, whatever the
    speed, the ratio ``e`` of the speeds after and before:
    ``e + ln(1 - b e) / b + 1 - ln(1 + b) / b = 0``.
    """

    stiffness, factor, gap = 1e6, 0.4, 0.01

    def restitution(self):
        b = self.factor
        return brentq(lambda e: e + np.log(1 - b * e) / b + 1 - np.log(1 + b) / b, 0.1, 1.0)

    def depth(self, y):
        return max(abs(y[0]) - self.gap, 0.0)

    def enter_damping(self, y, memory):
        books = memory[1]
        books.forces[ledger.NOW] = self.stiffness * self.depth(y) * self.factor * y[1] / memory[0][0]
        books.motion[ledger.NOW, :2, 0] = y

    def rhs(self, t, y, data, memory, f):
        side = np.sign(y[0])
        push = self.stiffness * self.depth(y) * (1.0 + self.factor * side * y[1] / memory[0][0])
        f[:] = y[1], -side * push

    def jac(self, t, y, data, memory, f, jacobian):
        jacobian[0, 1] = 1.0
        if self.depth(y) > 0.0:
            side, k = np.sign(y[0]), self.stiffness
            jacobian[1, 0] = -k * (1.0 + self.factor * side * y[1] / memory[0][0])
            jacobian[1, 1] = -k * self.depth(y) * self.factor / memory[0][0]

    def enter(self, t, y, data, memory):
        self.enter_damping(y, memory)
        ledger.begin(memory[1], t)

    def advance(self, t_a, t_b, y_b, data, memory):
        self.enter_damping(y_b, memory)
        ledger.add_part(memory[1], t_b)

    def accept(self, t, y, data, memory):
        if self.depth(y) == 0.0:
            memory[0][0] = abs(y[1])

    def observe(self, t, y, data, memory, row):
        row[:] = y[1], memory[1].works[0]

    def problem(self):
        functions = CompiledFunctions(
            self.rhs, self.jac, self.enter, self.advance, self.accept, self.observe, nothing
        )
        memory = np.array([1.0]), ledger.new_books(ledger.books_type(0, 1, 1))
        # The breakpoint at 0.0301 s lies in flight, that at 0.011 s inside the first contact.
        return make_problem(functions, memory, [0.0, 1.0], 0.1, (0.011, 0.0301), [1e-8, 1e-6], 2)


@pytest.mark.parametrize(("rtol", "allowed"), [(1e-4, 5e-3), (1e-7, 1e-4)])
@pytest.mark.parametrize("solver", SOLVERS)
def test_rebounds_with_memory_of_the_entry(solver, rtol, allowed):
    walls = Walls()
    # Some methods pass a contact of 3 ms in a few steps: outputs every 25 µs let the books see its kinks.
    outputs = np.linspace(0.0, 0.1, 4001)
    solution = integrate(walls.problem(), solver=solver, rtol=rtol, output_times=outputs)
    velocity, heat = solution.rows[-1]
    expected = walls.restitution() ** 3
    # The slope of the force jumps at the wall, which no solver here locates: errors of some
    # tens of rtol at each of six crossings, and the fixed atol of 1e-6 m/s below that.
    assert velocity == pytest.approx(-expected, rel=allowed)
    assert heat == pytest.approx(0.5 * (1.0 - expected**2), rel=allowed)
