"""What is optimised and becomes machine code, under which names, and what is kept of it."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numba as nb
import pytest
from numba.core.registry import cpu_target

from mebdf.compiled import cache, lean
from mebdf.compiled.jit import decorators
from mebdf.compiled.private_folder import private_folder
from mebdf.kernels.jit import SOURCES


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for compiled code, for this test alone."""
    folder = private_folder(tmp_path / cache.fingerprint(SOURCES))
    monkeypatch.setattr(cache, "folder", lambda sources: folder)
    return folder


def three_levels() -> tuple[Any, Any, Any]:
    """Return new kernels of which each calls the one before, the last one callable from Python."""
    entry, kernel, *_ = decorators(SOURCES)

    @kernel
    def square(number: float) -> float:
        return number * number

    @kernel
    def sum_of_squares(first: float, second: float) -> float:
        result: float = square(first) + square(second)
        return result

    @entry
    def root(first: float, second: float) -> float:
        result: float = sum_of_squares(first, second) ** 0.5
        return result

    return square, sum_of_squares, root


def library(function: Any) -> Any:
    (compiled,) = function.overloads.values()
    return compiled.library


def test_only_what_python_calls_becomes_machine_code(place: Path) -> None:
    *inner, root = three_levels()
    assert root(3.0, 4.0) == 5.0
    assert [library(each)._finalized for each in (*inner, root)] == [False, False, True]


def test_functions_that_call_each_other_find_each_other() -> None:
    lean.use(cpu_target.target_context)

    njit: Any = nb.njit

    @njit
    def is_even(number: int) -> bool:
        return True if number == 0 else is_odd(number - 1)

    @njit
    def is_odd(number: int) -> bool:
        return False if number == 0 else is_even(number - 1)

    @njit
    def both(number: int) -> tuple[bool, bool]:
        return is_even(number), is_odd(number)

    assert both(7) == (False, True)
    assert is_odd(9)


def test_names_of_functions_of_many_types_are_short_and_differ() -> None:
    names = [lean._mangled("package.name", (nb.float64,) * n, uid=1) for n in (300, 301)]
    assert len({*names}) == 2
    assert all(each.startswith("_ZN7package4name") and len(each) < 300 for each in names)


def test_names_differ_from_those_of_another_process(monkeypatch: pytest.MonkeyPatch) -> None:
    ours = lean._mangled("package.name", (nb.float64,), uid=1)
    assert ours == lean._mangled("package.name", (nb.float64,), uid=1)
    monkeypatch.setattr(lean, "_TOKEN", "another")
    assert ours != lean._mangled("package.name", (nb.float64,), uid=1)


def test_another_version_of_numba_compiles_in_its_own_way(place: Path) -> None:
    use = """
from mebdf.compiled import lean
lean._TESTED = False
from mebdf.kernels.elementary import portable
print(portable.sin(0.5))
from numba.core.registry import cpu_target
assert not isinstance(cpu_target.target_context.codegen(), lean.LeanCode)
"""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(place)}
    for _ in range(2):  # compiled, and then loaded
        done = subprocess.run(
            [sys.executable, "-c", use], capture_output=True, text=True, check=True, env=environment
        )
        assert float(done.stdout.split()[0]) == math.sin(0.5)
