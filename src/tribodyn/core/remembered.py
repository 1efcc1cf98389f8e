"""Digests of numbers, and values remembered by the inputs on which they depend."""

import hashlib
import threading
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, Final, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatMatrix

_Made = TypeVar("_Made")


class Remembered(Generic[_Made]):
    """Values by key, of which the oldest are forgotten; any thread may ask.

    ``most``: how many are kept.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._known: dict[Hashable, _Made] = {}
        self._changing = threading.Lock()

    def __contains__(self, key: Hashable) -> bool:
        return key in self._known

    def __len__(self) -> int:
        return len(self._known)

    def add(self, key: Hashable, value: _Made) -> None:
        """Remember a value in the place of the oldest where there are too many."""
        with self._changing:
            while len(self._known) >= self._most:
                del self._known[next(iter(self._known))]
            self._known[key] = value

    def made(self, key: Hashable, make: Callable[[], _Made]) -> _Made:
        """Return the value of a key, made where it is not remembered."""
        try:
            return self._known[key]
        except KeyError:
            value = make()
            self.add(key, value)
            return value


class ContactTable(NamedTuple):
    """A contact law tabulated over the separation h* = h/σ on ``n`` equal intervals.

    Between two nodes each quantity is the cubic Hermite polynomial of the node values and slopes.
    """

    #: First and last node, h* [1].
    h_first: float
    h_last: float
    inverse_step: float  #: Reciprocal of the distance between nodes [1].
    #: Shape (n + 1, 4), C-contiguous [Pa]: stiffness pressure P_k, step·dP_k/dh*, damping pressure
    #: coefficient C with its onset smoothing, step·dC/dh*.
    nodes: FloatMatrix
    #: Stored energy per area divided by σ, W_k(h*) = ∫_h*^h_last P_k dh*, shape (n + 1,) [Pa]: the exact
    #: integral of the interpolated P_k.
    energy: FloatArray
    #: The polynomials as kernels evaluate them: eight coefficients [Pa] for each interval, P_k and then C in
    #: rising powers of the distance from its lower node in steps, shape (8 (n + 2),). The first eight
    #: continue below the table linearly, in the distance from one step below the first node; the last eight
    #: are zero and stand for everything above.
    cubics: FloatArray


#: Numbers of a process, not of a case: addresses of force laws, and the pivots of the last factorisation.
_OF_PROCESS: Final = ("law", "exchanges")
_BLOCK: Final = 4_000_000  #: Size of what is copied at once [B].


def digest(*values: Any) -> str:
    """Return the hash of values; of functions their places alone count, of NaN all bit patterns are one."""
    found = hashlib.sha256()
    _add(found, "", values)
    return found.hexdigest()


def _add(found: Any, name: str, value: Any) -> None:
    """Add a number, a text, an array, a record, or a tuple of such; functions add their place alone."""
    if (parts := _parts(value)) is not None:
        for part, inside in parts:
            if not (part in _OF_PROCESS and np.asarray(inside).dtype.kind == "i"):
                _add(found, f"{name}.{part}", inside)
    elif isinstance(value, str):
        found.update(f"{name} {value} ".encode())
    elif isinstance(value, np.ndarray | np.generic | float | int):
        array = np.asarray(value)
        found.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        for block in _blocks(array):
            found.update(block)
    else:
        found.update(f"{name} ".encode())


def _parts(value: Any) -> Iterable[tuple[object, Any]] | None:
    """Return the parts of a tuple, a record or an array of records with their names, else None."""
    if isinstance(value, tuple):
        return zip(getattr(value, "_fields", range(len(value))), value, strict=True)
    if not isinstance(value, np.ndarray | np.void) or value.dtype.names is None:
        return None
    fields = np.asarray(value).view(np.ndarray)  # of records NumPy finds entries by slower ways
    return [(part, fields[part]) for part in value.dtype.names]


def _blocks(array: NDArray[Any]) -> Iterator[NDArray[Any]]:
    """Yield an array in contiguous parts, every NaN with the same bits."""
    cut = array.nbytes >= _BLOCK
    for part in np.array_split(array, array.nbytes // _BLOCK + 1) if cut else (array,):
        block = np.ascontiguousarray(part)
        if block.dtype.kind == "f" and (unknown := np.isnan(block)).any():
            block = np.where(unknown, np.nan, block)
        yield block
