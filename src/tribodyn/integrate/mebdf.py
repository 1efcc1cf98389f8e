"""MEBDF: Cash's modified extended backward differentiation formulae, a whole segment in compiled code.

Sources: J. R. Cash, The integration of stiff initial value problems in ODEs using modified extended
backward differentiation formulae, Comput. Math. Appl. 9 (1983) 645-657; J. R. Cash, S. Considine, An MEBDF
code for stiff initial value problems, ACM Trans. Math. Softw. 18 (1992) 142-155.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import LinearSolver, Solution
from tribodyn.integrate.driver import IntegrationTask, Walk

if TYPE_CHECKING:
    from mebdf.kernels.state import Mass, MebdfState
    from mebdf.mass import MassMatrix
    from tribodyn.kernels.mebdf.drive import Marks, OwnMatrix

#: Time in compiled code between two looks at ``progress`` and ``stop`` [s]; an evaluation ends first.
BETWEEN_LOOKS: Final = 0.1


class CompiledMebdf:
    """The integrator that ``SOLVERS`` lists; problems in plain Python are run by the same source."""

    def prepare(self) -> None:
        """Need nothing that tribodyn does not bring along."""

    def __call__(self, task: IntegrationTask) -> Solution:
        """Integrate, see :class:`tribodyn.integrate.driver.Integrator`."""
        walk = _CompiledWalk(task)
        walk.prepare()
        with walk.pauses():
            return walk.solve(walk.compiled_segment)


class _CompiledWalk(Walk):
    """One integration under way."""

    _loop: Callable[..., int]
    _own: OwnMatrix | None
    _matrix: MassMatrix | None
    _mass: Mass | None = None
    _marks: Marks
    _in_machine_code: bool
    _pause: NDArray[np.int64]

    def prepare(self) -> None:
        """Find the compiled code; not counted as integration."""
        from mebdf.compiled.kernel import Kernel
        from tribodyn.kernels.mebdf.drive import AFTER_STEP, loop

        self._pause = np.array([AFTER_STEP])
        self._marks = self._new_marks()
        self._matrix = self._read_mass()
        functions, algebra = self.problem.functions, self.problem.algebra
        self._own = None if algebra is None else self._new_matrix(algebra)
        walked = functions.advance, functions.accept, functions.observe, functions.picture
        solvers = () if algebra is None else (algebra.factorise, algebra.solve)
        self._loop = loop(functions.rhs, functions.jac, *walked, *solvers)
        self._in_machine_code = isinstance(self._loop, Kernel)

    def pauses(self) -> AbstractContextManager[None]:
        """Have compiled code pause by the clock, whatever a step costs; Python does after every step."""
        return _ticking(self._pause) if self._in_machine_code else nullcontext()

    def compiled_segment(self, t_end: float) -> None:
        """Integrate to the next breakpoint or to the end."""
        from tribodyn.kernels.mebdf.drive import ENDED, PAUSED

        problem, marks = self.problem, self._marks
        state = self._new_state(self.t, t_end)
        marks.position[:] = self.next_mark, 0, 0, 0, self.window, self.skipped
        marks.reached[0] = self.t
        before = vars(self.statistics).copy()
        outcome = PAUSED
        while outcome == PAUSED:
            arrays = (problem.data, problem.memory, self._jacobian(state), self._own, marks, self._pause)
            outcome = self._loop(state, *arrays)
            if self._in_machine_code:
                self._pause[0] = 0
            self._take_over(state, before)
            if outcome not in (ENDED, PAUSED):
                raise IntegrationFailure(self.t, self._reason(state))
            if self.progress is not None:
                self.progress(self.t)
            self.ask()

    def _new_state(self, t: float, t_end: float) -> MebdfState:
        from mebdf.kernels.coefficients import MAX_K
        from mebdf.kernels.state import new_state

        problem = self.problem
        return new_state(
            t,
            self.y,
            t_end,
            self._relative,
            problem.atol,
            outside=problem.algebra is not None,
            mass=self._mass,
            max_step=problem.longest_step,
            largest_k=min(problem.largest_order or MAX_K + 1, MAX_K + 1) - 1,
        )

    @property
    def _relative(self) -> float | FloatArray:
        """Relative tolerance of each state."""
        share = self.problem.relative
        return self.rtol if share is None else self.rtol * share

    def enter(self) -> None:
        """Begin a segment, with a mass matrix from consistent values."""
        super().enter()
        if self._matrix is None:
            return
        from mebdf.consistent import consistent
        from mebdf.differences import plain_jacobian
        from mebdf.index import check_index
        from mebdf.mass import LARGEST, with_index

        problem, rhs, matrix = self.problem, self.binding.rhs, self._matrix
        scale = problem.atol + self._relative * np.abs(self.y)
        end, names = float(self.schedule.edges[-1]), problem.state_names
        typical = problem.atol / self._relative
        given = self.y.size > LARGEST and self._has_all_places
        jacobian = self.binding.sparse_jac if given else plain_jacobian(rhs, typical)
        try:
            self.y, slope, _ = consistent(rhs, jacobian, self.t, self.y, end, matrix, scale, names)
            if self.t == self.schedule.edges[0]:
                index = check_index(jacobian, self.t, self.y, matrix.matrix, matrix.index, typical, names)
                self._matrix = matrix = with_index(matrix.matrix, index, None)
        except ValueError as wrong:
            raise IntegrationFailure(self.t, str(wrong)) from wrong
        self._mass = matrix.for_core(slope)

    @property
    def _has_all_places(self) -> bool:
        """Whether the Jacobian that the problem gives can be put together: each entry has a place."""
        algebra = self.problem.algebra
        return algebra is None or algebra.n_entries in (0, algebra.places.shape[1])

    def _read_mass(self) -> MassMatrix | None:
        """Return the mass matrix of the problem, if it has one."""
        if self.problem.mass is None:
            return None
        from mebdf.mass import read_mass

        try:
            return read_mass(self.problem.mass, self.problem.index or None, None, self.y.size)
        except ValueError as wrong:
            raise InputError(str(wrong)) from wrong

    def _jacobian(self, state: MebdfState) -> FloatArray:
        """Return the array that ``jac`` fills."""
        from mebdf.kernels.state import JACOBIAN

        jacobian: FloatArray = state.matrices[JACOBIAN] if self._own is None else self._own.jacobian
        return jacobian

    def _new_matrix(self, algebra: LinearSolver) -> OwnMatrix:
        from tribodyn.kernels.mebdf.drive import OwnMatrix

        entry, last, previous = np.zeros((3, algebra.n_entries or algebra.places.shape[1]))
        pivots = np.zeros(algebra.n_pivots, dtype=np.int64)
        return OwnMatrix(algebra.places, entry, last, previous, np.zeros(algebra.n_factors), pivots)

    def _new_marks(self) -> Marks:
        from tribodyn.kernels.mebdf.drive import Marks

        problem, schedule = self.problem, self.schedule
        pictures = np.empty((schedule.picture_times.size, *(problem.field_shape or (1,))))
        return Marks(
            times=np.array(self.marks),
            is_output=schedule.is_output,
            is_picture=schedule.is_picture,
            tolerance=np.array([schedule.tolerance]),
            rows=np.empty((schedule.output_times.size, problem.n_observed)),
            pictures=pictures,
            windows=self.followed.windows,
            step_times=self.followed.times,
            step_rows=self.followed.rows,
            position=np.zeros(6, dtype=np.int64),
            stride=np.array([self.followed.following.stride]),
            wanted=self.followed.following.wanted,
            reached=np.zeros(1),
            end=np.zeros(self.y.size),
        )

    def _take_over(self, state: MebdfState, before: dict[str, Any]) -> None:
        """Take from the compiled loop where it is, what it has cost, and rows and pictures.

        Rows and pictures begin anew after each visit: of the arrays that the loop fills only the first ones
        are ever touched where steps take long, and only these take memory.
        """
        from mebdf.kernels import state as entry
        from tribodyn.kernels.mebdf.drive import N_OUTPUTS, N_STEPS

        marks = self._marks
        self.next_mark, n_rows, n_pictures, self.n_followed, *more = marks.position.tolist()
        self.window, self.skipped = more
        self.collect()
        self.kept.add_rows(marks.rows[:n_rows])
        self.kept.add_pictures(marks.pictures[:n_pictures].reshape(n_pictures, *self.problem.field_shape))
        marks.position[N_OUTPUTS : N_STEPS + 1] = 0
        self.t = state.number("t")
        self.y = state.rows[entry.HISTORY].copy()
        self.step_size = state.number("h_last")
        for name, field in (
            ("steps", "steps"),
            ("rejected", "rejected"),
            ("rhs_evaluations", "n_f"),
            ("jacobian_evaluations", "n_j"),
            ("lu_decompositions", "n_lu"),
        ):
            setattr(self.statistics, name, before[name] + state.number(field))

    def _reason(self, state: MebdfState) -> str:
        """Return why the core gave up, in words."""
        from mebdf.checks import reason

        return reason(state, self.problem.state_names, self._entry_not_finite)

    def _entry_not_finite(self, state: MebdfState) -> tuple[int, int]:
        """Return row and column of the first entry of the Jacobian that is not finite."""
        bad = np.argwhere(~np.isfinite(self._jacobian(state)))[0]
        if self._own is not None:
            bad = self._own.places[:, min(int(bad[0]), self._own.places.shape[1] - 1)]
        return int(bad[0]), int(bad[1])


@contextmanager
def _ticking(pause: NDArray[np.int64]) -> Iterator[None]:
    """Ask for a pause again and again, from a thread beside compiled code that ends with the block."""
    from tribodyn.kernels.mebdf.drive import AFTER_EVALUATION

    over = threading.Event()

    def tick() -> None:
        while not over.wait(BETWEEN_LOOKS):
            pause[0] = AFTER_EVALUATION

    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


MEBDF = CompiledMebdf()
