"""Compiled functions of users: their addresses, how Python calls them, and the steps taken with them."""

import ctypes
import sys
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any, Final, TypeAlias
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike
from scipy import LowLevelCallable
from scipy.integrate import OdeSolution

from mebdf.arrays import FloatArray
from mebdf.dense import MebdfDenseOutput
from mebdf.kernels import ahead
from mebdf.kernels.phases import FAILED, STEP_ACCEPTED
from mebdf.kernels.state import N_DIFFERENCES, MebdfState

#: Signature of compiled functions of (t, y, out, data); the last address may be one of anything.
C_FUNCTION: Final = "void (double, double *, double *, double *)"
#: Steps taken ahead at most; their number doubles from one: where an event ends, few are of no use.
MOST_AHEAD: Final = 256
MOST_NUMBERS: Final = 1 << 22  #: Numbers kept of steps taken ahead, at most.
#: End of a step and the state there; evaluations, Jacobians and decompositions so far.
Step: TypeAlias = tuple[float, FloatArray, int, int, int]
_name_of: Final[Any] = ctypes.pythonapi.PyCapsule_GetName
_name_of.restype, _name_of.argtypes = ctypes.c_char_p, [ctypes.py_object]
_address_in: Final[Any] = ctypes.pythonapi.PyCapsule_GetPointer
_address_in.restype, _address_in.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]


class Native:
    """A compiled function ``void f(double t, double *y, double *out, double *data)``.

    ``function``: with its address and signature; ``shape``: shape of ``out``, which holds zeros before, row
    by row; ``data``: numbers that it is given.
    """

    def __init__(self, function: LowLevelCallable, shape: tuple[int, ...], data: FloatArray) -> None:
        found = function.signature.replace("const ", "").replace("void *)", "double *)")
        if found != C_FUNCTION:
            raise ValueError(f"A compiled function must be `{C_FUNCTION}`, not `{function.signature}`.")
        capsule = tuple.__getitem__(function, 0)
        self.address: int = _address_in(capsule, _name_of(capsule))
        self._function, self._shape, self.data = function, shape, data

    def __call__(self, t: float, y: FloatArray) -> FloatArray:
        """Return its result as a new array."""
        out = np.zeros(self._shape)
        ahead.call_from_python(self.address, t, np.array(y, dtype=np.float64), out, self.data)
        return out


def native(function: Any, shape: tuple[int, ...], start: tuple[float, Any], data: FloatArray | None) -> Any:
    """Return a compiled function as a `Native`, another as a function of (t, y), and anything else as it is.

    ``function``: `scipy.LowLevelCallable`, or what numba's ``cfunc`` or ``njit`` has made; ``shape``: shape
    of its result; ``start``: time and state, shape (n,), for which a function of numba is tried; ``data``:
    numbers that it is given, ``None`` for none.
    """
    numbers = np.zeros(0) if data is None else data
    if isinstance(function, LowLevelCallable):
        return Native(function, shape, numbers)
    if _is_made(function, "numba.core.ccallback", "CFunc"):
        return Native(LowLevelCallable(function.ctypes), shape, numbers)
    arguments = () if data is None else (data,)
    if _is_made(function, "numba.core.dispatcher", "Dispatcher"):
        t, y = float(start[0]), np.array(start[1], dtype=np.float64)
        found = np.shape(function(t, y, *arguments))
        if found != shape:
            raise ValueError(f"A function is expected to return shape {shape}, but returned {found}.")
        try:
            made = _c_function(function, shape, y.size, None if data is None else data.size)
            return Native(LowLevelCallable(made.ctypes), shape, numbers)
        except sys.modules["numba.core.errors"].NumbaError:
            warn(f"`{function.__name__}` runs in Python: numba gives no array of it.", stacklevel=4)
    return (lambda t, y: function(t, y, data)) if arguments and callable(function) else function


def _is_made(function: Any, module: str, name: str) -> bool:
    """Tell whether a function is of a class, in a module that need not be imported."""
    return module in sys.modules and isinstance(function, getattr(sys.modules[module], name))


@lru_cache(64)
def _c_function(function: Any, shape: tuple[int, ...], n: int, size: int | None) -> Any:
    """Return the C function of a function of numba."""
    import numba

    nb: Any = numba  # which has no types
    numbers = nb.types.CPointer(nb.float64)
    rows = shape[0]

    if size is None:

        @nb.njit
        def value(t, y, data):  # type: ignore[no-untyped-def]
            return function(t, nb.carray(y, n))
    else:

        @nb.njit
        def value(t, y, data):  # type: ignore[no-untyped-def]
            return function(t, nb.carray(y, n), nb.carray(data, size))

    def fill(t, y, out, data):  # type: ignore[no-untyped-def]
        out[0] = np.nan  # what stays where the function raises
        found = value(t, y, data)
        if len(found) == rows:
            for i in range(rows):
                out[i] = found[i]

    def fill_rows(t, y, out, data):  # type: ignore[no-untyped-def]
        out[0] = np.nan
        found = value(t, y, data)
        if found.shape == shape:
            for i in range(found.size):
                out[i] = found.flat[i]

    signature = nb.void(nb.float64, numbers, numbers, numbers)
    return nb.cfunc(signature)(fill if len(shape) == 1 else fill_rows)


class Ahead:
    """The loop over steps in compiled code, some steps ahead of the solver.

    ``fun``, ``jac``: compiled functions; ``jac`` is ``None`` where Python evaluates the Jacobian;
    ``differenced``: whether the Jacobian comes from differences; ``typical``: size below which that of a
    variable does not shrink its moves in differences, shape (n,); ``algebraic``: which equations have no
    derivatives, shape (n,); ``at_once``: steps of the loop for one of the solver.
    """

    def __init__(
        self,
        fun: Native,
        jac: Native | None,
        *,
        differenced: bool,
        typical: FloatArray,
        algebraic: ArrayLike,
        at_once: int,
    ) -> None:
        n = typical.size
        self._most = max(at_once, min(MOST_AHEAD, MOST_NUMBERS // (n * N_DIFFERENCES)), 1)
        work = np.zeros((ahead.N_WORK, n))
        work[ahead.TYPICAL], work[ahead.ALGEBRAIC], work[ahead.SHARE] = typical, algebraic, ahead.LEAST
        given = ahead.IN_PYTHON if jac is None else jac.address
        self._calls = ahead.Calls(
            functions=np.array([fun.address, ahead.BY_DIFFERENCES if differenced else given]),
            data=fun.data,
            kink=np.full(2, np.inf),
            work=work,
            ends=np.empty((self._most, 2)),
            counts=np.empty((self._most, ahead.N_COUNTS), dtype=np.int64),
            differences=np.empty((self._most, N_DIFFERENCES, n)),
        )
        self._at_once, self._limit = at_once, at_once
        self._first = self._next = self._taken = 0
        self._steps: Iterator[Step] = iter(())
        self._failed = False

    def lead_to(self, kink: float, before: float) -> None:
        """Note the breakpoint that the integration leads to, and the last time before it."""
        self._calls.kink[:] = kink, before

    def difference(self) -> None:
        """Take differences from now on."""
        self._calls.functions[ahead.JAC] = ahead.BY_DIFFERENCES

    def step(self, state: MebdfState, answer: Callable[[int], None]) -> Step | None:
        """Return the next step, ``None`` where the core gave up.

        ``state``: the integration, which is ahead of it; ``answer``: ``answer(request)`` answers a request of
        the core that compiled code cannot.
        """
        if self._next == self._taken and not self._walk(state, answer):
            return None
        self._first, self._next = self._next, min(self._next + self._at_once, self._taken)
        return next(self._steps)

    def _walk(self, state: MebdfState, answer: Callable[[int], None]) -> bool:
        """Take steps ahead; return whether there were any."""
        taken, request, calls = 0, 0 if not self._failed else FAILED, self._calls
        while request not in (STEP_ACCEPTED, FAILED):
            taken, request = ahead.walk(state, calls, taken, self._limit)
            if request not in (STEP_ACCEPTED, FAILED):
                answer(request)
        self._failed = request == FAILED
        self._next, self._taken = 0, taken
        self._limit = max(self._at_once, min(2 * self._limit, self._most))
        lasts = [*range(self._at_once - 1, taken - 1, self._at_once), taken - 1] if taken > 0 else []
        columns = (
            calls.ends[lasts, 0].tolist(),
            calls.differences[lasts, 0],
            *calls.counts[lasts, 1:].T.tolist(),
        )
        self._steps = zip(*columns, strict=True)
        return taken > 0

    def dense(self, t_old: float) -> Callable[..., FloatArray]:
        """Return the polynomial of the last step, or those of the steps that it consists of."""
        times, parts = [t_old], []
        for k in range(self._first, self._next):
            t, h = self._calls.ends[k].tolist()
            if (t - times[-1]) * h > 0.0:
                differences = self._calls.differences[k, : self._calls.counts[k, ahead.DEGREE] + 1]
                parts.append(MebdfDenseOutput(times[-1], t, h, differences))
                times.append(t)
        return parts[0] if len(parts) == 1 else OdeSolution(times, parts)
