"""Which nodes of a row can be in contact."""

from __future__ import annotations

import math

from tribodyn.kernels.jit import kernel


@kernel
def contact_window(clearance: float, a: float, b: float, limit: float, n_theta: int) -> tuple[int, int]:
    """Return the first node and the number of nodes with an unworn gap below ``limit``.

    The gap of one row is ``clearance + a cos θ + b sin θ`` (Eq. 48), a cosine with its minimum
    opposite to the direction of (a, b). Wear only widens the gap, so the window of the unworn gap
    holds every node in contact.

    Parameters
    ----------
    clearance
        Radial clearance [m].
    a, b
        Offset of the trunnion axis in this row along X and Y [m].
    limit
        Largest gap that is looked at [m].
    n_theta
        Number of nodes around the circumference.

    Returns
    -------
    first : int
        Index of the first node; may be negative, to be taken modulo ``n_theta``.
    count : int
        Number of nodes, 0 to ``n_theta``.
    """
    eccentricity = math.sqrt(a * a + b * b)
    if clearance - eccentricity >= limit:
        return 0, 0
    if clearance + eccentricity < limit:
        return 0, n_theta
    half_width = math.acos((clearance - limit) / eccentricity)
    centre = math.atan2(b, a) + math.pi
    nodes_per_radian = n_theta / (2.0 * math.pi)
    first = math.ceil((centre - half_width) * nodes_per_radian)
    last = math.floor((centre + half_width) * nodes_per_radian)
    return first, min(max(last - first + 1, 0), n_theta)
