"""The protocol between a mechanism and an integrator, and whether the caller wants a run to stop.

A mechanism hands an integrator a :class:`Problem`: compiled functions on plain
arrays, the constant data they read and the memory they change. Everything an
integrator may call is listed here, so that a compiled integrator can run a whole
segment without returning to Python.

The rules
---------
1. ``rhs`` and ``jac`` read ``memory`` and never change it: calling them twice gives
   the same numbers twice.
2. ``enter`` is called once at the start of every segment (the initial time and each
   breakpoint), before any other call in that segment. What is constant over a
   segment, such as the direction of motion, is set there. Then ``sample``, which is plain Python, may
   set what controllers hold over the segment; if it has, ``enter`` is called once more.
3. After a step is accepted, the step is walked once from its beginning to its end.
   For each part of it (parts end at output times and at the end of the step)
   ``advance`` adds the path integrals of that part: works, heats, sliding loads.
4. ``observe`` and ``picture`` are called at output times, ``observe`` also at the ends of
   steps that the problem wants followed, after ``advance`` has reached them and while the
   memory that the step was computed with is in force.
5. ``accept`` is called once at the end of each accepted step, after rules 3 and 4.
   It is the only place where the state of contact (such as entry velocities) changes. There and
   in ``enter`` a problem may correct the state, to keep it on its constraints; an integrator that
   cannot take the correction over goes on without it.
6. An integrator never steps across a breakpoint. Stage evaluations may lie beyond it;
   the regime set by ``enter`` then still holds.
7. A problem with an ``algebra`` of its own never meets a matrix of n² numbers: ``jac`` is handed the entries
   of the Jacobian, cleared, and ``factorise`` and ``solve`` read and change their arguments alone. After
   ``factorise`` any number of calls of ``solve`` may follow.

The question is set once around a run. Whatever computes for longer than a second asks it in between: what a
result needs raises, what a result can do without is skipped.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import Stopped

Floats: TypeAlias = NDArray[np.floating[Any]]  #: Numbers of any precision.


@dataclass(frozen=True)
class CompiledFunctions:
    """Compiled functions of a problem; ``n`` states, all arrays float64 and contiguous."""

    rhs: Callable[..., None]  #: ``rhs(t, y, data, memory, f)`` fills ``f`` (n,) with dy/dt.
    #: ``jac(t, y, data, memory, f, jacobian)`` fills ``f`` and ``jacobian`` (n, n), or (n_entries,) where the
    #: problem has an :class:`LinearSolver`.
    jac: Callable[..., None]
    enter: Callable[..., None]  #: ``enter(t, y, data, memory)`` begins a segment at ``t``.
    #: ``advance(t_a, t_b, y_b, data, memory)`` adds path integrals over ``[t_a, t_b]``. The values at ``t_a``
    #: were left in ``memory`` by the previous ``advance`` or by ``enter``.
    advance: Callable[..., None]
    #: ``accept(t, y, data, memory)`` updates the memory at the end of an accepted step; it may correct ``y``.
    accept: Callable[..., None]
    observe: Callable[..., None]  #: ``observe(t, y, data, memory, row)`` fills ``row`` (n_observed,).
    #: ``picture(t, y, data, memory, fields)`` fills ``fields`` (n_fields, n_z, n_theta).
    picture: Callable[..., None]


@dataclass(frozen=True)
class LinearSolver:
    """Linear algebra of a problem of many states with its Newton matrix M − γJ, in less than n² numbers.

    M is the mass matrix of the problem, 1 where it has none.
    """

    #: Row and column of each entry of the Jacobian that may differ from zero, shape (2, n_entries); entries
    #: of one place add up. It may be shorter where ``n_entries`` is given: entries without a place are the
    #: problem's own affair, and those with one are to bound how the rounding of the state shows in its rates.
    places: NDArray[np.int64]
    #: ``factorise(gamma, data, jacobian, factors, pivots)`` prepares solutions with M − γJ from the entries
    #: ``jacobian`` (n_entries,); returns the sign of the determinant, 0 where the matrix is singular. By the
    #: sign a Jacobian is found out that grows faster than the step; one that returns whether the matrix is
    #: regular loses that. Compiled, as are those of :class:`CompiledFunctions`; ``gamma`` may be negative.
    factorise: Callable[..., int]
    #: ``solve(data, factors, pivots, x)`` replaces the right-hand side ``x`` (n,) by the solution.
    solve: Callable[..., None]
    #: Sizes of ``factors`` (float64) and ``pivots`` (int64): what ``factorise`` leaves to ``solve``.
    n_factors: int
    n_pivots: int = 0
    #: Number of entries, 0 for that of places. Integrators other than ``mebdf`` need a place for each.
    n_entries: int = 0


@dataclass(frozen=True)
class Following:
    """Stretches of a run in which accepted steps give rows."""

    windows: FloatArray  #: Begin and end of each [s], shape (n, 2): increasing, none overlaps the next.
    most: int  #: Rows kept of each; more are thinned.
    #: Places in a row of what must keep its peaks when rows are thinned; several together are the components
    #: of a vector, of which the length is meant.
    watched: tuple[tuple[int, ...], ...]
    stride: int = 1  #: Every how many steps give a row.
    #: Set above zero by the functions of the problem where a step gives one in any case, shape (1,); it is
    #: cleared when the row is taken.
    wanted: FloatArray = field(default_factory=lambda: np.zeros(1))


@dataclass(frozen=True)
class Problem:
    """An initial value problem with memory, ready to be integrated."""

    functions: CompiledFunctions  #: Compiled functions, see :class:`CompiledFunctions`.
    data: Any  #: Constant arguments of the functions: a (nested) named tuple of arrays, numbers and records.
    memory: Any  #: What accepted steps change: a named tuple of arrays and records, changed in place.
    y0: FloatArray  #: Initial state, shape (n,).
    t_span: tuple[float, float]  #: Start and end time [s].
    #: Times strictly inside ``t_span`` [s], increasing, where the integrator restarts.
    breakpoints: tuple[float, ...]
    atol: FloatArray  #: Absolute tolerance of each state, shape (n,).
    state_names: tuple[str, ...]  #: Names of the states, for messages.
    n_observed: int  #: Length of a row of ``observe``.
    field_shape: tuple[int, ...]  #: Shape of the array of ``picture``.
    #: Share of the relative tolerance that holds for each state, shape (n,); ``None`` for all of it.
    relative: FloatArray | None = None
    #: ``None`` for dense matrices, which are fastest up to some dozens of states.
    algebra: LinearSolver | None = None
    #: Constant mass matrix M of M dy/dt = f, which may be singular, shape (n, n), dense or sparse, or its
    #: diagonal, shape (n,); ``None`` for dy/dt = f. Only ``mebdf`` integrates with one.
    mass: Any = None
    #: Index of each state, 1 to 3, shape (n,), with a mass matrix; empty where all are 1.
    index: tuple[int, ...] = ()
    #: Where steps give rows beside those at output times; nowhere by default.
    following: Following | None = None
    #: Length that no step exceeds [s]: what acts may swing faster than the states show.
    longest_step: float = math.inf
    #: Order that formulas do not exceed, where stability decides and not smoothness; ``None`` for any.
    largest_order: int | None = None
    #: Returns the solution where states are not integrated but known or in equilibrium; its arguments are the
    #: times of rows and pictures [s] and what is called with each time reached. ``None`` for an initial value
    #: problem.
    solved: Callable[[FloatArray, FloatArray, Callable[[float], None] | None], "Solution"] | None = None
    #: ``sample(t, y)`` sets in the memory what is held until the next sampling time, and returns whether it
    #: has; ``None`` where nothing is.
    sample: Callable[[float, FloatArray], bool] | None = None
    #: Places in a row of the numbers that the solution keeps, rising, those of ``following.watched`` among
    #: them, shape (n_kept,); ``None`` for all.
    kept: NDArray[np.intp] | None = None
    #: Type of the pictures that the solution keeps; ``picture`` fills double precision.
    picture_type: str = "float64"

    @property
    def n_kept(self) -> int:
        """Numbers of a row of the solution."""
        return self.n_observed if self.kept is None else self.kept.size


@dataclass
class Statistics:
    """Cost of the integration."""

    steps: int = 0
    rejected: int = 0
    rhs_evaluations: int = 0
    jacobian_evaluations: int = 0
    lu_decompositions: int = 0
    restarts: int = 0
    wall_time: float = 0.0


@dataclass(frozen=True)
class Solution:
    """Result of an integration: rows at output times, pictures, cost, and its end."""

    #: Times of the rows [s], shape (n_t,): the output times, up to a failure, and those of steps followed.
    t: FloatArray
    rows: FloatArray  #: Observed quantities that are kept, shape (n_t, n_kept).
    picture_times: FloatArray  #: Times of the pictures reached [s], shape (n_p,).
    pictures: Floats  #: Fields, shape (n_p,) followed by the problem's ``field_shape``.
    #: Time and state at the end of the last accepted step.
    t_end: float
    y_end: FloatArray
    statistics: Statistics = field(default_factory=Statistics)  #: Cost.
    failure: str | None = None  #: ``None``, or the reason why the end was not reached.
    notes: tuple[str, ...] = ()  #: On its accuracy, in words.

    @property
    def complete(self) -> bool:
        """Whether the end of the time span was reached."""
        return self.failure is None


Stop: TypeAlias = Callable[[], bool] | None  #: Returns whether to stop; None where nobody can ask for that.


@dataclass
class _Question:
    """Question to the caller, and whether anything was skipped because of the answer."""

    stop: Stop = None
    skipped: bool = False


_question: ContextVar[_Question | None] = ContextVar("question", default=None)


@contextmanager
def asked(stop: Stop) -> Iterator[None]:
    """Have everything within the block ask ``stop``."""
    before = _question.set(_Question(stop))
    try:
        yield
    finally:
        _question.reset(before)


def ask() -> None:
    """Raise :class:`~tribodyn.core.errors.Stopped` if the caller wants to stop."""
    question = _question.get()
    if question is not None and question.stop is not None and question.stop():
        raise Stopped


def skip() -> bool:
    """Return whether the caller wants to stop, so that work which a result can do without is skipped."""
    try:
        ask()
    except Stopped:
        if (question := _question.get()) is not None:
            question.skipped = True
        return True
    return False


def skipped() -> bool:
    """Return whether any work was skipped."""
    question = _question.get()
    return question is not None and question.skipped
