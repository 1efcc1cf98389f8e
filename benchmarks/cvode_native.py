"""CVODE called without Python in between: the SUNDIALS libraries that scikit-sundae brings, through ctypes.

The right-hand side and the Jacobian are the compiled functions of the benchmark, wrapped as C functions.
"""

from __future__ import annotations

import ctypes as ct
import time
from functools import cache
from pathlib import Path
from typing import Any

import numba as nb
import numpy as np

from benchmarks.problems import Benchmark

CV_BDF, CV_NORMAL = 2, 1
_ADDRESS = ct.c_void_p


@cache
def _library() -> dict[str, ct.CDLL]:
    """Load the libraries."""
    import sksundae.cvode  # loads the dependencies of the libraries

    folder = Path(sksundae.cvode.__file__).parents[2] / "scikit_sundae.libs"
    names = ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode")
    return {n: ct.CDLL(str(next(folder.glob(f"libsundials_{n}-*.so*"))), mode=ct.RTLD_GLOBAL) for n in names}


def _call(library: str, name: str, *arguments: Any, result: Any = ct.c_int) -> Any:
    function = getattr(_library()[library], name)
    function.restype = result
    return function(*arguments)


@nb.njit
def _data(vector: int) -> int:
    """Return the address of the numbers of a serial N_Vector: content, then {length, own_data, data}.

    The wheel of scikit-sundae has 32-bit indices: length and own_data share one word.
    """
    content = nb.carray(_pointer(vector), 1)[0]
    return nb.carray(_pointer(content), 2)[1]


@nb.extending.intrinsic
def _pointer(typingctx: Any, address: Any) -> Any:
    """Turn an address into a pointer to addresses."""
    signature = nb.types.CPointer(nb.types.intp)(nb.types.intp)

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], context.get_value_type(sig.return_type))

    return signature, generate


@nb.extending.intrinsic
def _floats(typingctx: Any, address: Any) -> Any:
    """Turn an address into a pointer to floats."""
    signature = nb.types.CPointer(nb.types.float64)(nb.types.intp)

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], context.get_value_type(sig.return_type))

    return signature, generate


@cache
def _callbacks(name: str) -> tuple[Any, Any]:
    """Return the C functions of a problem."""
    from benchmarks.problems import PROBLEMS

    problem = PROBLEMS[name]
    rhs, jac, n = problem.rhs, problem.jac, problem.y0.size
    address = nb.types.intp

    @nb.cfunc(nb.int32(nb.float64, address, address, address))
    def c_rhs(t, y, f, user):  # type: ignore[no-untyped-def]
        rhs(t, nb.carray(_floats(_data(y)), (n,)), nb.carray(_floats(_data(f)), (n,)))
        return 0

    @nb.cfunc(nb.int32(nb.float64, address, address, address, address, address, address, address))
    def c_jac(t, y, f, matrix, user, a, b, c):  # type: ignore[no-untyped-def]
        # A dense SUNMatrix: content, then {M, N, data, ...}; M and N share one word.
        content = nb.carray(_pointer(matrix), 1)[0]
        columns = nb.carray(_floats(nb.carray(_pointer(content), 2)[1]), (n, n))
        rows = np.empty((n, n))
        jac(t, nb.carray(_floats(_data(y)), (n,)), rows)
        for i in range(n):
            for j in range(n):
                columns[j, i] = rows[i, j]
        return 0

    return c_rhs, c_jac


def cvode(problem: Benchmark, rtol: float) -> dict[str, Any]:
    """Integrate with CVODE; return digits, counts and the time of the integration alone [s]."""
    n = problem.y0.size
    c_rhs, c_jac = _callbacks(problem.name)
    context = _ADDRESS()
    _call("core", "SUNContext_Create", ct.c_int(0), ct.byref(context))
    y0, atol = problem.y0.copy(), problem.atol * rtol
    make = ("nvecserial", "N_VMake_Serial", ct.c_int32(n))
    y = _ADDRESS(_call(*make, y0.ctypes.data_as(_ADDRESS), context, result=_ADDRESS))
    tolerance = _ADDRESS(_call(*make, atol.ctypes.data_as(_ADDRESS), context, result=_ADDRESS))
    memory = _ADDRESS(_call("cvode", "CVodeCreate", CV_BDF, context, result=_ADDRESS))
    matrix = _ADDRESS(
        _call("sunmatrixdense", "SUNDenseMatrix", ct.c_int32(n), ct.c_int32(n), context, result=_ADDRESS)
    )
    solver = _ADDRESS(_call("sunlinsoldense", "SUNLinSol_Dense", y, matrix, context, result=_ADDRESS))
    _call("cvode", "CVodeInit", memory, _ADDRESS(c_rhs.address), ct.c_double(0.0), y)
    _call("cvode", "CVodeSVtolerances", memory, ct.c_double(rtol), tolerance)
    _call("cvode", "CVodeSetLinearSolver", memory, solver, matrix)
    _call("cvode", "CVodeSetJacFn", memory, _ADDRESS(c_jac.address))
    _call("cvode", "CVodeSetMaxNumSteps", memory, ct.c_long(10**7))
    _call("cvode", "CVodeSetStopTime", memory, ct.c_double(problem.t_end))
    reached = ct.c_double(0.0)
    function = _library()["cvode"].CVode
    begin = time.perf_counter()
    flag = function(memory, ct.c_double(problem.t_end), y, ct.byref(reached), CV_NORMAL)
    seconds = time.perf_counter() - begin
    counts = {}
    for key, name in (
        ("steps", "CVodeGetNumSteps"),
        ("rhs", "CVodeGetNumRhsEvals"),
        ("jac", "CVodeGetNumJacEvals"),
        ("lu", "CVodeGetNumLinSolvSetups"),
    ):
        value = ct.c_long(0)
        _call("cvode", name, memory, ct.byref(value))
        counts[key] = value.value
    _call("cvode", "CVodeFree", ct.byref(memory))
    _call("nvecserial", "N_VDestroy_Serial", y)
    _call("nvecserial", "N_VDestroy_Serial", tolerance)
    return {"failed": flag < 0, "digits": problem.digits(y0), **counts, "seconds": seconds}
