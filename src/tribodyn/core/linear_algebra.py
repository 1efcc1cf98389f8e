"""Threads of the linear algebra that NumPy and SciPy call."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache

from threadpoolctl import ThreadpoolController


@contextmanager
def one_thread() -> Iterator[None]:
    """Have matrices factorised by one thread within the block.

    Matrices of mechanisms are small. Several threads gain nothing there; beside other work they wait for each
    other and take many times as long, and how many there are decides the last digits of sums.
    """
    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(_modules: int) -> ThreadpoolController:
    """Return the libraries of this process. The search takes milliseconds; only imports add libraries."""
    return ThreadpoolController()
