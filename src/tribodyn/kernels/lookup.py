"""Contact pressure, its derivative and its stored energy from a :class:`ContactTable`.

Above the table everything is zero; below it the laws go on linearly with the value and slope of the first
node. A separation that is not a number gives results that are not numbers. There are no branches: loops over
nodes are to take four at once.
"""

from typing import Any

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.jit import entry, inlined


@inlined
def interval(position: float, last: float) -> tuple[float, float]:
    """Return the number of an interval and the distance from its lower node in steps.

    The position counts steps from one below the first node; ``last`` is the interval above the table.
    """
    inside = position if position > 0.0 else 0.0  # not max(): NaN must not become an index
    inside = inside if inside < last else last
    number = np.floor(inside)
    return number, position - number


@inlined
def offset(number: float) -> Any:
    """Return the begin of an interval's coefficients, unsigned: no index is taken from the end."""
    first: Any = np.uint64(8) * np.uint64(np.int32(number))
    return first


@inlined
def cubic(cubics: FloatArray, first: Any, x: float) -> float:
    """Return the polynomial with the four coefficients from ``first`` on at ``x``."""
    c_1, c_2, c_3 = cubics[first + np.uint64(1)], cubics[first + np.uint64(2)], cubics[first + np.uint64(3)]
    value: float = cubics[first] + x * (c_1 + x * (c_2 + x * c_3))
    return value


@inlined
def cubic_slope(cubics: FloatArray, first: Any, x: float) -> float:
    """Return the derivative of :func:`cubic` in ``x``."""
    c_1, c_2, c_3 = cubics[first + np.uint64(1)], cubics[first + np.uint64(2)], cubics[first + np.uint64(3)]
    slope: float = c_1 + x * (2.0 * c_2 + 3.0 * x * c_3)
    return slope


@inlined
def last_interval(table: ContactTable) -> float:
    """Return the number of the interval above the table."""
    return float(table.nodes.shape[0])


@entry
@inlined
def pressure_and_damping(table: ContactTable, h_star: float) -> tuple[float, float, float, float]:
    """Return P_k, dP_k/dh*, C and dC/dh* [Pa] at the separation ``h_star`` [1].

    The derivatives are those of the interpolant, exactly.
    """
    position = (h_star - table.h_first) * table.inverse_step + 1.0
    number, x = interval(position, last_interval(table))
    first = offset(number)
    damping = first + np.uint64(4)
    return (
        cubic(table.cubics, first, x),
        table.inverse_step * cubic_slope(table.cubics, first, x),
        cubic(table.cubics, damping, x),
        table.inverse_step * cubic_slope(table.cubics, damping, x),
    )


@entry
def stored_energy(table: ContactTable, h_star: float) -> float:
    """Return W_k = ∫_h*^∞ P_k dh* [Pa] at ``h_star`` [1]; times σ it is the stored energy per area [J/m²].

    The integral of the interpolant is taken exactly, so that dW_k/dh* is minus the pressure of
    :func:`pressure_and_damping` to rounding and an energy ledger sees no table error.
    """
    if h_star >= table.h_last:
        return 0.0
    nodes = table.nodes
    step = 1.0 / table.inverse_step
    x = (h_star - table.h_first) * table.inverse_step
    if not x >= 0.0:
        below: float = table.energy[0] - step * x * (nodes[0, 0] + 0.5 * x * nodes[0, 1])
        return below
    i = min(int(x), nodes.shape[0] - 2)
    x -= i
    rise = nodes[i + 1, 0] - nodes[i, 0]
    p_1 = nodes[i, 1]
    p_3 = p_1 + nodes[i + 1, 1] - 2.0 * rise
    p_2 = rise - p_1 - p_3
    mean = nodes[i, 0] + x * (p_1 / 2.0 + x * (p_2 / 3.0 + x * p_3 / 4.0))
    energy: float = table.energy[i] - step * x * mean
    return energy
