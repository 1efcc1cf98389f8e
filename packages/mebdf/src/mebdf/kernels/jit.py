"""Decorators of the kernels of the solver."""

from pathlib import Path
from typing import Final

from mebdf.compiled.kernel import decorators
from mebdf.compiled.library import Sources

#: Sources of the solver's machine code.
SOURCES: Final = Sources(
    Path(__file__).parents[1], ("kernels/**/*.py", "compiled/*.py", "arrays.py"), listing=("mebdf.kernels",)
)

entry, kernel, inlined = decorators(SOURCES)
