"""Type aliases shared by every layer: those of the solver."""

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix, IntArray, IntMatrix

__all__ = ["FloatArray", "FloatCube", "FloatMatrix", "IntArray", "IntMatrix"]
