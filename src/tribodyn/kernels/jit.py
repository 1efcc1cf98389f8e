"""Decorators of kernels. Those of the solver are compiled into some of them: an edit there renews all."""

from pathlib import Path
from typing import Final

from mebdf.compiled.kernel import UNCOMPILED, decorators
from mebdf.compiled.library import Sources, library
from mebdf.kernels.jit import SOURCES as SOLVER

#: Sources of the machine code: kernels, their imports from outside their package, and the solver.
SOURCES: Final = Sources(
    Path(__file__).parents[1],
    ("kernels/**/*.py", "core/arrays.py", "core/quantities.py", "core/remembered.py"),
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
