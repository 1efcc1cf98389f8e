"""Sums of weights over the nodes of rings, as the derivatives of their wrench calculate with them.

A weight w has Σ w (1, c, s, c², c s), c = cos θ and s = sin θ, and with a second-order term of the tilt also
Σ w (c³, c² s, c⁴, c³ s). The sums of w c, w s, and w (x c + y s) are made from these with s² = 1 − c².
"""

from typing import Any

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import inlined
from tribodyn.kernels.joints.surface.ring_slopes import SQUARED
from tribodyn.kernels.lanes import WIDTH, load

Three = tuple[Any, Any, Any]
Five = tuple[Any, Any, Any, Any, Any]
Seven = tuple[Any, Any, Any, Any, Any, Any, Any]
#: Sums of a weight times 1, c, s; c², c s; c³, c² s; c⁴, c³ s.
Nine = tuple[Any, Any, Any, Any, Any, Any, Any, Any, Any]


@inlined
def five_at(sums: FloatArray, at: int) -> Five:
    """Return the five sums of a weight that begin at a place."""
    return (
        load(sums, at),
        load(sums, at + WIDTH),
        load(sums, at + 2 * WIDTH),
        load(sums, at + 3 * WIDTH),
        load(sums, at + 4 * WIDTH),
    )


@inlined
def nine_at(sums: FloatArray, at: int) -> Nine:
    """Return the sums of a weight that has those times c², too."""
    return (*five_at(sums, at), *five_at(sums, at + SQUARED)[1:])


@inlined
def leaning(q: Seven, slope: tuple[Any, Any]) -> Five:
    """Return the sums of a weight times x c + y s."""
    x, y = slope
    return (
        x * q[1] + y * q[2],
        x * q[3] + y * q[4],
        x * q[4] + y * (q[0] - q[3]),
        x * q[5] + y * q[6],
        x * q[6] + y * (q[1] - q[5]),
    )


@inlined
def leaning_more(q: Nine, slope: tuple[Any, Any]) -> Seven:
    """Return the same with two more sums."""
    x, y = slope
    return (*leaning(q[:7], slope), x * q[7] + y * q[8], x * q[8] + y * (q[3] - q[7]))


@inlined
def times(a: Any, p: Five) -> Five:
    """Return a p."""
    return a * p[0], a * p[1], a * p[2], a * p[3], a * p[4]


@inlined
def plus(a: Any, p: Five, b: Any, q: Five) -> Five:
    """Return a p + b q."""
    return (
        a * p[0] + b * q[0],
        a * p[1] + b * q[1],
        a * p[2] + b * q[2],
        a * p[3] + b * q[3],
        a * p[4] + b * q[4],
    )


@inlined
def plus_more(a: Any, p: Seven, b: Any, q: Seven) -> Seven:
    """Return a p + b q."""
    return (*plus(a, p[:5], b, q[:5]), a * p[5] + b * q[5], a * p[6] + b * q[6])


@inlined
def by_c(q: Five) -> Three:
    """Return the sums of w c times 1, c, s."""
    return q[1], q[3], q[4]


@inlined
def by_s(q: Five) -> Three:
    """Return the sums of w s times 1, c, s."""
    return q[2], q[4], q[0] - q[3]


@inlined
def sum_of(a: Any, p: Three, b: Any, q: Three) -> Three:
    """Return a p + b q."""
    return a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]


@inlined
def product(a: Any, p: Three) -> Three:
    """Return a p."""
    return a * p[0], a * p[1], a * p[2]
