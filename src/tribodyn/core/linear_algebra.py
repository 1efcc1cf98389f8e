"""Threads of the linear algebra that NumPy and SciPy call."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def one_thread() -> Iterator[None]:
    """Have matrices factorised by one thread within the block.

    Matrices of mechanisms are small. Several threads gain nothing there; beside other work they wait for each
    other and take many times as long, and how many there are decides the last digits of sums.
    """
    with threadpool_limits(1, user_api="blas"):
        yield
