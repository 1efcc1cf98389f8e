"""The MEBDF as a solver class of SciPy: ``solve_ivp(fun, t_span, y0, method=mebdf.MEBDF)``."""

from collections.abc import Callable
from typing import Any, Final
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolver

from mebdf.algebra import answer
from mebdf.arrays import FloatArray
from mebdf.checks import (
    LARGEST_ATOL,
    SMALLEST_RTOL,
    bands,
    inner_times,
    largest_step,
    order,
    reason,
    resolved,
    sizes,
    span,
    starting_step,
    tolerances,
    warn_extraneous,
)
from mebdf.consistent import consistent
from mebdf.dense import JumpDenseOutput, MebdfDenseOutput, end_of_jump
from mebdf.differences import plain_jacobian, typical_sizes
from mebdf.implicit import ImplicitFull, Residual, fill_mass, mass_at_start
from mebdf.index import check_index
from mebdf.jacobian import LARGEST_IN_CORE, CheckedJacobian, Linear, make_jacobian
from mebdf.kernels import state as entry
from mebdf.kernels.coefficients import MAX_K
from mebdf.kernels.core import resume
from mebdf.kernels.phases import FAILED, NEED_F, NEED_JACOBIAN, STEP_ACCEPTED
from mebdf.kernels.state import HISTORY, F, Y, new_state
from mebdf.mass import LARGEST, MassMatrix, read_mass, split, with_index
from mebdf.native import Ahead, Native, Step, native

ENDS_OF_STEP: Final = (STEP_ACCEPTED, FAILED)
OF_TOLERANCE: Final = 0.2  #: Power of the tolerance to which steps grow with it.
#: Decompositions a step that make the Jacobian be checked; a right one takes a third or so.
RENEWED: Final = 0.5


class MEBDF(OdeSolver):
    """Modified extended backward differentiation formulae of Cash, orders 2 to 8.

    For stiff problems. Use it as ``solve_ivp(..., method=MEBDF)``, with events, dense output and
    everything else that SciPy's own stiff solvers take. The right-hand side is never evaluated beyond
    ``t_bound``.

    Parameters
    ----------
    fun
        ``fun(t, y)``: right-hand side, shape (n,), in Python or compiled, see below; with ``vectorized`` also
        (n, m) of (n, m).
    t0, t_bound
        Start and end; backward in time if ``t_bound < t0``.
    y0
        Initial state, shape (n,), real.
    max_step, first_step
        Largest step; first step, ``None`` to choose it.
    rtol, atol
        The local error of component i is kept below ``atol_i + rtol_i |y_i|`` in the root mean square;
        numbers or shape (n,).
    jac
        Jacobian ``jac(t, y)`` of shape (n, n), a constant matrix, or ``None`` for finite differences; dense
        or sparse.
    jac_sparsity
        Where entries of the Jacobian may differ from zero, to group finite differences; shape (n, n). From
        65 equations on a sparse Jacobian leads to sparse or banded decompositions.
    vectorized
        Whether ``fun`` takes several states at once.
    lband, uband
        Numbers of diagonals of the Jacobian below and above the main one. ``jac`` then gives the diagonals,
        ``jac(t, y)[i - j + uband, j]`` = ∂f_i/∂y_j, shape (lband + uband + 1, n); one not given is 0.
    mass
        Constant mass matrix M of M y' = f(t, y), which may be singular: shape (n, n), dense or sparse, or its
        diagonal, shape (n,). ``None`` for the unit matrix.
    index
        Index of each variable, 1 to 3, shape (n,); ``None`` for 1. The errors of variables of index 2 and 3
        are multiplied by the step and its square (of steps below 1), so theirs may be many tolerances. An
        index that is too high is refused, one that is too low is raised with a warning.
    test_algebraic
        Whether variables without derivatives are in the error test; ``None`` for those of index 1.
    breakpoints
        Times at which the right-hand side jumps or kinks, where the integration begins anew; those outside of
        the interval are dropped. No evaluation for a step before one of them lies at it or behind it. Where
        algebraic variables jump there, or were not consistent at the start, a step of some spacings of
        numbers leads from the values before to those behind.
    slope
        y' at the start, shape (n,). Where it is given the equation is the implicit one F(t, y, y') = 0, with
        ``fun(t, y, slope)`` for F; zeros will do where F determines y'. ``jac(t, y, slope)`` then gives ∂F/∂y
        and ∂F/∂y', both dense.
    max_order
        Largest order, 2 to 8.
    data
        Numbers, handed on: ``fun(t, y, data)`` and ``jac(t, y, data)`` are called where they are given.
    steps_at_once
        Steps that one step of this class covers where ``fun`` is compiled. SciPy sees the last one of each:
        others are not in ``solution.t``, and an event that occurs twice in between is missed.

    Attributes
    ----------
    in_python
        Which of ``fun`` and ``jac`` run in Python.

    Notes
    -----
    Functions of numba, made by ``njit`` or ``cfunc``, and `scipy.LowLevelCallable` are called without Python
    in between. A C function is ``void f(double t, double *y, double *out, double *data)``; it fills ``out``,
    a Jacobian row by row, over zeros.

    Examples
    --------
    Van der Pol's oscillator, with a stiffness of 1000:

    >>> from mebdf import MEBDF
    >>> from scipy.integrate import solve_ivp
    >>> oscillator = lambda t, y: [y[1], 1e3 * (1.0 - y[0] ** 2) * y[1] - y[0]]
    >>> solution = solve_ivp(oscillator, (0.0, 2000.0), [2.0, 0.0], method=MEBDF, rtol=1e-6, atol=1e-9)
    >>> print(f"{solution.y[0, -1]:.4f}")
    1.7062

    References
    ----------
    J. R. Cash, Comput. Math. Appl. 9 (1983) 645-657; J. R. Cash, S. Considine, ACM Trans. Math. Softw. 18
    (1992) 142-155.
    """

    def __init__(
        self,
        fun: Any,
        t0: float,
        y0: Any,
        t_bound: float,
        max_step: float = np.inf,
        rtol: ArrayLike = 1e-3,
        atol: ArrayLike = 1e-6,
        jac: Any = None,
        jac_sparsity: Any = None,
        vectorized: bool = False,
        first_step: float | None = None,
        lband: int | None = None,
        uband: int | None = None,
        mass: Any = None,
        index: ArrayLike | None = None,
        test_algebraic: bool | None = None,
        breakpoints: ArrayLike = (),
        slope: ArrayLike | None = None,
        max_order: int = MAX_K + 1,
        data: ArrayLike | None = None,
        steps_at_once: int = 1,
        **extraneous: Any,
    ) -> None:
        warn_extraneous(extraneous)
        span(t0, t_bound)
        self._residual: Residual | None = None
        n, widths = np.size(y0), bands(lband, uband, np.size(y0))
        if slope is not None:
            if any(option is not None for option in (mass, jac_sparsity, widths, data)) or vectorized:
                raise ValueError(
                    "`slope` excludes `mass`, `jac_sparsity`, `lband`, `uband`, `data` and `vectorized`."
                )
            fun = self._residual = Residual(fun, slope, jac, n)
        else:
            numbers = None if data is None else np.array(data, dtype=np.float64).ravel()
            fun = native(fun, (n,), (t0, y0), numbers)
            jac = native(jac, (n if widths is None else sum(widths) + 1, n), (t0, y0), numbers)
        compiled = isinstance(fun, Native)
        # Functions may write into the state that they are given.
        super().__init__(lambda t, y: fun(t, y.copy()), t0, y0, t_bound, vectorized and not compiled)
        self.max_step, (self.rtol, self.atol) = largest_step(max_step), tolerances(rtol, atol, self.n)
        resolved(self.y, self.rtol, self.atol)
        self._sizes = sizes(self.y, self.rtol, self.atol)
        self._index, self._test_algebraic = index, test_algebraic
        self._mass = None if self._residual else read_mass(mass, index, test_algebraic, self.n)
        self._names = [f"component {i}" for i in range(self.n)]
        self._ends = [*inner_times(breakpoints, self.t, self.t_bound), float(self.t_bound)]
        if compiled and jac is None and n <= LARGEST_IN_CORE:
            jac_sparsity = widths = None  # compiled code takes differences column by column
        if self._residual:
            self._jacobian, self._algebra, evaluations = self._implicit_jacobian(self._residual)
        else:
            self._jacobian, self._algebra, evaluations = make_jacobian(
                self, jac, jac_sparsity, widths, (self.rtol, self._sizes), self._mass, self._progress
            )
        plain = callable(jac) and (widths is not None or not isinstance(jac, Native))
        self.in_python = (() if compiled else ("fun",)) + (("jac",) if plain else ())
        if compiled and plain:
            warn("`jac` runs in Python, for `fun` alone is compiled or `jac` gives diagonals.", stacklevel=2)
        self._ahead = self._compiled_loop(fun, jac, steps_at_once) if compiled else None
        self._options: dict[str, Any] = {
            "max_step": self.max_step,
            "largest_k": order(max_order, MAX_K + 1) - 1,
            "inside": True,
            "differenced": evaluations,
            "outside": self._algebra is not None,
        }
        # Evaluations, Jacobians and decompositions before the last breakpoint.
        self._before = (0, 0, 0)
        # Values before a jump of algebraic variables, one to be reported and one that is the last step.
        self._jump: FloatArray | None = None
        self._before_jump: FloatArray | None = None
        self._state = self._new_state(starting_step(first_step, t0, t_bound))

    def _compiled_loop(self, fun: Native, jac: Any, at_once: int) -> Ahead:
        """Return the loop over steps for a compiled function."""
        algebraic = np.zeros(self.n, dtype=bool) if self._mass is None else self._mass.algebraic_equations
        typical = typical_sizes(self.rtol, self._sizes, algebraic=bool(algebraic.any()))
        inside = self._algebra is None and "jac" not in self.in_python
        jacobian = jac if isinstance(jac, Native) and inside else None
        differenced = jac is None and inside
        return Ahead(
            fun, jacobian, differenced=differenced, typical=typical, algebraic=algebraic, at_once=at_once
        )

    def _new_state(self, first_step: float) -> entry.MebdfState:
        """Begin at the present time, up to the next breakpoint or the end."""
        before, mass, warning = self.y, None, ""
        if self._residual:
            mass, warning = self._implicit_start(self._residual)
        elif self._mass is not None:
            self._mass, slope, warning = self._consistent(self.fun_single, self._slopes, self._mass)
            mass = self._mass.for_core(slope)
        if warning:
            warn(warning, stacklevel=4)
            self._jump = before
        t, end, atol = float(self.t), self._ends[0], np.minimum(self.atol, LARGEST_ATOL)
        if self._ahead:
            kink = end if len(self._ends) > 1 else np.inf
            self._ahead.lead_to(kink, float(np.nextafter(kink, t)))
        return new_state(t, self.y, end, self.rtol, atol, first_step=first_step, mass=mass, **self._options)

    def _consistent(
        self, fun: Callable[..., FloatArray], jacobian: Callable[..., Any], mass: MassMatrix
    ) -> tuple[MassMatrix, FloatArray, str]:
        """Find consistent values; return the matrix with the right index, y', and what was changed."""
        t = float(self.t)
        scale = self._sizes + self.rtol * np.abs(self.y)
        # A step leaves variables of higher index as wrong as its weights allow.
        step = self._step_to_come(fun, mass, scale) if self.t_old is None else self._state.number("h_last")
        scale /= min(abs(step), 1.0) ** (mass.index - 1)
        self.y, slope, warning = consistent(fun, jacobian, t, self.y, self._ends[0], mass, scale, self._names)
        if self.t_old is None:
            found = check_index(jacobian, t, self.y, mass.matrix, mass.index, self._typical, self._names)
            if found is not mass.index:
                self._index, mass = found, with_index(mass.matrix, found, self._test_algebraic)
        return mass, slope, warning

    def _step_to_come(self, fun: Callable[..., FloatArray], mass: MassMatrix, scale: FloatArray) -> float:
        """Return the size of step that the tolerance leads to, in a method of middle order."""
        slope = split(mass).slope(fun(float(self.t), self.y)) if np.any(mass.index > 1) else np.zeros(1)
        rate = float(np.max(np.abs(slope) / (1.0 + np.abs(self.y))))
        return float(np.min(scale / (1.0 + np.abs(self.y)))) ** OF_TOLERANCE / rate if rate > 0.0 else 1.0

    @property
    def _typical(self) -> FloatArray:
        """Return the size of each variable at which both its tolerances are equal, shape (n,)."""
        return np.asarray(self._sizes / np.maximum(self.rtol, SMALLEST_RTOL))

    def _slopes(self, t: float, y: FloatArray) -> Any:
        """Return the Jacobian for consistent values: by differences where one that is given may be wrong."""
        if self.n > LARGEST:
            return self._jacobian(t, y)
        return plain_jacobian(self.fun_single, self._typical)(t, y)

    def _implicit_start(self, residual: Residual) -> tuple[entry.Mass, str]:
        """Find consistent values and the slope; return ∂F/∂y' there, and what was changed."""
        t, left, tolerances = float(self.t), self._ends[0] - float(self.t), (self.rtol, self._sizes)
        typical = self._sizes / self.rtol
        self.y, warning = residual.consistent(t, self.y, left, tolerances, self._names)
        of_slope = residual.linearise(t, self.y, typical, left)[1]
        read = read_mass(of_slope, self._index, self._test_algebraic, self.n)
        assert read is not None
        read, _, more = self._consistent(
            residual.explicit(of_slope), lambda t, y: residual.linearise(t, y, typical, left)[0], read
        )
        if more:
            self.y, _ = residual.consistent(t, self.y, left, tolerances, self._names)
        return mass_at_start(of_slope, residual.slope, read), " ".join(filter(None, (warning, more)))

    def _implicit_jacobian(self, residual: Residual) -> Linear:
        """Return the Jacobian of an implicit equation, and who solves with it."""

        def pair(t: float, y: FloatArray) -> tuple[FloatArray, FloatArray]:
            residual.move_to_newest(self._state)
            h = self._state.number("h")
            return residual.linearise(t, y, self._sizes / self.rtol, h)

        def jacobian(t: float, y: FloatArray) -> FloatArray:
            """Renew the mass matrix, too, unless one of them is not finite."""
            of_y, of_slope = pair(t, y)
            if not np.isfinite(of_slope).all():
                return np.full_like(of_y, np.nan)
            if np.isfinite(of_y).all():
                fill_mass(self._state.mass, self._state.places, of_slope)
            return of_y

        if self.n <= LARGEST_IN_CORE:
            return Linear(jacobian, None, residual.evaluations)
        return Linear(jacobian, ImplicitFull(pair, self._sizes / self.rtol), residual.evaluations)

    def _step_impl(self) -> tuple[bool, str | None]:
        """Take one step; return whether it succeeded, and why not."""
        if len(self._ends) > 1 and self.t == self._ends[0]:
            self._before = self.nfev, self.njev, self.nlu
            del self._ends[0]
            try:
                self._state = self._new_state(0.0)
            except ValueError as problem:
                return False, str(problem)
        if self._jump is not None:
            self._before_jump, self._jump = self._jump, None
            self.t = end_of_jump(float(self.t), self._ends[0])
            return True, None
        self._before_jump = None
        step = self._next_step()
        while step is not None and self.direction * (step[0] - self.t) <= 0.0:
            step = self._next_step()  # inside the jump that was the last step
        before = self._before
        if step is None:
            return False, reason(self._state, self._names, self._entry_not_finite)
        self.t, self.y, n_f, n_j, n_lu = step
        self.nfev, self.njev, self.nlu = before[0] + n_f, before[1] + n_j, before[2] + n_lu
        return True, None

    def _next_step(self) -> Step | None:
        """Return the next accepted step, ``None`` where the core has given up."""
        if self._ahead:
            return self._ahead.step(self._state, self._answer)
        if self._core_step() == FAILED:
            return None
        number = self._state.number
        return number("t"), self._state.rows[HISTORY].copy(), number("n_f"), number("n_j"), number("n_lu")

    def _core_step(self) -> int:
        """Evaluate for the core until it has accepted a step or given up; return which."""
        state, fun, rows = self._state, self.fun_single, self._state.rows
        request: int
        while (request := resume(*state)) not in ENDS_OF_STEP:
            if request != NEED_F:
                self._answer(request)
                continue
            t = self._where()
            if self._residual:
                self._residual.move(state)
            f = fun(t, rows[Y])
            if f.size != self.n:  # one number will do for one equation, but not for several
                raise ValueError(
                    f"`fun` is expected to return shape ({self.n},), but returned {f.shape} at t = {t:g}."
                )
            rows[F] = f
        return request

    def _where(self) -> float:
        """Return the time of an evaluation: on the near side of the breakpoint where it is at one."""
        t: float = self._state.number("t_eval")
        return float(np.nextafter(t, self.t)) if len(self._ends) > 1 and t == self._ends[0] else t

    def _answer(self, request: int) -> None:
        """Answer a request of the core for a derivative or a solution."""
        state, algebra, t = self._state, self._algebra, self._where()
        y = state.rows[Y]
        if algebra is None:
            state.matrices[entry.JACOBIAN] = self._jacobian(t, y)
            if self._ahead and isinstance(self._jacobian, CheckedJacobian) and self._jacobian.is_wrong:
                self._ahead.difference()
            return
        answer(request, state, algebra, t, y)
        if isinstance(algebra, ImplicitFull) and request == NEED_JACOBIAN:
            fill_mass(state.mass, state.places, algebra.dense_mass)

    def _progress(self) -> tuple[int, bool]:
        """Return the Jacobians so far, and whether matrices are renewed nearly as often as steps succeed."""
        number = self._state.number
        return self._before[1] + number("n_j"), number("n_lu") > RENEWED * number("steps")

    def _entry_not_finite(self, state: entry.MebdfState) -> tuple[int, int]:
        """Return row and column of the first entry of the Jacobian that is not finite."""
        if self._algebra is not None:
            return self._algebra.entry_not_finite()
        row, column = np.argwhere(~np.isfinite(state.matrices[entry.JACOBIAN]))[0]
        return int(row), int(column)

    def _dense_output_impl(self) -> Callable[..., FloatArray]:
        """Return the polynomial of the last step, or the jump that was it."""
        if self._before_jump is not None:
            return JumpDenseOutput(self.t_old, self.t, self._before_jump, self.y.copy())
        if self._ahead:
            return self._ahead.dense(self.t_old)
        number = self._state.number
        differences = self._state.rows[HISTORY : HISTORY + number("k_last") + 2]
        return MebdfDenseOutput(self.t_old, self.t, number("h_last"), differences)
