"""Decorators of the kernels of the solver, and copying of arrays."""

from pathlib import Path
from typing import Final

from mebdf.arrays import FloatArray
from mebdf.compiled.kernel import decorators
from mebdf.compiled.library import Sources

#: Sources of the solver's machine code.
SOURCES: Final = Sources(
    Path(__file__).parents[1],
    ("kernels/**/*.py", "compiled/*.py", "compiled/*.ll", "arrays.py"),
    listing=("mebdf.kernels",),
)

entry, kernel, inlined = decorators(SOURCES)


@entry
def copy(source: FloatArray, target: FloatArray) -> None:
    """Copy ``source`` into the beginning of ``target``; both one-dimensional."""
    for i in range(source.size):
        target[i] = source[i]
