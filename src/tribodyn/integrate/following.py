"""Times of an integration (starts, restarts, outputs, pictures), and rows collected at accepted steps."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import Following

ROUNDING = 64.0 * np.finfo(np.float64).eps  #: Times closer than this share of the largest time are the same.


@dataclass(frozen=True)
class Schedule:
    """Marks of an integration in time, all increasing."""

    edges: FloatArray  #: Start time, breakpoints and end time [s], shape (n_segments + 1,).
    #: Times of outputs and pictures [s], shape (n_marks,); a mark that is meant to be an edge equals it
    #: exactly.
    marks: FloatArray
    #: What is taken at each mark, shape (n_marks,); a mark may be both.
    is_output: NDArray[np.bool_]
    is_picture: NDArray[np.bool_]
    #: The times as asked for [s].
    output_times: FloatArray
    picture_times: FloatArray
    tolerance: float  #: Times closer than this are the same [s].


def make_schedule(
    t_span: tuple[float, float],
    breakpoints: Sequence[float],
    output_times: ArrayLike,
    picture_times: ArrayLike,
) -> Schedule:
    """Check the times of an integration and put them on common marks.

    ``t_span``: start and end time [s]; ``breakpoints``: restarts strictly inside ``t_span`` [s]; those on its
    ends are dropped; ``output_times``, ``picture_times``: times inside ``t_span`` [s], ends included,
    increasing.
    """
    t_start, t_end = t_span
    if not (np.isfinite(t_start) and np.isfinite(t_end) and t_start < t_end):
        raise InputError(f"the time span must be finite and increasing, not {t_start} s to {t_end} s")
    tolerance = float(ROUNDING * max(abs(t_start), abs(t_end)))
    inner = _checked("breakpoints", breakpoints, t_span, tolerance)
    inner = inner[(inner > t_start + tolerance) & (inner < t_end - tolerance)]
    edges = np.concatenate(([t_start], inner, [t_end]))
    outputs = _checked("output times", output_times, t_span, tolerance)
    pictures = _checked("picture times", picture_times, t_span, tolerance)
    at_output = _snapped(outputs, edges, tolerance)
    at_picture = _snapped(_snapped(pictures, at_output, tolerance), edges, tolerance)
    marks = np.union1d(at_output, at_picture)
    return Schedule(
        edges=edges,
        marks=marks,
        is_output=np.isin(marks, at_output),
        is_picture=np.isin(marks, at_picture),
        output_times=outputs,
        picture_times=pictures,
        tolerance=tolerance,
    )


def _checked(what: str, times: ArrayLike, t_span: tuple[float, float], tolerance: float) -> FloatArray:
    """Return ``times`` as an array of its own; refuse times that repeat, run back or lie outside."""
    array = np.array(times, dtype=np.float64).reshape(-1)
    if not np.all(np.isfinite(array)):
        raise InputError(f"{what} must be finite")
    if np.any(np.diff(array) <= tolerance):
        raise InputError(f"{what} must increase, each by more than {tolerance:.2g} s")
    if array.size and (array[0] < t_span[0] - tolerance or array[-1] > t_span[1] + tolerance):
        raise InputError(
            f"{what} must lie between {t_span[0]:g} s and {t_span[1]:g} s; "
            f"they run from {array[0]:g} s to {array[-1]:g} s"
        )
    return array


def _snapped(times: FloatArray, targets: FloatArray, tolerance: float) -> FloatArray:
    """Move each time to the nearest of the increasing ``targets`` if that is the same time."""
    if targets.size == 0:
        return times
    above = np.searchsorted(targets, times).clip(0, targets.size - 1)
    below = (above - 1).clip(0)
    nearest = np.where(
        np.abs(targets[above] - times) < np.abs(times - targets[below]), targets[above], targets[below]
    )
    snapped: FloatArray = np.where(np.abs(nearest - times) <= tolerance, nearest, times)
    return snapped


CHUNK: Final = 512  #: Rows collected between two visits, at most,
CHUNK_ROOM: Final = 2_000_000  #: and their size [B]: what stays in a cache is read from there.
#: A stretch is thinned on the way when it holds this many times the rows that it may keep.
_UNTHINNED: Final = 4
#: Size of its rows from which it is thinned at twice these rows already [B]; half of it is kept at most.
ROOM: Final = 64_000_000

_MOVED: Final = 64  #: Rows moved at once, at most: where they overlap, NumPy copies them first.
#: Least size of a block of rows [B]: NumPy asks for large pages from 4 MB on; each costs when first used.
BLOCK: Final = 8_000_000

Rows = tuple[FloatArray, FloatArray]  #: Times [s], shape (n,), and rows, shape (n, n_observed).


def most_rows(most: int, n_kept: int, n_watched: int) -> int:
    """Return the rows of ``n_kept`` numbers that a stretch keeps of ``most``, with ``n_watched`` peaks."""
    return max(min(most, ROOM // (8 * max(n_kept, 1)) // 2), 2 * n_watched + 1)


class Followed:
    """Rows of accepted steps of one integration.

    ``following``: which steps give rows; None for no step; ``n_observed``: numbers of a row; ``kept``: places
    in a row of the numbers that are kept, rising; None for all.

    Attributes
    ----------
    windows
        Begin and end of the stretches [s], shape (n + 1, 2), the last one at infinity.
    times, rows
        Where the walk over the steps leaves what it has taken since the last :meth:`collect`.
    """

    def __init__(
        self, following: Following | None, n_observed: int, kept: NDArray[np.intp] | None = None
    ) -> None:
        self.following = following or Following(np.empty((0, 2)), 1, ())
        self.windows = np.append(self.following.windows, [[np.inf, np.inf]], axis=0)
        size = max(min(CHUNK, CHUNK_ROOM // (8 * max(n_observed, 1))), 1) if following else 1
        self.times, self.rows = np.empty(size), np.empty((size, n_observed))
        places = np.arange(n_observed) if kept is None else kept
        self._kept, self._n_kept = kept, places.size
        most, watched = self.following.most, self.following.watched
        self._most = most_rows(most, self._n_kept, len(watched))
        self._full = min(max(ROOM // (8 * max(self._n_kept, 1)), 2 * self._most), _UNTHINNED * most)
        self._watched = [np.searchsorted(places, one) for one in watched]
        self._stretches: dict[int, _Stretch] = {}
        self._spare: list[FloatArray] = []

    def collect(self, n: int) -> None:
        """Take over the first ``n`` rows."""
        window = np.searchsorted(self.windows[:, 1], self.times[:n])
        for k in np.unique(window).tolist():
            first, last = np.searchsorted(window, [k, k + 1])
            stretch = self._stretches.setdefault(k, _Stretch(self._n_kept, self._spare))
            self._add(stretch, int(first), int(last))

    def _add(self, stretch: "_Stretch", first: int, last: int) -> None:
        """Add rows to a stretch, thinned after a number of rows: what is kept hangs on no other visit."""
        while first < last:
            end = min(last, first + self._full - stretch.n)
            stretch.add(self.times[first:end], self.rows[first:end], self._kept)
            if stretch.n == self._full:
                stretch.keep(self._chosen(stretch))
            first = end

    def merged(self, times: FloatArray, rows: FloatArray) -> Rows:
        """Return other rows and those kept, in the order of time; both are given away.

        ``times``: of the other rows, shape (n,); ``rows``: begin with them and own their memory, shape (n or
        more, n_kept); those kept are added in place.
        """
        stretches = list(self._stretches.values())
        self._stretches.clear()
        for stretch in stretches:
            stretch.keep(self._chosen(stretch))
        self._spare.clear()
        every = np.concatenate([times, *(stretch.times for stretch in stretches)])
        order = np.argsort(every, kind="stable")
        place = np.empty_like(order)
        place[order] = np.arange(order.size)
        rows.resize((every.size, rows.shape[1]), refcheck=False)
        _spread(rows, place[: times.size])
        first = times.size
        while stretches:
            for block in stretches.pop(0).blocks():
                rows[place[first : first + len(block)]] = block
                first += len(block)
        return every[order], rows

    def _chosen(self, stretch: "_Stretch") -> NDArray[np.intp]:
        """Return the rows of a stretch that are kept."""
        if stretch.n <= self._most:
            return np.arange(stretch.n)
        return thinning(np.concatenate([*map(self._sizes, stretch.blocks())]), self._most)

    def _sizes(self, rows: FloatArray) -> FloatArray:
        """Return the quantities whose peaks are kept, a column each: numbers, and vectors by lengths."""
        columns = [
            rows[:, places[0]] if len(places) == 1 else np.linalg.norm(rows[:, places], axis=1)
            for places in self._watched
        ]
        return np.column_stack(columns)


class _Stretch:
    """Rows of a stretch in blocks, so that more of them need no other place.

    Blocks given up stay in ``spare``: memory that is new takes longer to come by than to fill.
    """

    def __init__(self, n_kept: int, spare: list[FloatArray]) -> None:
        self.n, self.times, self._spare = 0, np.empty(0), spare
        self._blocks: list[FloatArray] = []
        self._size = max(CHUNK, BLOCK // (8 * max(n_kept, 1)))
        self._shape = self._size, n_kept

    def add(self, times: FloatArray, rows: FloatArray, places: NDArray[np.intp] | None) -> None:
        """Add some places of rows, None for all, with their times."""
        self.times = np.append(self.times, times)
        first = 0
        while first < len(rows):
            used = self.n % self._size
            if used == 0:
                self._blocks.append(self._spare.pop() if self._spare else np.empty(self._shape))
            part = rows[first : first + self._size - used]
            take_places(part, places, self._blocks[-1][used : used + len(part)])
            self.n += len(part)
            first += len(part)

    def blocks(self) -> list[FloatArray]:
        """Return the rows, block by block."""
        return [block[: self.n - k * self._size] for k, block in enumerate(self._blocks)]

    def keep(self, chosen: NDArray[np.intp]) -> None:
        """Give up all rows but some, whose numbers rise."""
        for new, old in enumerate(chosen.tolist()):
            if new != old:
                row = self._blocks[old // self._size][old % self._size]
                self._blocks[new // self._size][new % self._size] = row
        self.n, self.times = chosen.size, self.times[chosen]
        used = -(-self.n // self._size)
        self._spare += self._blocks[used:]
        del self._blocks[used:]


def take_places(rows: FloatArray, places: NDArray[np.intp] | None, out: FloatArray) -> None:
    """Copy some places of rows (n, n_observed), None for all, to ``out`` (n, n_kept)."""
    if places is None:
        out[:] = rows
    else:
        np.take(rows, places, axis=1, out=out, mode="clip")  # another mode would fill a copy first


def _spread(rows: FloatArray, places: NDArray[np.intp]) -> None:
    """Move the first rows of an array to places further down that rise, in place."""
    moves, end = places - np.arange(places.size), places.size
    while end > 0 and moves[end - 1] > 0:
        move = int(moves[end - 1])
        begin = max(int(np.searchsorted(moves, move)), end - _MOVED)
        rows[begin + move : end + move] = rows[begin:end]
        end = begin


def thinning(values: FloatArray, most: int) -> NDArray[np.intp]:
    """Return the indices of the rows to keep, at most ``most``: increasing, shape (m,).

    The rows are cut into pieces of equal number; of each the first is kept and, of every column, the smallest
    and the largest value. So all peaks stay, also if rows are thinned again.

    ``values``: what must keep its peaks, shape (n, n_columns); ``most``: at least one row more than two for
    each column.
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
