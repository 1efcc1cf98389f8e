"""Nodes of a ring that can be in contact: four rings at a time."""

import math
from typing import Any, Final

from tribodyn.kernels.jit import inlined
from tribodyn.kernels.lanes import WIDTH, above, absolute, floor, spread, square_root, zeros

MARGIN: Final = 2.0e-4
"""Angle by which the window is wider than need be [rad], above the errors of both approximations below."""


@inlined
def arc_cosine(x: Any) -> Any:
    """Return arccos ``x`` [rad] within 7e-5: Abramowitz and Stegun, Handbook (1964), 4.4.45."""
    size = absolute(x)
    polynomial = spread(0.0742610) - spread(0.0187293) * size
    polynomial = spread(1.5707288) + size * (size * polynomial - spread(0.2121144))
    angle = square_root(spread(1.0) - size) * polynomial
    return above(zeros(), x, spread(math.pi) - angle, angle)


@inlined
def direction(x: Any, y: Any) -> Any:
    """Return the angle of (x, y) ≠ 0 between 0 and 2π [rad], within 2e-5: ibid., 4.4.49 with fewer terms."""
    size_x, size_y, zero = absolute(x), absolute(y), zeros()
    ratio = above(size_x, size_y, size_y, size_x) / above(size_x, size_y, size_x, size_y)
    square = ratio * ratio
    tail = square * (spread(-0.0851330) + square * spread(0.0208351))
    tail = square * (spread(-0.3302995) + square * (spread(0.1801410) + tail))
    angle = ratio * (spread(0.9998660) + tail)
    angle = above(size_y, size_x, spread(0.5 * math.pi) - angle, angle)
    angle = above(zero, x, spread(math.pi) - angle, angle)
    return above(zero, y, spread(2.0 * math.pi) - angle, angle)


@inlined
def contact_windows(room: Any, a: Any, b: Any, eccentricity: Any, n_theta: Any) -> tuple[Any, Any]:
    """Return the first group of four nodes and the number of groups that hold every unworn gap below a limit.

    The gap of a ring is ``room + a cos θ + b sin θ`` above the limit (Eq. 48), a cosine with its minimum
    opposite to the direction of (a, b). Wear only widens the gap, so the window of the unworn gap
    holds every node in contact. The room includes a bound of the second-order term of the tilt.
    A node more at each end may be in it: looking up its gap costs less than exact trigonometry.

    Parameters
    ----------
    room
        Radial clearance, less the largest second-order term of the tilt and the largest gap that is looked
        at [m].
    a, b, eccentricity
        Offset of the axis in this ring along X and Y, and its size [m].
    n_theta
        Number of nodes around the circumference.

    Returns
    -------
    first : lanes
        The first group, 0 to that of node ``n_theta`` − 1; the window may go on at group 0.
    number : lanes
        Number of groups; all where a gap is not a number.
    """
    zero, one, last = zeros(), spread(1.0), spread(WIDTH - 1.0)
    cosine = room / eccentricity
    inside = above(cosine, spread(-1.0), above(one, cosine, cosine, one), one)
    half_width = arc_cosine(inside) + spread(MARGIN)
    centre = direction(zero - a, zero - b)
    nodes_per_radian = n_theta * spread(0.5 / math.pi)
    first = zero - floor((half_width - centre) * nodes_per_radian)
    count = floor((centre + half_width) * nodes_per_radian) - first + one
    first = above(zero, first, first + n_theta, first)
    first = above(n_theta, first, first, zero)
    count = above(cosine, spread(-1.0), above(count, n_theta, n_theta, count), n_theta)
    first = above(n_theta, count, above(first, zero, first, zero), zero)
    quarter = spread(1.0 / WIDTH)
    begin, beyond = floor(first * quarter), first + count
    until = above(n_theta, beyond, beyond, n_theta)
    again = floor((beyond - until + last) * quarter)
    number = floor((until + last) * quarter) - begin + above(begin, again, again, begin)
    return begin, above(one, cosine, above(count, zero, number, zero), above(cosine, zero, zero, number))
