"""A problem as the plain functions of time and state that methods call."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics
from tribodyn.core.remembered import Remembered


def is_compiled(function: Callable[..., None]) -> bool:
    """Tell whether numba compiles a function."""
    return hasattr(function, "compile")


_MOST: Final = 32
"""Kinds of problems that a process remembers."""
_types: Final[Remembered[Any]] = Remembered(_MOST)
"""Numba's types of data and of memories, by all that they depend on."""
_codes: Final[Remembered[tuple[object, CompiledFunctions]]] = Remembered(_MOST)
"""Types and compiled functions, by functions and identities of types, which live as long as they are here."""


def kernel_types(problem: Problem) -> tuple[Any, Any]:
    """Return numba's types of data and memory, the same objects for all problems of a kind.

    ``None`` and ``None`` where no function of the problem is compiled.
    """
    if not any(map(is_compiled, vars(problem.functions).values())):
        return None, None
    return type_of(problem.data), type_of(problem.memory)


def type_of(value: Any) -> Any:
    """Return numba's type of a number, an array, a record, or nested tuples of such.

    Numba takes milliseconds, most of them for types of records and for hashes of nested types.
    """
    return _types.made(_structure(value), lambda: _type_of(value))


def _structure(value: Any) -> Any:
    """Return all that the type of a value depends on."""
    if isinstance(value, tuple):
        return type(value), *map(_structure, value)
    if isinstance(value, np.ndarray | np.void):
        flags = value.flags
        order = flags.c_contiguous, flags.f_contiguous, flags.aligned, flags.writeable
        return type(value), value.dtype, value.ndim, order
    return _type_of(value)


def _type_of(value: Any) -> Any:
    import numba
    from numba.core.types import BaseTuple

    if isinstance(value, tuple):
        of_tuple: Callable[..., Any] = BaseTuple.from_types
        return of_tuple([type_of(member) for member in value], type(value))
    typeof: Callable[[Any], Any] = numba.typeof
    return typeof(value)


def call(kernel: Callable[..., None], *arguments: Any) -> None:
    """Call a ``kernel`` of :mod:`tribodyn.kernels.jit`; numba takes milliseconds to find nested types."""
    for_python = getattr(kernel, "for_python", None)
    (kernel if for_python is None else for_python().compile(tuple(map(type_of, arguments))))(*arguments)


def argument_types(problem: Problem, types: tuple[Any, Any]) -> dict[str, tuple[Any, ...]]:
    """Return numba's types of the arguments of each function of a problem, by its name.

    Parameters
    ----------
    problem
        The problem.
    types
        Of data and memory, from :func:`kernel_types`.
    """
    from numba import float64
    from numba.core.types import Array

    vector = float64[::1]
    matrix = float64[:, ::1] if problem.algebra is None else vector
    return {
        "rhs": (float64, vector, *types, vector),
        "jac": (float64, vector, *types, vector, matrix),
        "enter": (float64, vector, *types),
        "advance": (float64, float64, vector, *types),
        "accept": (float64, vector, *types),
        "observe": (float64, vector, *types, vector),
        "picture": (float64, vector, *types, Array(float64, max(len(problem.field_shape), 1), "C")),
    }


def machine_code(problem: Problem, types: tuple[Any, Any]) -> CompiledFunctions:
    """Return the functions of a problem compiled for the types of its data and memory.

    A call of a numba function first finds out the types of its arguments, which takes 10 µs
    for the nested data of a mechanism, more than many right-hand sides. These types never
    change during an integration, so the compiled code is asked for once. Functions that are
    not compiled are returned as they are.

    Parameters
    ----------
    problem
        The problem.
    types
        From :func:`kernel_types`.
    """

    def compiled() -> tuple[object, CompiledFunctions]:
        arguments = argument_types(problem, types)
        functions = {name: getattr(problem.functions, name) for name in arguments}
        return types, CompiledFunctions(
            **{
                name: function.compile(arguments[name]) if is_compiled(function) else function
                for name, function in functions.items()
            }
        )

    return _codes.made(code_key(problem, types), compiled)[1]


def code_key(problem: Problem, types: tuple[Any, Any]) -> tuple[object, ...]:
    """Return the types on which the compiled functions of a problem depend; they have to be kept with it."""
    algebra = problem.algebra
    solvers = None if algebra is None else (algebra.factorise, algebra.solve)
    return problem.functions, solvers, len(problem.field_shape), *map(id, types)


def all_finite(values: FloatArray) -> bool:
    """Tell whether no number is infinite or nan; for few numbers faster than NumPy, and without warnings."""
    return isfinite(sum(values.tolist()))


class Binding:
    """Right-hand side and Jacobian of a problem, counted and watched for numbers that are not finite.

    A trial state of Newton's iteration may lie where the model is not defined. The right-hand
    side then hands the NaN to the method, which shortens its step; what happened is
    remembered for the message if it cannot recover. The Jacobian only steers that iteration,
    so the last finite one is as good there.

    Parameters
    ----------
    problem
        The problem; its memory is read at each call.
    functions
        Its functions, see :func:`machine_code`.
    statistics
        Where evaluations are counted.
    """

    def __init__(self, problem: Problem, functions: CompiledFunctions, statistics: Statistics) -> None:
        self._rhs = functions.rhs
        self._jac = functions.jac
        self._data = problem.data
        self._memory = problem.memory
        self._names = problem.state_names
        self._n = problem.y0.size
        self._places = None if problem.algebra is None else problem.algebra.places
        self._last_jacobian: FloatArray | None = None
        self._statistics = statistics
        self.note = ""

    def rhs(self, t: float, y: FloatArray) -> FloatArray:
        """Return dy/dt, a new array of shape (n,)."""
        self._statistics.rhs_evaluations += 1
        f = np.empty(self._n)
        self._rhs(t, y, self._data, self._memory, f)
        if not all_finite(f):
            self.note = f"rate of {self.first_not_finite(f)} was not finite at t = {t:.9g} s"
        return f

    def jac(self, t: float, y: FloatArray) -> FloatArray:
        """Return the Jacobian of the right-hand side, a new array of shape (n, n)."""
        jacobian = self._filled(t, y)
        if self._places is not None:
            entries, jacobian = jacobian, np.zeros((self._n, self._n))
            np.add.at(jacobian, tuple(self._places), entries)
        if np.isfinite(jacobian).all():
            self._last_jacobian = jacobian
        elif self._last_jacobian is None:
            row, column = np.argwhere(~np.isfinite(jacobian))[0]
            entry = f"d(rate of {self._names[row]})/d({self._names[column]})"
            raise IntegrationFailure(t, f"the Jacobian entry {entry} is not finite")
        return self._last_jacobian.copy()

    def sparse_jac(self, t: float, y: FloatArray) -> Any:
        """Return the Jacobian in compressed columns, shape (n, n); as it is where it is not finite."""
        from scipy.sparse import coo_array, csc_array

        filled = self._filled(t, y)
        if self._places is None:
            return csc_array(filled)
        return coo_array((filled, tuple(self._places)), shape=(self._n, self._n)).tocsc()

    def _filled(self, t: float, y: FloatArray) -> FloatArray:
        """Return the array that ``jac`` fills: (n, n), or (n_entries,) with an algebra of its own."""
        self._statistics.jacobian_evaluations += 1
        shape = (self._n, self._n) if self._places is None else self._places.shape[1:]
        jacobian = np.zeros(shape)
        self._jac(t, y, self._data, self._memory, np.empty(self._n), jacobian)
        return jacobian

    def first_not_finite(self, values: FloatArray) -> str:
        """Return the name of the first state whose value is not finite, empty if all are."""
        bad = np.flatnonzero(~np.isfinite(values))
        return self._names[int(bad[0])] if bad.size else ""

    def reason(self, reason: str) -> str:
        """Add to the reason of a failure what was not finite since the last accepted step."""
        return f"{reason}; the {self.note}" if self.note else reason
