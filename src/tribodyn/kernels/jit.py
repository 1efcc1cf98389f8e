"""Decorators of kernels, records, clearing of arrays, and the larger of two numbers.

Python's ``max`` and ``min`` choose one of two; to the compiler, a running maximum made of such choices is no
sum that it may split. The processor's own maximum is. NaN stays NaN.
"""

from pathlib import Path
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.compiled.kernel import UNCOMPILED, Instruction, decorators
from mebdf.compiled.library import Sources, library
from mebdf.kernels.jit import SOURCES as SOLVER

#: Sources of the machine code: kernels, their imports from outside their package, and the solver.
SOURCES: Final = Sources(
    Path(__file__).parents[1],
    ("kernels/**/*.py", "core/quantities.py", "core/remembered.py"),
    listing=("tribodyn.kernels", "tribodyn.mechanism.elements"),
    below=(SOLVER,),
)

entry, kernel, inlined = decorators(SOURCES)


def made_by() -> str:
    """Return the name of the machine code that results carry."""
    if UNCOMPILED:
        return "none: Python"
    found = library(SOURCES)
    return "compiled by this process" if found is None else found.name


def new_record(fields: np.dtype[np.void]) -> Any:
    """Return a cleared record whose fields are attributes.

    A compiled function takes one address instead of every number and seven for every array.
    """
    return np.zeros(1, dtype=fields)[0]


def new_records(n: int, fields: np.dtype[np.void]) -> Any:
    """Return cleared records, shape (n,), whose fields are attributes."""
    return np.zeros(n, dtype=fields).view(np.recarray)


@kernel
def clear(target: FloatArray) -> None:
    """Set all entries of a two-dimensional array to zero."""
    for i in range(target.shape[0]):
        for j in range(target.shape[1]):
            target[i, j] = 0.0


@kernel
def is_zero(matrix: FloatArray, row: int) -> bool:
    """Tell whether a row of a matrix is zero."""
    j = 0
    while j < matrix.shape[1] and matrix[row, j] == 0.0:
        j += 1
    return j == matrix.shape[1]


_MODULE: Final = "tribodyn.kernels.instructions"
larger: Final[Any] = max if UNCOMPILED else Instruction(max, _MODULE, "larger")
smaller: Final[Any] = min if UNCOMPILED else Instruction(min, _MODULE, "smaller")
