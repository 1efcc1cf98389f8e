"""Factors of rough surfaces and the mean gap, from their tables."""

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.film.data import FlowTable
from tribodyn.kernels.jit import inlined, kernel

LEAST_SEPARATION = 0.5
"""Flow factors and h³ see max(h, σ/2): contact reaches below h = 0."""


@inlined
def cubic(c: FloatArray, x: float) -> float:
    """Return c_0 + c_1 x + c_2 x² + c_3 x³."""
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]))


@inlined
def cubic_slope(c: FloatArray, x: float) -> float:
    """Return the derivative of :func:`cubic`."""
    return c[1] + x * (2.0 * c[2] + 3.0 * x * c[3])


@kernel
def place(table: FlowTable, roughness: float, gap: float) -> tuple[int, float, float]:
    """Return the interval of the factors, the place in it and the derivative of place by gap [1/m].

    ``gap`` [m] is already bounded below; the derivative is that above the bound.
    """
    inverse = roughness / gap
    x = inverse * table.inverse_step
    k = min(int(x), table.factors.shape[0] - 1)
    return k, x - k, -x / gap


@kernel
def mean_gap(table: FlowTable, roughness: float, gap: float) -> tuple[float, float, float]:
    """Return the mean gap h_T [m], φ_c = ∂h_T/∂h and ∂φ_c/∂h [1/m] (Wu and Zheng).

    φ_c keeps its value at h = 0 below, and is 1 above the table.
    """
    if roughness == 0.0:
        return gap, 1.0, 0.0
    x = gap / (roughness * table.gap_step)
    n = table.mean_gap.shape[0]
    if x >= n:
        return gap, 1.0, 0.0
    scale = 1.0 / table.gap_step
    if x < 0.0:
        c = table.mean_gap[0]
        return roughness * (c[0] + c[1] * x), c[1] * scale, 0.0
    k = min(int(x), n - 1)
    c = table.mean_gap[k]
    x -= k
    slope = cubic_slope(c, x) * scale
    bend = (2.0 * c[2] + 6.0 * x * c[3]) * scale * scale / roughness
    return roughness * cubic(c, x), slope, bend
