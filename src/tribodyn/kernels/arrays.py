"""Copying and filling of vectors: loops compile an order of magnitude faster than slice assignments."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel


@kernel
def copy(source: FloatArray, target: FloatArray) -> None:
    """Copy ``source`` into the beginning of ``target``; both one-dimensional."""
    for i in range(source.size):
        target[i] = source[i]


@kernel
def clear(target: FloatArray) -> None:
    """Set all entries of a two-dimensional array to zero."""
    for i in range(target.shape[0]):
        for j in range(target.shape[1]):
            target[i, j] = 0.0
