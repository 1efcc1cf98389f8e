"""The SUNDIALS libraries that scikit-sundae brings, for calls without Python in between."""

from __future__ import annotations

import ctypes as ct
from functools import cache
from pathlib import Path
from typing import Any, Final

import numba as nb
from numpy.typing import NDArray

CV_BDF: Final = 2
CV_NORMAL: Final = 1
CV_ONE_STEP: Final = 2
ADDRESS: Final = ct.c_void_p

COUNTS: Final = {
    "steps": "CVodeGetNumSteps",
    "rhs": "CVodeGetNumRhsEvals",
    "jac": "CVodeGetNumJacEvals",
    "lu": "CVodeGetNumLinSolvSetups",
}


@cache
def library() -> dict[str, ct.CDLL]:
    """Load the libraries."""
    import sksundae.cvode  # loads the dependencies of the libraries

    folder = Path(sksundae.cvode.__file__).parents[2] / "scikit_sundae.libs"
    names = ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode")
    return {n: ct.CDLL(str(next(folder.glob(f"libsundials_{n}-*.so*"))), mode=ct.RTLD_GLOBAL) for n in names}


def call(name: str, function: str, *arguments: Any, result: Any = ct.c_int) -> Any:
    """Call a function of a library."""
    found = getattr(library()[name], function)
    found.restype = result
    return found(*arguments)


def make(name: str, function: str, *arguments: Any) -> ct.c_void_p:
    """Call a function that returns an address."""
    return ADDRESS(call(name, function, *arguments, result=ADDRESS))


def vector(values: NDArray[Any], context: ct.c_void_p) -> ct.c_void_p:
    """Return an N_Vector whose numbers are those of an array; the wheel has 32-bit indices."""
    data = values.ctypes.data_as(ADDRESS)
    return make("nvecserial", "N_VMake_Serial", ct.c_int32(values.size), data, context)


def counts(solver: ct.c_void_p) -> dict[str, int]:
    """Return what CVODE has counted."""
    found = {}
    for key, name in COUNTS.items():
        value = ct.c_long(0)
        call("cvode", name, solver, ct.byref(value))
        found[key] = value.value
    return found


class Cvode:
    """A CVODE solver with BDF, Newton's iteration and a dense matrix.

    Parameters
    ----------
    rhs, jac
        Addresses of the C functions.
    t
        Initial time.
    y
        Initial state, shape (n,): it is changed in place.
    rtol, atol
        Tolerances; ``atol`` has shape (n,).
    """

    def __init__(
        self, rhs: int, jac: int, t: float, y: NDArray[Any], rtol: float, atol: NDArray[Any]
    ) -> None:
        self.context = ADDRESS()
        call("core", "SUNContext_Create", ct.c_int(0), ct.byref(self.context))
        self._atol, n = atol.copy(), ct.c_int32(y.size)
        self.y, self.tolerance = vector(y, self.context), vector(self._atol, self.context)
        self.memory = make("cvode", "CVodeCreate", CV_BDF, self.context)
        self.matrix = make("sunmatrixdense", "SUNDenseMatrix", n, n, self.context)
        self.solver = make("sunlinsoldense", "SUNLinSol_Dense", self.y, self.matrix, self.context)
        self("CVodeInit", ADDRESS(rhs), ct.c_double(t), self.y)
        self("CVodeSVtolerances", ct.c_double(rtol), self.tolerance)
        self("CVodeSetLinearSolver", self.solver, self.matrix)
        self("CVodeSetJacFn", ADDRESS(jac))
        self("CVodeSetMaxNumSteps", ct.c_long(10**7))

    def __call__(self, function: str, *arguments: Any) -> None:
        """Call a function of CVODE for this solver."""
        flag = call("cvode", function, self.memory, *arguments)
        assert flag == 0, (function, flag)

    def free(self) -> None:
        """Give the memory back."""
        call("cvode", "CVodeFree", ct.byref(self.memory))
        call("sunlinsoldense", "SUNLinSolFree_Dense", self.solver)
        call("sunmatrixdense", "SUNMatDestroy_Dense", self.matrix)
        for each in (self.y, self.tolerance):
            call("nvecserial", "N_VDestroy_Serial", each)
        call("core", "SUNContext_Free", ct.byref(self.context))


def _pointer_to(element: Any) -> Any:
    """Return an intrinsic that turns an address into a pointer to ``element``."""

    @nb.extending.intrinsic
    def pointer(typingctx: Any, address: Any) -> Any:
        signature = nb.types.CPointer(element)(nb.types.intp)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            return builder.inttoptr(args[0], context.get_value_type(sig.return_type))

        return signature, generate

    return pointer


addresses = _pointer_to(nb.types.intp)
floats = _pointer_to(nb.types.float64)


@nb.njit
def numbers(vector: int, n: int) -> Any:
    """Return the numbers of a serial N_Vector: content, then {length, own_data, data}.

    The wheel of scikit-sundae has 32-bit indices: length and own_data share one word.
    """
    content = nb.carray(addresses(vector), 1)[0]
    return nb.carray(floats(nb.carray(addresses(content), 2)[1]), (n,))


@nb.njit
def columns(matrix: int, n: int) -> Any:
    """Return a dense SUNMatrix, one column a row: content, then {M, N, data, ...}, M and N in one word."""
    content = nb.carray(addresses(matrix), 1)[0]
    return nb.carray(floats(nb.carray(addresses(content), 2)[1]), (n, n))
