"""The walk of a step-by-step method over a problem, and the end of a walk that makes no progress.

This file and :mod:`tribodyn.core.problem` say in which order the functions of a problem
are called; a compiled driver keeps the same order.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Floats, Problem, Solution, Statistics
from tribodyn.integrate.base import Binding, Method, Segment, Step, VectorFunction, all_finite
from tribodyn.integrate.following import Followed, Schedule, take_places

LOOK: Final = 4.0  #: Time between two looks [s]; two of them find out within ten seconds.
LEAST_WORK: Final = 2000  #: Evaluations between two looks below which a run is slow, but not stuck.
#: Mean progress of an evaluation between two looks, over the usual one, of a run that is stuck. Thousands of
#: evaluations in one impact, or in the ringing after it, get on a hundred times as fast.
COLLAPSED: Final = 1.0e-5
#: The usual progress of an evaluation, over the interval of output times, where there is no other yet.
USUAL: Final = 0.1
MOST_LEFT: Final = 1.0e9  #: Evaluations that the rest of a run may need at the present pace.


class Patience:
    """Watches the progress of one run.

    ``schedule``: of the run.
    """

    def __init__(self, schedule: Schedule) -> None:
        self._end, n_outputs = float(schedule.edges[-1]), max(schedule.output_times.size, 1000)
        self._usual = USUAL * (self._end - float(schedule.edges[0])) / n_outputs
        self._looked, self._begin = time.monotonic(), float(schedule.edges[0])
        self._reached, self._work = self._begin, 0

    def look(self, t: float, evaluations: int) -> None:
        """Raise ``IntegrationFailure`` where steps have become too short to get anywhere.

        ``t``: simulated time reached [s]; ``evaluations``: of the right-hand side so far.
        """
        now = time.monotonic()
        if now - self._looked < LOOK:
            return
        work, progress = evaluations - self._work, t - self._reached
        usual = min(self._usual, (self._reached - self._begin) / self._work) if self._work else self._usual
        pace = progress / max(work, 1)
        if work > LEAST_WORK and pace < COLLAPSED * usual and (self._end - t) > MOST_LEFT * pace:
            reason = (
                f"the run makes no progress any more: its last {work} evaluations covered {progress:.3g} s. "
                "Something swings or switches there faster than the rest of the run can wait for"
            )
            raise IntegrationFailure(t, reason)
        self._looked, self._reached, self._work = now, t, evaluations


class Kept:
    """Room for all rows and pictures of a run, which takes memory as it is filled.

    ``problem``: which numbers of a row it keeps, and the type of its pictures; ``n_rows``, ``n_pictures``:
    numbers of output times and of times of pictures.

    Attributes
    ----------
    rows
        Shape (n_rows, n_kept).
    pictures
        Shape (n_pictures,) followed by the problem's ``field_shape``.
    numbers
        How many of each have been taken.
    """

    def __init__(self, problem: Problem, n_rows: int, n_pictures: int) -> None:
        self._places = problem.kept
        self.rows: FloatArray = np.empty((n_rows, problem.n_kept))
        self.pictures: Floats = np.empty((n_pictures, *problem.field_shape), dtype=problem.picture_type)
        self.numbers = (0, 0)

    def add_rows(self, rows: FloatArray) -> None:
        """Take over rows in the order of time, shape (n, n_observed)."""
        first, n_pictures = self.numbers
        take_places(rows, self._places, self.rows[first : first + len(rows)])
        self.numbers = first + len(rows), n_pictures

    def add_pictures(self, pictures: FloatArray) -> None:
        """Take over pictures in the order of time, shape (n,) followed by ``field_shape``."""
        n_rows, first = self.numbers
        self.pictures[first : first + len(pictures)] = pictures
        self.numbers = n_rows, first + len(pictures)


INTERRUPTED = "interrupted"  #: Reason of a failure when the caller asked to stop.

#: Time without an accepted step after which the caller is asked whether to stop all the same [s].
LONG_STEP: Final = 0.3


@dataclass(frozen=True)
class IntegrationTask:
    """Task of an integrator; meanings as in :func:`tribodyn.integrate.integrate`."""

    problem: Problem
    schedule: Schedule
    rtol: float
    progress: Callable[[float], None] | None = None
    stop: Callable[[], bool] | None = None


class Integrator(Protocol):
    """Type of the members of ``SOLVERS``: runs a whole problem, never raises for one that fails midway."""

    def prepare(self) -> None:
        """Raise ``InputError`` if a package that the integrator needs is not installed."""
        ...

    def __call__(self, task: IntegrationTask) -> Solution:
        """Integrate the problem of a task and return what was reached."""
        ...


@dataclass(frozen=True)
class Stepwise:
    """An integrator made of a method that yields one step at a time."""

    method: Method  #: The method.

    def prepare(self) -> None:
        """Import the packages of the method, see :class:`Integrator`."""
        self.method.prepare()

    def __call__(self, task: IntegrationTask) -> Solution:
        """Integrate, see :class:`Integrator`."""
        self.prepare()
        walk = Walk(task)
        return walk.solve(lambda t_end: walk.segment(self.method, t_end))


class Walk:
    """One integration under way."""

    def __init__(self, task: IntegrationTask) -> None:
        problem, schedule = task.problem, task.schedule
        self.problem, self.schedule, self.rtol = problem, schedule, task.rtol
        self.progress, self.stop = task.progress, task.stop
        self.patience = Patience(schedule)
        self.statistics = Statistics()
        self.functions = problem.functions
        self.binding = Binding(problem, self.functions, self.statistics)
        self.t = float(schedule.edges[0])
        self.step_size = 0.0
        self.asked = 0.0
        self.y = np.array(problem.y0, dtype=np.float64)
        self.marks = [*schedule.marks.tolist(), np.inf]  # plain floats compare faster
        self.next_mark = 0
        self.kept = Kept(problem, schedule.output_times.size, schedule.picture_times.size)
        self.followed = Followed(problem.following, problem.n_observed, problem.kept)
        self.n_followed = self.window = self.skipped = 0

    def solve(self, segment: Callable[[float], None]) -> Solution:
        """Integrate segment after segment and return what was reached; ``segment`` as for :meth:`run`."""
        begin = time.perf_counter()
        failure: str | None = None
        try:
            self.run(segment)
        except IntegrationFailure as error:
            failure = self.describe(error)
        self.statistics.wall_time = time.perf_counter() - begin
        return self.solution(failure)

    def run(self, segment: Callable[[float], None]) -> None:
        """Integrate segment after segment; ``segment`` integrates to the time it is given."""
        for number, t_end in enumerate(self.schedule.edges[1:].tolist()):
            self.statistics.restarts = number
            self.enter()
            segment(t_end)

    def enter(self) -> None:
        """Begin a segment; refuse one whose first rate is not finite, which SciPy would try for ever."""
        self.functions.enter(self.t, self.y, self.problem.data, self.problem.memory)
        if self.problem.sample is not None and self.problem.sample(self.t, self.y):
            self.functions.enter(self.t, self.y, self.problem.data, self.problem.memory)
        kept = self.kept.numbers
        if self.marks[self.next_mark] <= self.t:  # only at the initial time; later ones are taken
            # At once, since a rate may leave in the memory what no row is to be made of.
            self.take()
        for what, values in (("value", self.y), ("rate", self.binding.rhs(self.t, self.y))):
            if name := self.binding.first_not_finite(values):
                self.kept.numbers = kept
                self.binding.note = ""
                raise IntegrationFailure(self.t, f"the {what} of {name} is not finite where a segment starts")

    def segment(self, method: Method, t_end: float) -> None:
        """Integrate to the next breakpoint or to the end."""
        rhs, jac = self.listening(self.binding.rhs), self.listening(self.binding.jac)
        bounds = self.rtol, self.problem.atol, self.statistics, self.problem.longest_step
        for step in method.steps(Segment(rhs, jac, self.t, self.y, t_end, *bounds)):
            self.check(step)
            self.walk(step)
            self.ask()

    def ask(self) -> None:
        """End the run where the caller asks to stop before its end, or where it makes no progress."""
        self.asked = time.monotonic()
        self.patience.look(self.t, self.statistics.rhs_evaluations)
        if self.stop is not None and self.stop() and self.t < self.schedule.edges[-1]:
            raise IntegrationFailure(self.t, INTERRUPTED)

    def listening(self, function: VectorFunction) -> VectorFunction:
        """Return a function that asks in the middle of a step, too, where steps take long."""
        self.asked = time.monotonic()

        def call(t: float, y: FloatArray) -> FloatArray:
            value = function(t, y)
            if time.monotonic() - self.asked > LONG_STEP:
                self.ask()
            return value

        return call

    def check(self, step: Step) -> None:
        """Refuse a step whose end is not finite."""
        if not all_finite(step.y):
            name = self.binding.first_not_finite(step.y)
            raise IntegrationFailure(self.t, f"the value of {name} became not finite")

    def walk(self, step: Step) -> None:
        """Walk an accepted step from its beginning to its end: rules 3 to 5 of the protocol."""
        t, y = step.t, step.y
        inside = t - self.schedule.tolerance
        t_part = self.t
        while (mark := self.marks[self.next_mark]) < inside:
            self.advance(t_part, mark, step.interpolate(mark))
            t_part = mark
            self.take()
        self.advance(t_part, t, y)
        due = mark <= t + self.schedule.tolerance
        if not (due and self.schedule.is_output[self.next_mark]):
            self.follow()
        if due:
            self.take()
        self.functions.accept(t, y, self.problem.data, self.problem.memory)
        self.step_size = t - step.t_old
        self.statistics.steps += 1
        self.binding.note = ""
        if self.progress is not None:
            self.progress(t)

    def advance(self, t_a: float, t_b: float, y_b: FloatArray) -> None:
        """Add the path integrals from ``t_a`` to ``t_b``, where the state is ``y_b``."""
        problem = self.problem
        self.functions.advance(t_a, t_b, y_b, problem.data, problem.memory)
        self.t, self.y = t_b, y_b

    def take(self) -> None:
        """Take the outputs due at the next mark: an output row, a picture or both."""
        problem, mark = self.problem, self.next_mark
        if self.schedule.is_output[mark]:
            row = np.empty((1, problem.n_observed))
            self.functions.observe(self.t, self.y, problem.data, problem.memory, row[0])
            self.kept.add_rows(row)
        if self.schedule.is_picture[mark]:
            fields = np.empty((1, *problem.field_shape))
            self.functions.picture(self.t, self.y, problem.data, problem.memory, fields[0])
            self.kept.add_pictures(fields)
        self.next_mark += 1

    def follow(self) -> None:
        """Take a row at the end of a step where the problem asks for it."""
        followed, problem = self.followed, self.problem
        while followed.windows[self.window, 1] < self.t:
            self.window += 1
        if followed.windows[self.window, 0] <= self.t and self.wants():
            n = self.n_followed
            self.functions.observe(self.t, self.y, problem.data, problem.memory, followed.rows[n])
            followed.times[n] = self.t
            self.n_followed += 1
        if self.n_followed == followed.times.size:
            self.collect()

    def wants(self) -> bool:
        """Tell whether it is the turn of the step, or the problem wants its row."""
        following = self.followed.following
        self.skipped += 1
        if self.skipped < following.stride and following.wanted[0] == 0.0:
            return False
        self.skipped = 0
        following.wanted[0] = 0.0
        return True

    def collect(self) -> None:
        """Take over the rows of the steps that were followed."""
        self.followed.collect(self.n_followed)
        self.n_followed = 0

    def describe(self, error: IntegrationFailure) -> str:
        """Return the failure in words: time, last step and what was not finite."""
        if error.reason == INTERRUPTED:
            return INTERRUPTED
        reason = self.binding.reason(error.reason)
        return f"stopped at t = {self.t:.9g} s, after a step of {self.step_size:.3g} s: {reason}"

    def solution(self, failure: str | None) -> Solution:
        """Return the solution so far."""
        self.collect()
        n_rows, n_pictures = self.kept.numbers
        times, rows = self.followed.merged(self.schedule.output_times[:n_rows], self.kept.rows)
        return Solution(
            t=times,
            rows=rows,
            picture_times=self.schedule.picture_times[:n_pictures],
            pictures=self.kept.pictures[:n_pictures],
            t_end=self.t,
            y_end=self.y,
            statistics=self.statistics,
            failure=failure,
        )
