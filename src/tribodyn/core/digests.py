"""SHA-256 of numbers, texts, arrays and records: equal digests mean equal numbers to the last bit."""

import hashlib
from collections.abc import Iterable, Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

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
