"""Four numbers at once, added up in an order that does not depend on the processor.

A compiler may process several entries at once in a loop that writes each result to a place of its own. It
must not reorder a sum. A sum over nodes is therefore written as four sums, one in each lane, which
:func:`total` adds at the end: processors with registers of two, four or eight numbers return the same bits.

In uncompiled code lanes are arrays of four numbers.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from mebdf.compiled.kernel import UNCOMPILED, Instruction

WIDTH: Final = 4
ROW: Final = 8  #: Numbers in a row of the array that ``rows`` reads.


def _either(name: str, uncompiled: Callable[..., Any]) -> Any:
    """Return a function that is an instruction in compiled code."""
    return uncompiled if UNCOMPILED else Instruction(uncompiled, "tribodyn.kernels.lane_instructions", name)


def _put(array: Any, place: int, lanes: Any) -> None:
    array.reshape(-1)[place : place + WIDTH] = lanes


def _named(places: Any, place: int) -> Any:
    return places[place : place + WIDTH].astype(int)


def _table_rows(array: Any, numbers: Any) -> Any:
    return tuple(array.reshape(-1, ROW)[numbers].T)


#: Return the four numbers of an array from ``place`` on.
load: Final = _either("load", lambda array, place: array.reshape(-1)[place : place + WIDTH].copy())
store: Final = _either("store", _put)  #: Write lanes into an array, from ``place`` on.
zeros: Final = _either("zeros", lambda: np.zeros(WIDTH))  #: Return four zeros, with which sums begin.
spread: Final = _either("spread", lambda number: np.full(WIDTH, number))  #: Return a number in all lanes.
square_root: Final = _either("square_root", np.sqrt)
absolute: Final = _either("absolute", np.abs)
floor: Final = _either("floor", np.floor)  #: Functions of each lane.
#: Return ``x`` in lanes in which ``a`` > ``b``, otherwise ``y``, also where one of them is not a number.
above: Final = _either("above", lambda a, b, x, y: np.where(a > b, x, y))
store_places: Final = _either("store_places", _put)
"""Write whole numbers in lanes, none of them negative, into an array from ``place`` on, for what follows.

Read from there they are at hand sooner than from lanes; the array says nothing else about them.
"""
#: Return the entries of an array that the numbers name that ``store_places`` wrote into ``places``.
entries_at: Final = _either("entries_at", lambda array, places, place: array[_named(places, place)])
#: Return the result of ``rows`` for such numbers.
rows_at: Final = _either("rows_at", lambda array, places, place: _table_rows(array, _named(places, place)))
parts: Final = _either("parts", tuple)  #: Return the four numbers.
#: Return the sum of the lanes.
total: Final = _either("total", lambda lanes: (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]))
#: Return the sums of the lanes of four.
totals: Final = _either("totals", lambda a, b, c, d: np.array([total(lanes) for lanes in (a, b, c, d)]))
#: Return eight lanes: the columns of those four rows of a table of eight columns that ``numbers`` name.
rows: Final = _either("rows", lambda array, numbers: _table_rows(array, numbers.astype(int)))
