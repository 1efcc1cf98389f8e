"""Which nodes of a row can be in contact."""

from __future__ import annotations

import math
from typing import Final

from tribodyn.kernels.jit import inlined

MARGIN: Final = 2.0e-4
"""Angle by which the window is wider than need be [rad], above the errors of both approximations below."""


@inlined
def arc_cosine(x: float) -> float:
    """Return arccos ``x`` [rad] within 7e-5: Abramowitz and Stegun, Handbook (1964), 4.4.45."""
    size = abs(x)
    polynomial = 1.5707288 + size * (-0.2121144 + size * (0.0742610 - 0.0187293 * size))
    angle = math.sqrt(1.0 - size) * polynomial
    return angle if x >= 0.0 else math.pi - angle


@inlined
def direction(x: float, y: float) -> float:
    """Return the angle of (x, y) ≠ 0 between 0 and 2π [rad], within 2e-5: ibid., 4.4.49 with fewer terms."""
    short, long = min(abs(x), abs(y)), max(abs(x), abs(y))
    ratio = short / long
    square = ratio * ratio
    angle = ratio * (
        0.9998660 + square * (-0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351)))
    )
    if abs(y) > abs(x):
        angle = 0.5 * math.pi - angle
    if x < 0.0:
        angle = math.pi - angle
    return angle if y >= 0.0 else 2.0 * math.pi - angle


@inlined
def contact_window(clearance: float, a: float, b: float, limit: float, n_theta: int) -> tuple[int, int]:
    """Return the first node and the number of nodes that hold every unworn gap below ``limit``.

    The gap of one row is ``clearance + a cos θ + b sin θ`` (Eq. 48), a cosine with its minimum
    opposite to the direction of (a, b). Wear only widens the gap, so the window of the unworn gap
    holds every node in contact. The clearance includes a bound of the second-order term of the tilt.
    A node more at each end may be in it: looking up its gap costs less than exact trigonometry.

    Parameters
    ----------
    clearance
        Radial clearance, less the largest second-order term of the tilt [m].
    a, b
        Offset of the trunnion axis in this row along X and Y [m].
    limit
        Largest gap that is looked at [m].
    n_theta
        Number of nodes around the circumference.

    Returns
    -------
    first : int
        Index of the first node, 0 to ``n_theta`` − 1; the window may go on at node 0.
    count : int
        Number of nodes, 0 to ``n_theta``.
    """
    eccentricity = math.sqrt(a * a + b * b)
    if clearance - eccentricity >= limit:
        return 0, 0
    if clearance + eccentricity < limit:
        return 0, n_theta
    half_width = arc_cosine((clearance - limit) / eccentricity) + MARGIN
    centre = direction(-a, -b)
    nodes_per_radian = n_theta / (2.0 * math.pi)
    first = math.ceil((centre - half_width) * nodes_per_radian)
    last = math.floor((centre + half_width) * nodes_per_radian)
    return first % n_theta, min(max(last - first + 1, 0), n_theta)
