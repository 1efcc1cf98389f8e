"""Kernels are compiled for kernels; Python calls a copy with a wrapper."""

from __future__ import annotations

from mebdf.kernels.jit import kernel


@kernel
def doubled(number: float) -> float:
    return 2.0 * number


def test_python_calls_a_copy_that_is_compiled_once_for_each_type() -> None:
    assert [doubled(3.0), doubled(4.0), doubled(3)] == [6.0, 8.0, 6.0]
    assert len(doubled.for_python().overloads) == 2
    assert not doubled.overloads
