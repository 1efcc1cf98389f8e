"""Times of starts, restarts, outputs and pictures of an integration.

Times that come from different arithmetic may differ in their last digits although they
are meant to be the same: an output at ``3 * 0.1`` and a breakpoint at ``0.3``. All of
them are put on common marks here, once, so that no driver meets two marks a rounding
error apart or takes a step of that length.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError

ROUNDING = 64.0 * np.finfo(np.float64).eps
"""Times closer than this share of the largest time are the same."""


@dataclass(frozen=True)
class Schedule:
    """Marks of an integration in time, all increasing.

    Attributes
    ----------
    edges
        Start time, breakpoints and end time [s], shape (n_segments + 1,).
    marks
        Times of outputs and pictures [s], shape (n_marks,); a mark that is meant to be an
        edge equals it exactly.
    is_output, is_picture
        What is taken at each mark, shape (n_marks,); a mark may be both.
    output_times, picture_times
        The times as asked for [s].
    tolerance
        Times closer than this are the same [s].
    """

    edges: FloatArray
    marks: FloatArray
    is_output: NDArray[np.bool_]
    is_picture: NDArray[np.bool_]
    output_times: FloatArray
    picture_times: FloatArray
    tolerance: float


def make_schedule(
    t_span: tuple[float, float],
    breakpoints: Sequence[float],
    output_times: ArrayLike,
    picture_times: ArrayLike,
) -> Schedule:
    """Check the times of an integration and put them on common marks.

    Parameters
    ----------
    t_span
        Start and end time [s].
    breakpoints
        Restarts strictly inside ``t_span`` [s]; those on its ends are dropped.
    output_times, picture_times
        Times inside ``t_span`` [s], ends included, increasing.
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
