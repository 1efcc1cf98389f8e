"""Archard's law of wear, Eq. 47, with its scatter; and running-in, the roughness that follows the worn depth.

The depth worn off a point of the bushing is the specific wear rate times the sliding load of that point,
the time integral of P_c |u|. The paper prints C_w/H_d, which is no specific wear rate if C_w is one
already; its figures result when the rate is divided by the bare number 65.

A jump of N cycles repeats the sliding load of the simulated cycle N times. That is right as long as the
worn shape does not change the load. So N is limited twice:

- the load after the jump, which the next simulated cycle shows, may differ from the load before it by
  ``limit`` of its peak. Jumps grow while it differs less and shrink when it differs more;
- the deepest point may gain at most ``depth`` times the roughness σ. In rough contact pressure falls by e
  every third to every half of σ, so that jumps of about a σ would make neighbouring points overtake each
  other in turn: the extrapolation is an explicit Euler step, and stiff.

Wear of equal parts in equal tests differs by factors, so that its logarithm is taken as normal. Of n repeats
with the standard deviation s of the logarithms one more part lies, with 95 % probability, within
t s √(1 + 1/n) of their mean, t being the quantile of Student's distribution with n − 1 degrees of freedom.

Wear cuts the tops of a Gaussian surface off level and leaves the valleys (King, Watson and Stout, Modelling
the micro-geometry of lubricated wear, 4th Leeds-Lyon Symposium, 1978, 333-343; the transitional topography
of Sugimura and Kimura, Wear 98 (1984) 101-116). With the level a above the old mean plane, all in units of
the old σ, the heights are min(z, a):

    mean depth     d = φ(a) − a Q(a)
    roughness²     s² = Φ(a) − a φ(a) + a² Q(a) − d²,    Q = 1 − Φ.

New asperities come up as old ones go: the roughness falls no further than to a final one.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable


@dataclass(frozen=True)
class Archard:
    """Archard's law with a constant rate."""

    specific_rate: float | FloatArray  #: Specific wear rate C_w [m²/N], one or one for each node.
    hardness_divisor: float = 0.0  #: What the paper divides the rate by, a number without a unit; 0 is off.

    @property
    def rate(self) -> float | FloatArray:
        """Wear rate in force [m²/N]."""
        return self.specific_rate / (self.hardness_divisor or 1.0)

    def depth(self, sliding_load: FloatArray) -> FloatArray:
        """Return the depth worn off [m].

        Parameters
        ----------
        sliding_load
            ∫P_c |u| dt [N/m], any shape.
        """
        return np.asarray(self.rate * sliding_load)


def worn_volume(depth: FloatArray, node_area: FloatArray) -> float:
    """Return the volume worn off [m³] by the quadrature of the contact.

    Parameters
    ----------
    depth
        Depth at the nodes [m], any shape.
    node_area
        Area that each node stands for [m²], of the same shape; zero on edges.
    """
    return float(np.sum(node_area * depth))


def resampled(
    depth: FloatArray, z: FloatArray, fine_z: FloatArray, n_theta: int, *, turn: float = 0.0
) -> FloatArray:
    """Return a wear depth at the nodes of another grid.

    Parameters
    ----------
    depth
        Depth [m] at rows ``z`` and at uniform angles, shape (n_z + 2, n).
    z, fine_z
        Axial positions of the rows [m]; both from edge to edge.
    n_theta
        Number of uniform angles wanted.
    turn
        Angle of the first of them, over a full turn [1].

    Returns
    -------
    numpy.ndarray
        Depth [m], shape (fine_z.size, n_theta).
    """
    if not depth.any():
        return np.zeros((fine_z.size, n_theta))
    along = between_edges(depth, z, fine_z)
    n = depth.shape[1]
    # Three more angles on either side: the slope at a node is made from its neighbours.
    around = np.arange(-3, n + 4)
    wanted = np.mod(np.arange(n_theta) * (n / n_theta) + turn * n, n)
    return between_edges(along[:, around % n], around, wanted, axis=1)


def between_edges(depth: FloatArray, z: FloatArray, fine_z: FloatArray, axis: int = 0) -> FloatArray:
    """Return depths at other places along an axis of the array, without new peaks."""
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(z, depth, axis=axis)(fine_z))


_GROWTH: Final = 2.0
_SHRINKAGE: Final = 0.5
#: Least jump as a share of the first one: what two equal cycles differ by must not stop a campaign.
_LEAST_SHARE: Final = 0.1


@dataclass(frozen=True)
class JumpControl:
    """Chooses the length of jumps."""

    limit: float  #: Change of the sliding load over a jump that is aimed at, relative to its peak.
    depth: float  #: Largest gain of depth in a jump, in units of ``roughness``.
    roughness: float  #: Combined rms roughness σ [m].

    @property
    def first(self) -> float:
        """Gain of the first jump in units of the roughness: pressure changes about twice as much."""
        return min(0.5 * self.limit, self.depth)

    def next(self, gain: float, change: float) -> float:
        """Return the gain of depth for the next jump in units of the roughness.

        Parameters
        ----------
        gain
            What the last jump gained at its deepest, in the same units.
        change
            What the load then changed by, from :func:`load_change`.
        """
        factor = self.limit / change if change > 0.0 else _GROWTH
        wanted = gain * min(max(factor, _SHRINKAGE), _GROWTH)
        return min(max(wanted, _LEAST_SHARE * self.first), self.depth)

    def cycles(self, gain: float, depth_per_cycle: FloatArray, remaining: int) -> int:
        """Return the number of cycles of a jump, at least one.

        Parameters
        ----------
        gain
            Gain of depth at the deepest, in units of the roughness.
        depth_per_cycle
            Wear of the simulated cycle [m].
        remaining
            Cycles left.
        """
        fastest = float(depth_per_cycle.max(initial=0.0))
        if fastest * remaining <= gain * self.roughness:
            return remaining
        return max(1, math.floor(gain * self.roughness / fastest))


def load_change(load: FloatArray, before: FloatArray) -> float:
    """Return the largest change of a sliding load anywhere, relative to its peak before [1]."""
    peak = float(before.max(initial=0.0))
    return float(np.abs(load - before).max(initial=0.0)) / peak if peak > 0.0 else 0.0


LEAST: Final = 1.5  #: Least factor up and down: two equal pin-on-disc tests of PPS with PTFE differ by 1.37.
_LEVEL: Final = 0.95


def of_repeats(repeats: Sequence[float]) -> tuple[float, float]:
    """Return the interval of the wear of one more equal part over the geometric mean of repeats [1].

    ``repeats``: wear of equal parts, two or more numbers above zero in any one unit.
    """
    from scipy.special import stdtrit

    n, deviation = len(repeats), float(np.std(np.log(repeats), ddof=1))
    quantile = float(stdtrit(n - 1, 0.5 + 0.5 * _LEVEL))
    factor = max(math.exp(quantile * deviation * math.sqrt(1.0 + 1.0 / n)), LEAST)
    return 1.0 / factor, factor


_HIGHEST: Final = 8.0  #: Level above which nothing is cut off: 1e-16 of the heights.
_DEEPEST: Final = 10.0  #: Depth beyond which nothing of the old surface is left: level within 1e-12.
_BISECTIONS: Final = 80


def worn_roughness(roughness: float, depth: float, final: float) -> float:
    """Return the rms roughness of a surface whose tops are worn off [m].

    Parameters
    ----------
    roughness
        Before any wear [m].
    depth
        Mean depth worn off [m].
    final
        What it falls to [m], where that is less than ``roughness``.
    """
    if depth <= 0.0 or final >= roughness:
        return roughness
    worn = min(depth / roughness, _DEEPEST)
    low, high = -worn - 1.0, _HIGHEST
    for _ in range(_BISECTIONS):
        level = 0.5 * (low + high)
        deeper = _depth(level) > worn
        low, high = (level, high) if deeper else (low, level)
    level = 0.5 * (low + high)
    above = _above(level)
    square = 1.0 - above - level * _density(level) + level * level * above - worn * worn
    return max(roughness * math.sqrt(max(square, 0.0)), final)


def loaded_depth(depth: FloatArray, node_area: FloatArray) -> float:
    """Return the mean depth of what is worn off, each volume weighed with its depth [m]; 0 without wear.

    Parameters
    ----------
    depth
        Depth at the nodes [m], any shape.
    node_area
        Area that each node stands for [m²], of the same shape.
    """
    volume = float(np.sum(node_area * depth))
    return float(np.sum(node_area * depth**2)) / volume if volume > 0.0 else 0.0


def _density(x: float) -> float:
    return float(portable.exp(-0.5 * x * x) / math.sqrt(2.0 * math.pi))


def _above(x: float) -> float:
    return float(0.5 * portable.erfc(x / math.sqrt(2.0)))


def _depth(level: float) -> float:
    return _density(level) - level * _above(level)
