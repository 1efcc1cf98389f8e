"""The order in which the driver calls the functions of a problem, with a method of known steps."""

import time
from dataclasses import dataclass

import numpy as np
import pytest

from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.integrate.base import Step
from tribodyn.integrate.driver import INTERRUPTED, IntegrationTask, Stepwise
from tribodyn.integrate.following import make_schedule


@dataclass
class ExactSteps:
    """Solve y' = 1 exactly in steps of 0.4 s; fail before the step that would pass ``fail_after``."""

    fail_after: float = np.inf
    bad_after: float = np.inf

    def prepare(self):
        pass

    def steps(self, segment):
        t_start, y_start, t_end = segment.t_start, segment.y_start, segment.t_end
        t = t_start
        while t < t_end:
            t_old, t = t, min(t + 0.4, t_end)
            if t > self.fail_after:
                raise IntegrationFailure(t_old, "no further")
            y = y_start + (t - t_start) if t <= self.bad_after else np.full(1, np.nan)
            yield Step(t_old, t, y, lambda s: y_start + (s - t_start))


@dataclass
class Log:
    """A problem that writes down its calls; the state equals the time."""

    calls: list

    def rhs(self, t, y, data, memory, f):
        f[:] = 1.0

    def enter(self, t, y, data, memory):
        self.calls.append(("enter", round(t, 9), y[0]))

    def advance(self, t_a, t_b, y_b, data, memory):
        assert y_b[0] == pytest.approx(t_b)
        self.calls.append(("advance", round(t_a, 9), round(t_b, 9)))

    def accept(self, t, y, data, memory):
        memory[0] += 1.0
        self.calls.append(("accept", round(t, 9)))

    def observe(self, t, y, data, memory, row):
        row[:] = t, y[0], memory[0]
        self.calls.append(("observe", round(t, 9)))

    def picture(self, t, y, data, memory, fields):
        fields[:] = t
        self.calls.append(("picture", round(t, 9)))


def run(breakpoints=(), outputs=(), pictures=(), method=None, progress=None, stop=None, end=1.0):
    log = Log([])
    functions = CompiledFunctions(
        log.rhs, log.rhs, log.enter, log.advance, log.accept, log.observe, log.picture
    )
    problem = Problem(
        functions, None, np.zeros(1), np.zeros(1), (0.0, end), breakpoints, np.ones(1), ("y",), 3, (2, 2)
    )
    schedule = make_schedule(problem.t_span, problem.breakpoints, outputs, pictures)
    solution = Stepwise(method or ExactSteps())(IntegrationTask(problem, schedule, 1e-4, progress, stop))
    return solution, log.calls


def test_the_order_of_the_calls():
    solution, calls = run((0.5,), [0.0, 0.1, 0.5, 1.0], [0.2, 0.5])
    assert calls == [
        ("enter", 0.0, 0.0),
        ("observe", 0.0),
        ("advance", 0.0, 0.1),
        ("observe", 0.1),
        ("advance", 0.1, 0.2),
        ("picture", 0.2),
        ("advance", 0.2, 0.4),
        ("accept", 0.4),
        ("advance", 0.4, 0.5),
        ("observe", 0.5),
        ("picture", 0.5),
        ("accept", 0.5),
        ("enter", 0.5, 0.5),
        ("advance", 0.5, 0.9),
        ("accept", 0.9),
        ("advance", 0.9, 1.0),
        ("observe", 1.0),
        ("accept", 1.0),
    ]
    assert solution.complete
    assert solution.statistics.steps == 4
    assert solution.statistics.restarts == 1


@pytest.mark.parametrize("shift", [-1e-15, 0.0, 1e-15])
def test_marks_a_rounding_error_from_the_end_of_a_step_make_no_part_of_their_own(shift):
    _, calls = run((), [0.4 + shift])
    assert calls[1:4] == [("advance", 0.0, 0.4), ("observe", 0.4), ("accept", 0.4)]
    assert ("advance", 0.4, 0.8) in calls


def test_parts_of_a_run_tile_it_without_gaps():
    _, calls = run((0.3, 0.77), np.linspace(0.0, 1.0, 41), [0.123, 0.77])
    parts = [call[1:] for call in calls if call[0] == "advance"]
    assert parts[0][0] == 0.0
    assert parts[-1][1] == 1.0
    assert [a for a, _ in parts[1:]] == [b for _, b in parts[:-1]]


def test_a_method_that_fails_leaves_what_was_reached():
    solution, calls = run((), [0.0, 0.3, 0.9], method=ExactSteps(fail_after=0.85))
    assert solution.failure == "stopped at t = 0.8 s, after a step of 0.4 s: no further"
    assert not solution.complete
    np.testing.assert_allclose(solution.t, [0.0, 0.3])
    assert solution.rows.shape == (2, 3)
    assert solution.t_end == pytest.approx(0.8)
    assert calls[-1] == ("accept", 0.8)


def test_stop_is_asked_after_every_step_and_leaves_what_was_reached():
    answers = iter([False, True])
    solution, _ = run((), [0.0, 0.6, 0.9], stop=lambda: next(answers))
    assert solution.failure == INTERRUPTED
    assert solution.t_end == pytest.approx(0.8)
    np.testing.assert_allclose(solution.t, [0.0, 0.6])


@dataclass
class OneLongStep(ExactSteps):
    """Evaluate again and again for minutes before the first step."""

    def steps(self, segment):
        until = time.monotonic() + 300.0
        while time.monotonic() < until:
            segment.rhs(segment.t_start, segment.y_start)
        yield from super().steps(segment)


def test_stop_is_asked_in_the_middle_of_a_step_that_takes_long():
    began = time.monotonic()
    solution, _ = run((), [0.0], method=OneLongStep(), stop=lambda: True)
    assert solution.failure == INTERRUPTED
    assert (solution.t_end, solution.statistics.steps) == (0.0, 0)
    assert time.monotonic() - began < 60.0
