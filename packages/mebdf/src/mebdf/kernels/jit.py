"""Decorators of the kernels of the solver."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from mebdf.compiled.cache import Sources
from mebdf.compiled.jit import decorators

SOURCES: Final = Sources(Path(__file__).parents[1], ("kernels/**/*.py", "compiled/*.py", "arrays.py"))
"""Sources of the solver's machine code."""

entry, kernel, unlocked, inlined = decorators(SOURCES)
