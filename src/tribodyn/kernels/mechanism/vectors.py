"""Products of small matrices, and with the matrices [y]× of cross products."""

from mebdf.arrays import FloatArray
from tribodyn.kernels.jit import kernel


@kernel
def cross(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3,) with a × b; it may be neither."""
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]


@kernel
def crossed(
    a_x: float, a_y: float, a_z: float, b_x: float, b_y: float, b_z: float
) -> tuple[float, float, float]:
    """Return a × b, which needs no place in memory."""
    return a_y * b_z - a_z * b_y, a_z * b_x - a_x * b_z, a_x * b_y - a_y * b_x


@kernel
def turned(matrix: FloatArray, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return ``matrix`` (3, 3) times a vector, which needs no place in memory."""
    return (
        matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z,
        matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z,
        matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z,
    )


@kernel
def turn(matrix: FloatArray, vector: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3,) with ``matrix`` (3, 3) times ``vector``."""
    for i in range(3):
        out[i] = matrix[i, 0] * vector[0] + matrix[i, 1] * vector[1] + matrix[i, 2] * vector[2]


@kernel
def turn_back(matrix: FloatArray, vector: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3,) with the transpose of ``matrix`` (3, 3) times ``vector``."""
    for i in range(3):
        out[i] = matrix[0, i] * vector[0] + matrix[1, i] * vector[1] + matrix[2, i] * vector[2]


@kernel
def turn_axes(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3, 3) with the product of two matrices (3, 3)."""
    for i in range(3):
        for j in range(3):
            out[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


@kernel
def turn_axes_back(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (3, 3) with a matrix (3, 3) times the transpose of another."""
    for i in range(3):
        for j in range(3):
            out[i, j] = a[i, 0] * b[j, 0] + a[i, 1] * b[j, 1] + a[i, 2] * b[j, 2]


@kernel
def multiply(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` with the product of two matrices."""
    for i in range(a.shape[0]):
        for j in range(b.shape[1]):
            total = 0.0
            for k in range(a.shape[1]):
                total += a[i, k] * b[k, j]
            out[i, j] = total


@kernel
def multiply_transposed(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` with the transpose of ``a`` times ``b``."""
    for i in range(a.shape[1]):
        for j in range(b.shape[1]):
            total = 0.0
            for k in range(a.shape[0]):
                total += a[k, i] * b[k, j]
            out[i, j] = total


@kernel
def put(target: FloatArray, row: int, column: int, matrix: FloatArray, factor: float) -> None:
    """Add ``factor`` M at a block of ``target``; M is (3, 3)."""
    for i in range(3):
        for j in range(3):
            target[row + i, column + j] += factor * matrix[i, j]


@kernel
def put_cross(
    target: FloatArray, row: int, column: int, matrix: FloatArray, y: FloatArray, factor: float
) -> None:
    """Add ``factor`` M [y]× at a block of ``target``."""
    for i in range(3):
        a, b, c = factor * matrix[i, 0], factor * matrix[i, 1], factor * matrix[i, 2]
        target[row + i, column] += b * y[2] - c * y[1]
        target[row + i, column + 1] += c * y[0] - a * y[2]
        target[row + i, column + 2] += a * y[1] - b * y[0]


@kernel
def cross_put(
    target: FloatArray, row: int, column: int, y: FloatArray, matrix: FloatArray, factor: float
) -> None:
    """Add ``factor`` [y]× M at a block of ``target``."""
    for j in range(3):
        a, b, c = factor * matrix[0, j], factor * matrix[1, j], factor * matrix[2, j]
        target[row, column + j] += y[1] * c - y[2] * b
        target[row + 1, column + j] += y[2] * a - y[0] * c
        target[row + 2, column + j] += y[0] * b - y[1] * a


@kernel
def cross_rows(target: FloatArray, row: int, y: FloatArray, source: FloatArray, factor: float) -> None:
    """Add ``factor`` [y]× times three rows of ``source``, from ``row`` on, to those of ``target``."""
    for j in range(source.shape[1]):
        a, b, c = factor * source[row, j], factor * source[row + 1, j], factor * source[row + 2, j]
        target[row, j] += y[1] * c - y[2] * b
        target[row + 1, j] += y[2] * a - y[0] * c
        target[row + 2, j] += y[0] * b - y[1] * a
