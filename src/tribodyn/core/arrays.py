"""Type aliases shared by every layer: those of the solver."""

from mebdf.arrays import FloatArray, IntArray

__all__ = ["FloatArray", "IntArray"]
