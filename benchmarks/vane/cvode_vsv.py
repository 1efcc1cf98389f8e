"""CVODE on a problem with memory, called from compiled code: an integrator like those of tribodyn.integrate.

The same walk over accepted steps as that of ``tribodyn.kernels.mebdf.drive``. Steps are taken one by one with
the accepted-step functions in between; states inside a step are CVODE's own interpolant.
"""

from __future__ import annotations

import ctypes as ct
from functools import cache
from typing import Any, Final

import numba as nb
import numpy as np
from numba.core import cgutils, imputils

import mebdf.compiled.jit  # noqa: F401  # has numba call kernels
from benchmarks.solver.sundials import CV_ONE_STEP, Cvode, columns, counts, library, numbers, vector
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Solution
from tribodyn.integrate.driver import IntegrationTask, Walk

ENDED: Final = 0
_INT: Final = nb.types.intp


@nb.extending.intrinsic
def address_of(typingctx: Any, value: Any) -> Any:
    """Return where a copy of a value lies that lives as long as the function that asks."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.ptrtoint(cgutils.alloca_once_value(builder, args[0]), context.get_value_type(_INT))

    return _INT(value), generate


def reader_of(kind: Any) -> Any:
    """Return an intrinsic that reads a value of type ``kind`` at an address."""

    @nb.extending.intrinsic
    def value_at(typingctx: Any, address: Any) -> Any:
        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            pointer = builder.inttoptr(args[0], context.get_value_type(kind).as_pointer())
            return imputils.impl_ret_borrowed(context, builder, kind, builder.load(pointer))

        return kind(_INT), generate

    return value_at


@cache
def _callbacks(functions: CompiledFunctions, kind: Any, n: int) -> tuple[Any, Any]:
    """Return right-hand side and Jacobian as C functions that find data and memory in the user data."""
    rhs, jac, given = functions.rhs, functions.jac, reader_of(kind)

    @nb.cfunc(nb.int32(nb.float64, _INT, _INT, _INT))
    def c_rhs(t, y, f, user):  # type: ignore[no-untyped-def]
        data, memory = given(user)
        rhs(t, numbers(y, n), data, memory, numbers(f, n))
        return 0

    @nb.cfunc(nb.int32(nb.float64, _INT, _INT, _INT, _INT, _INT, _INT, _INT))
    def c_jac(t, y, f, matrix, user, a, b, c):  # type: ignore[no-untyped-def]
        data, memory = given(user)
        filled = columns(matrix, n)
        rows, rate = np.zeros((n, n)), np.empty(n)
        jac(t, numbers(y, n), data, memory, rate, rows)
        for i in range(n):
            for j in range(n):
                filled[j, i] = rows[i, j]
        return 0

    return c_rhs, c_jac


def _function(name: str, *arguments: Any) -> Any:
    """Return a function of CVODE that compiled code can call; addresses are numbers there."""
    found = ct.CFUNCTYPE(ct.c_int, *arguments)((name, library()["cvode"]))
    return found


@cache
def _loop(functions: CompiledFunctions) -> Any:
    """Return the compiled walk over one segment."""
    advance, accept, observe = functions.advance, functions.accept, functions.observe
    step = _function("CVode", ct.c_int64, ct.c_double, ct.c_int64, ct.c_int64, ct.c_int)
    interpolate = _function("CVodeGetDky", ct.c_int64, ct.c_double, ct.c_int, ct.c_int64)
    set_data = _function("CVodeSetUserData", ct.c_int64, ct.c_int64)

    @nb.njit
    def run(solver, vectors, end, times, rows, position, reached, t_end, tolerance, data, memory):  # type: ignore[no-untyped-def]
        given = (data, memory)
        set_data(solver, address_of(given))
        newest = numbers(vectors[0], end.size)
        where = np.zeros(1)
        while where[0] < t_end:
            flag = step(solver, t_end, vectors[0], where.ctypes.data, CV_ONE_STEP)
            if flag < 0:
                return flag
            t = where[0]
            ended = False
            while not ended:
                mark = times[position[0]]
                inside = mark < t - tolerance
                ended = not inside
                t_part = mark if inside else t
                if inside:
                    interpolate(solver, t_part, 0, vectors[1])
                else:
                    end[:] = newest
                advance(reached[0], t_part, end, data, memory)
                reached[0] = t_part
                if mark <= t + tolerance:
                    observe(t_part, end, data, memory, rows[position[0]])
                    position[0] += 1
            accept(t, newest, data, memory)
        return ENDED

    return run


class NativeCvode:
    """The integrator, see :class:`tribodyn.integrate.driver.Integrator`; it takes no pictures."""

    def __call__(self, task: IntegrationTask) -> Solution:
        """Integrate."""
        walk = _NativeWalk(task)
        return walk.solve(walk.compiled_segment)


class _NativeWalk(Walk):
    """One integration under way."""

    def compiled_segment(self, t_end: float) -> None:
        """Integrate to the next breakpoint or to the end."""
        problem = self.problem
        y = self.y.copy()
        kind = nb.typeof((problem.data, problem.memory))
        rhs, jac = _callbacks(problem.functions, kind, y.size)
        solver = Cvode(rhs.address, jac.address, self.t, y, self.rtol, problem.atol)
        solver("CVodeSetStopTime", ct.c_double(t_end))
        end = y.copy()
        vectors = [solver.y, vector(end, solver.context)]
        position = np.array([self.next_mark])
        flag = _loop(problem.functions)(
            solver.memory.value,
            np.array([each.value for each in vectors]),
            end,
            np.array(self.marks),
            self.kept.rows,
            position,
            np.array([self.t]),
            t_end,
            self.schedule.tolerance,
            problem.data,
            problem.memory,
        )
        found = counts(solver.memory)
        solver.free()
        self.t, self.y = t_end, y
        self.next_mark = int(position[0])
        self.kept.numbers = self.next_mark, 0
        self.statistics.steps += found["steps"]
        self.statistics.rhs_evaluations += found["rhs"]
        self.statistics.jacobian_evaluations += found["jac"]
        self.statistics.lu_decompositions += found["lu"]
        if flag != ENDED:
            raise IntegrationFailure(self.t, f"CVODE returned {flag}")


NATIVE_CVODE: Final = NativeCvode()
