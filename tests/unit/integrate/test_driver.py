"""The loop over steps: schedule, order of calls, functions that are bound, patience with slow runs."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
import pytest

from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics
from tribodyn.integrate import driver
from tribodyn.integrate.base import Binding, Step
from tribodyn.integrate.driver import INTERRUPTED, LOOK, IntegrationTask, Patience, Stepwise
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


def test_marks_are_the_union_of_outputs_and_pictures():
    schedule = make_schedule((0.0, 4.0), (2.0,), [0.0, 1.0, 2.0], [1.0, 1.5, 4.0])
    np.testing.assert_array_equal(schedule.edges, [0.0, 2.0, 4.0])
    np.testing.assert_array_equal(schedule.marks, [0.0, 1.0, 1.5, 2.0, 4.0])
    np.testing.assert_array_equal(schedule.is_output, [True, True, False, True, False])
    np.testing.assert_array_equal(schedule.is_picture, [False, True, True, False, True])


def test_times_a_rounding_error_apart_are_the_same_mark():
    assert 3 * 0.1 != 0.3
    schedule = make_schedule((0.0, 1.0), (0.3,), [0.1 * k for k in range(11)], [0.3, 0.7])
    assert schedule.marks.size == 11
    assert 0.3 in schedule.marks.tolist()
    assert schedule.is_picture.sum() == 2
    assert schedule.output_times[3] == 3 * 0.1, "outputs are returned as they were asked for"


@pytest.mark.parametrize(
    ("span", "outputs", "message"),
    [
        ((0.0, 0.0), [], "finite and increasing"),
        ((1.0, 0.0), [], "finite and increasing"),
        ((0.0, np.inf), [], "finite and increasing"),
        ((0.0, 1.0), [0.0, 0.5, 0.5], "must increase"),
        ((0.0, 1.0), [0.5, 0.2], "must increase"),
        ((0.0, 1.0), [0.5, 1.1], "between 0 s and 1 s"),
        ((0.0, 1.0), [-0.1], "between 0 s and 1 s"),
        ((0.0, 1.0), [np.nan], "finite"),
    ],
)
def test_times_that_cannot_be_kept_are_refused(span, outputs, message):
    with pytest.raises(InputError, match=message):
        make_schedule(span, (), outputs, ())


def nothing(*_):
    return None


def make_problem(rhs=nothing, jac=nothing, data=None, memory=None):
    return Problem(
        functions=CompiledFunctions(rhs, jac, nothing, nothing, nothing, nothing, nothing),
        data=data,
        memory=memory,
        y0=np.array([1.0, 2.0]),
        t_span=(0.0, 1.0),
        breakpoints=(),
        atol=np.array([1e-6, 1e-6]),
        state_names=("gap", "speed"),
        n_observed=1,
        field_shape=(1, 2, 2),
    )


def bind(problem):
    statistics = Statistics()
    return Binding(problem, problem.functions, statistics), statistics


def linear(t, y, data, memory, f):
    f[:] = t * y


def test_a_first_jacobian_that_is_not_finite_names_the_entry():
    def jac(t, y, data, memory, f, jacobian):
        jacobian[1, 0] = np.inf

    binding, _ = bind(make_problem(jac=jac))
    with pytest.raises(IntegrationFailure, match=r"d\(rate of speed\)/d\(gap\) is not finite"):
        binding.jac(0.0, np.ones(2))


def test_a_rate_that_is_not_finite_is_noted_with_time_and_name():
    binding, _ = bind(make_problem(linear))
    binding.rhs(2.5, np.array([1.0, np.nan]))
    assert binding.reason("gave up") == "gave up; the rate of speed was not finite at t = 2.5 s"


DURATION = 1.0


class Clock:
    """A clock that the test turns."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        """Return the time [s]."""
        return self.now


def looks(monkeypatch: pytest.MonkeyPatch, marks: list[tuple[float, int]]) -> None:
    """Look at a run of one second at marks of simulated time and evaluations, five seconds apart."""
    clock = Clock()
    monkeypatch.setattr(driver, "time", clock)
    watched = Patience(make_schedule((0.0, DURATION), (), np.linspace(0.0, DURATION, 501), ()))
    for t, evaluations in marks:
        clock.now += 1.25 * LOOK
        watched.look(t, evaluations)


@pytest.mark.parametrize(
    "marks",
    [[(0.3, 5000), (0.3 + 1e-12, 60_000)], [(1e-13, 50_000)], [(0.5, 100_000), (0.5, 200_000)]],
    ids=["collapsed", "from the start", "no step at all"],
)
def test_a_run_that_is_stuck_ends_within_two_looks(monkeypatch, marks):
    with pytest.raises(IntegrationFailure, match="no progress any more"):
        looks(monkeypatch, marks)
    assert 2.0 * LOOK < 10.0


@pytest.mark.parametrize(
    "marks",
    [
        [(0.3, 5000), (0.3 + 1e-4, 60_000), (0.6, 65_000)],
        [(1e-4, 50_000), (2e-4, 100_000), (3e-4, 150_000)],
        [(0.3, 5000), (0.3, 5100), (0.3, 5200)],
        [(0.999, 5000), (0.999 + 1e-5, 105_000)],
    ],
    ids=["an impact", "slow all the time", "dear evaluations", "near the end"],
)
def test_a_run_that_is_slow_goes_on(monkeypatch: pytest.MonkeyPatch, marks: list[tuple[float, int]]) -> None:
    looks(monkeypatch, marks)


def test_rows_are_taken_with_the_memory_the_step_was_computed_with():
    solution, _ = run((), [0.0, 0.4, 0.8, 1.0])
    np.testing.assert_allclose(solution.rows, [[0.0, 0.0, 0], [0.4, 0.4, 0], [0.8, 0.8, 1], [1.0, 1.0, 2]])


def test_a_picture_at_the_start_is_taken_after_enter():
    solution, calls = run((), (), [0.0])
    assert calls[:2] == [("enter", 0.0, 0.0), ("picture", 0.0)]
    assert solution.pictures.shape == (1, 2, 2)


def test_nothing_is_taken_when_nothing_is_asked_for():
    solution, calls = run()
    assert {call[0] for call in calls} == {"enter", "advance", "accept"}
    assert solution.rows.shape == (0, 3)
    assert solution.t_end == 1.0
    np.testing.assert_allclose(solution.y_end, [1.0])


def test_a_state_that_is_not_finite_is_not_accepted():
    solution, calls = run(method=ExactSteps(bad_after=0.5))
    assert solution.failure is not None
    assert "the value of y became not finite" in solution.failure
    assert solution.t_end == pytest.approx(0.4)
    assert calls[-1] == ("accept", 0.4)


def test_a_run_that_has_reached_its_end_is_complete_whatever_stop_says():
    solution, _ = run(stop=lambda: True, end=0.4)
    assert solution.complete


def test_progress_is_told_the_time_of_every_step():
    times = []
    run((0.5,), progress=times.append)
    np.testing.assert_allclose(times, [0.4, 0.5, 0.9, 1.0])
