"""Rows at accepted steps, where a problem asks for them: collected, and thinned where they are too many."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Following

CHUNK: Final = 512
"""Rows collected between two visits."""
_UNTHINNED: Final = 4
"""A stretch is thinned on the way when it holds this many times the rows that it may keep."""

Rows = tuple[FloatArray, FloatArray]
"""Times [s], shape (n,), and rows, shape (n, n_observed)."""


class Followed:
    """Rows of accepted steps of one integration.

    Attributes
    ----------
    windows
        Begin and end of the stretches [s], shape (n + 1, 2), the last one at infinity.
    times, rows
        Where the walk over the steps leaves what it has taken since the last :meth:`collect`.
    """

    def __init__(self, following: Following | None, n_observed: int) -> None:
        self.following = following or Following(np.empty((0, 2)), 1, ())
        self.windows = np.append(self.following.windows, [[np.inf, np.inf]], axis=0)
        size = CHUNK if following else 1
        self.times, self.rows = np.empty(size), np.empty((size, n_observed))
        self._kept: dict[int, list[Rows]] = {}

    def collect(self, n: int) -> None:
        """Take over the first ``n`` rows."""
        window = np.searchsorted(self.windows[:, 1], self.times[:n])
        for k in np.unique(window).tolist():
            inside = window == k
            self._add(k, (self.times[:n][inside], self.rows[:n][inside]))

    def merged(self, times: FloatArray, rows: FloatArray) -> Rows:
        """Return other rows and those kept, in the order of time."""
        parts = [(times, rows), *(self._thinned(_joined(kept)) for kept in self._kept.values())]
        self._kept.clear()
        every = np.concatenate([part[0] for part in parts])
        order = np.argsort(every)
        return every[order], np.concatenate([part[1] for part in parts])[order]

    def _add(self, k: int, new: Rows) -> None:
        """Add rows to a stretch, thinned after a number of rows: what is kept hangs on no other visit."""
        full = _UNTHINNED * self.following.most
        kept = self._kept.setdefault(k, [])
        while new[0].size:
            room = full - sum(times.size for times, _ in kept)
            kept.append((new[0][:room], new[1][:room]))
            new = new[0][room:], new[1][room:]
            if sum(times.size for times, _ in kept) == full:
                kept[:] = [self._thinned(_joined(kept))]

    def _thinned(self, rows: Rows) -> Rows:
        """Return what is kept of the rows of a stretch."""
        kept = thinning(self._watched(rows[1]), self.following.most)
        return rows[0][kept], rows[1][kept]

    def _watched(self, rows: FloatArray) -> FloatArray:
        """Return what must keep its peaks, a column each: numbers as they are, vectors by their lengths."""
        columns = [
            rows[:, places[0]] if len(places) == 1 else np.linalg.norm(rows[:, places], axis=1)
            for places in self.following.watched
        ]
        return np.column_stack(columns)


def thinning(values: FloatArray, most: int) -> NDArray[np.intp]:
    """Return which of many rows to keep, at most ``most``: increasing indices, shape (m,).

    The rows are cut into pieces of equal number; of each the first is kept and, of every column, the smallest
    and the largest value. So all peaks stay, also if rows are thinned again.

    Parameters
    ----------
    values
        What must keep its peaks, shape (n, n_columns).
    most
        At least one row more than two for each column.
    """
    n, columns = values.shape
    if n <= most:
        return np.arange(n)
    edges = np.linspace(0, n, most // (2 * columns + 1) + 1).astype(np.intp)
    pieces = [
        begin + np.concatenate([[0], part.argmin(axis=0), part.argmax(axis=0)])
        for begin, end in pairwise(edges.tolist())
        for part in [values[begin:end]]
    ]
    return np.unique(np.concatenate(pieces))


def _joined(parts: Sequence[Rows]) -> Rows:
    times, rows = zip(*parts, strict=True)
    return np.concatenate(times), np.concatenate(rows)
