"""SHA-256 of what a run is computed from and of its rows: equal hashes mean equal numbers to the last bit."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.problem import Problem, Solution

_OF_PROCESS: Final = ("law", "exchanges")
"""Numbers of a process, not of a case: addresses of force laws, and the pivots of the last factorisation."""

_BLOCK: Final = 4_000_000
"""Size of what is copied at once [B]."""


def of_data(problem: Problem, *more: Any) -> str:
    """Return the hash of all that a run reads: constants, tables, start, times and tolerances.

    Parameters
    ----------
    problem
        Before it is integrated.
    more
        What the integrator is given besides: numbers, texts and arrays.
    """
    digest = hashlib.sha256()
    bounds = problem.t_span, problem.breakpoints, problem.longest_step
    _add(digest, "", (problem.data, problem.y0, problem.atol, *bounds, *more))
    return digest.hexdigest()


def of_rows(solution: Solution) -> str:
    """Return the hash of the rows at output times, and of the state at the end."""
    digest = hashlib.sha256()
    _add(digest, "", (solution.t, solution.rows, solution.t_end, solution.y_end))
    return digest.hexdigest()


def _add(digest: Any, name: str, value: Any) -> None:
    """Add a number, a text, an array, a record, or a tuple of such; functions add their place alone."""
    if (parts := _parts(value)) is not None:
        for part, inside in parts:
            if not (part in _OF_PROCESS and np.asarray(inside).dtype.kind == "i"):
                _add(digest, f"{name}.{part}", inside)
    elif isinstance(value, str):
        digest.update(f"{name} {value} ".encode())
    elif isinstance(value, np.ndarray | np.generic | float | int):
        array = np.asarray(value)
        digest.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        for block in _blocks(array):
            digest.update(block)
    else:
        digest.update(f"{name} ".encode())


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
