"""Decompositions of matrices of a mechanism, which several searches ask for at the same place."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense

LARGE: Final = 60
"""Number of unknowns from which on a regular system is solved by elimination."""
_REGULAR: Final = 1.0e8
"""Largest |A| |x| / |b| of a solution of A x = b that elimination finds accurately."""
_KEPT: Final = 4
"""Decompositions that are kept: those of two matrices at this place and at the last one."""


def svd(matrix: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return what :func:`tribodyn.kernels.dense.svd` does, as arrays that cannot be written to."""
    return _svd(np.ascontiguousarray(matrix).tobytes(), matrix.shape)


@lru_cache(_KEPT)
def _svd(content: bytes, shape: tuple[int, int]) -> tuple[FloatArray, FloatArray, FloatArray]:
    found = dense.svd(np.frombuffer(content).reshape(shape))
    for array in found:
        array.flags.writeable = False
    return found


def shortest(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the shortest x (n,) with the least |matrix x − right|, for a square matrix.

    A large matrix that is regular is solved by elimination, in a fiftieth of the time for 160 unknowns.
    """
    if len(matrix) >= LARGE:
        with np.errstate(all="ignore"):
            found = dense.solve(matrix, right)
            amplified = float(np.max(np.abs(matrix))) * dense.norm(found) / dense.norm(right)
        if amplified < _REGULAR:
            return found
    return dense.lstsq(matrix, right)
