"""Newest values by the inputs on which they depend, and tables that objects fill once for kernels."""

import threading
from collections.abc import Callable, Hashable
from typing import Generic, NamedTuple, TypeVar

from tribodyn.core.arrays import FloatArray, FloatMatrix

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
