"""Decorators of kernels. Those of the solver are compiled into some of them: an edit there renews all."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from mebdf.compiled.cache import Sources
from mebdf.compiled.jit import decorators
from mebdf.kernels.jit import SOURCES as SOLVER

SOURCES: Final = Sources(
    Path(__file__).parents[1],
    ("kernels/**/*.py", "core/arrays.py", "core/quantities.py", "core/tables.py"),
    below=(SOLVER,),
)
"""Sources of the machine code: kernels, their imports from outside their package, and the solver."""

entry, kernel, unlocked, inlined = decorators(SOURCES)
