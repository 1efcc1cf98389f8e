"""The index of each variable, from the matrices of the linearised equations, compared with the one given.

A perturbation of M y' = f(t, y) with a high frequency s changes variable i by up to s^(index − 1): by row i
of (s M − J)⁻¹. At one state entries of J may be zero that are not zero beside it (a pendulum that passes its
lowest point), so random matrices of the same pattern are tried, too.
Source: K. E. Brenan, S. L. Campbell, L. R. Petzold, Numerical Solution of Initial-Value Problems in
Differential-Algebraic Equations, SIAM 1996, 2.3 (matrix pencils).
"""

import warnings
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

from mebdf.algebra import is_sparse
from mebdf.arrays import FloatArray
from mebdf.mass import LARGEST

#: Frequencies of the perturbations, relative to the fastest rate.
FREQUENCIES: Final = 10.0 ** np.arange(4.0, 9.0)
WHOLE: Final = 0.1  #: Difference from a whole number up to which an exponent is that number.
#: Change of the state that shows which entries of J are zero by chance, relative to the values.
MOVE: Final = 1.0e-4
#: Entries, relative to the largest of their rows, that may be rounding: none, or small ones.
ABSENT: Final = (0.0, 1.0e-9)
SIDES: Final = 3  #: Number of random perturbations of the equations.

Indices = NDArray[np.int64]


def check_index(
    jacobian: Callable[[float, FloatArray], Any],
    t: float,
    y: FloatArray,
    mass: Any,
    given: Indices,
    typical: FloatArray,
    names: Sequence[str],
) -> Indices:
    """Return the index of each variable: refuse one that is too high; raise one that is too low, and warn.

    Parameters
    ----------
    jacobian
        Jacobian of the right-hand side, shape (n, n), dense or sparse.
    t, y
        Start, and consistent values, shape (n,).
    mass
        Mass matrix, sparse, shape (n, n).
    given
        Index of each variable, shape (n,).
    typical
        Size of each variable, shape (n,).
    names
        Names of the variables.

    Raises
    ------
    ValueError
        If errors of a variable would be weighed by a power of the step that its index does not justify.
    """
    if given.max(initial=1) == 1:
        return given
    least, most = _bounds(jacobian, t, y, mass, typical)
    for wrong, what in ((given > most, "too high"), (given < least, "too low")):
        if not np.any(wrong):
            continue
        i = int(np.argmax(wrong))
        right = np.minimum(most, given.max())
        listed = f"`index={right.tolist()}`" if right.size <= 30 else f"{right[i]} for it"
        text = (
            f"`index` is {what} for {names[i]}: {given[i]}, where the equations at t = {t:g} have "
            f"{right[i]}; give {listed}."
        )
        if what == "too high":
            raise ValueError(text)
        warnings.warn(f"{text} The integration takes this index.", stacklevel=6)
        return np.asarray(np.maximum(given, right))
    return given


def _bounds(
    jacobian: Callable[[float, FloatArray], Any], t: float, y: FloatArray, mass: Any, typical: FloatArray
) -> tuple[Indices, Indices]:
    """Return the least and the largest index that each variable may have, shape (n,) each."""
    rng = np.random.default_rng(0)
    here = jacobian(t, y)
    size = np.abs(y) + typical
    beside = jacobian(t, y + MOVE * rng.uniform(0.5, 1.0, y.size) * rng.choice([-1.0, 1.0], y.size) * size)
    if not np.isfinite(beside.data if is_sparse(beside) else beside).all():
        beside = here
    rows = _row_norms(mass)
    scale = diags_array(1.0 / np.where(rows > 0.0, rows, 1.0))
    mass = scale @ mass
    found = _index(scale @ here, mass, rng)
    patterns = [_significant(here, size, least) + _significant(beside, size, least) for least in ABSENT]
    same = [_index(_random(pattern, rng), mass, rng) for pattern in patterns]
    highest = np.maximum(*(np.where(one > 0, one, 3) for one in same))
    most = np.maximum(highest, np.where(found > 0, found, 1))
    return np.where(found > 0, np.minimum(found, most), 1), most


def _index(jacobian: Any, mass: Any, rng: np.random.Generator) -> Indices:
    """Return the index of each variable, 0 where it is not certain."""
    n = mass.shape[0]
    rows = np.maximum(_row_norms(jacobian), np.finfo(np.float64).tiny)
    sides = rows[:, None] * rng.uniform(0.5, 1.0, (n, SIDES)) * rng.choice([-1.0, 1.0], (n, SIDES))
    fastest = float(np.max(np.where(_row_norms(mass) > 0.0, rows, 0.0), initial=0.0)) or 1.0
    sizes = []
    for frequency in fastest * FREQUENCIES:
        answer = _solution(frequency * mass - jacobian, sides)
        if answer is None:
            return np.zeros(n, dtype=np.int64)
        sizes.append(np.max(np.abs(answer), axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        exponents = np.diff(np.log10(sizes), axis=0)
    middle = np.median(exponents, axis=0)
    whole = np.abs(exponents - np.rint(middle)) <= WHOLE
    certain = np.all(np.isfinite(exponents), axis=0) & (np.count_nonzero(whole, axis=0) >= 2)
    return np.where(certain, np.maximum(np.rint(np.where(certain, middle, 0.0)), 0.0) + 1.0, 0.0).astype(int)


def _solution(matrix: Any, sides: FloatArray) -> FloatArray | None:
    """Return the solutions of a system, ``None`` if it is singular."""
    scale = 1.0 / np.maximum(_row_norms(matrix), np.finfo(np.float64).tiny)
    try:
        if is_sparse(matrix) and matrix.shape[0] > LARGEST:
            found = splu(csc_array(diags_array(scale) @ matrix)).solve(scale[:, None] * sides)
        else:
            dense = matrix.toarray() if is_sparse(matrix) else np.asarray(matrix)
            with np.errstate(all="ignore"):
                found = np.linalg.solve(scale[:, None] * dense, scale[:, None] * sides)
    except (RuntimeError, np.linalg.LinAlgError):
        return None
    return found if np.isfinite(found).all() else None


def _row_norms(matrix: Any) -> FloatArray:
    largest = abs(matrix).max(axis=1)
    return np.asarray(largest.toarray() if is_sparse(largest) else largest).ravel()


def _significant(jacobian: Any, size: FloatArray, share: float) -> Any:
    """Return the entries of a Jacobian above rounding."""
    weighted = csc_array(csc_array(abs(jacobian)) @ diags_array(size))
    least = share * _row_norms(weighted)
    weighted.data = (weighted.data > least[weighted.indices]).astype(np.float64)
    weighted.eliminate_zeros()
    return weighted


def _random(pattern: Any, rng: np.random.Generator) -> Any:
    """Return a matrix with random entries where ``pattern`` has any."""
    matrix = csc_array(pattern, copy=True)
    matrix.data = rng.uniform(0.5, 1.5, matrix.data.size) * rng.choice([-1.0, 1.0], matrix.data.size)
    return matrix
