"""Dense linear solve for the small systems of a mechanism."""

from tribodyn.core.arrays import FloatMatrix
from tribodyn.kernels.jit import entry


@entry
def solve_in_place(matrix: FloatMatrix, rhs: FloatMatrix, first: int, last: int) -> None:
    """Solve ``matrix x = rhs`` by Gaussian elimination with partial pivoting; the matrix is destroyed.

    Right-hand sides (n, m) from column ``first`` up to, not including, ``last`` become the solution.
    """
    n = matrix.shape[0]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if pivot != k:
            for j in range(k, n):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
            for j in range(first, last):
                rhs[k, j], rhs[pivot, j] = rhs[pivot, j], rhs[k, j]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] * inverse
            if factor != 0.0:
                for j in range(k + 1, n):
                    matrix[i, j] -= factor * matrix[k, j]
                for j in range(first, last):
                    rhs[i, j] -= factor * rhs[k, j]
    for k in range(n - 1, -1, -1):
        inverse = 1.0 / matrix[k, k]
        for j in range(first, last):
            total = rhs[k, j]
            for i in range(k + 1, n):
                total -= matrix[k, i] * rhs[i, j]
            rhs[k, j] = total * inverse
