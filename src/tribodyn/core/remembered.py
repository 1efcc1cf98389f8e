"""Newest values, by the inputs on which they depend."""

import threading
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

_Made = TypeVar("_Made")


class Remembered(Generic[_Made]):
    """Values by key, of which the oldest are forgotten; any thread may ask.

    Parameters
    ----------
    most
        How many are kept.
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
