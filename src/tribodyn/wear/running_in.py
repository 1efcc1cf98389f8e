"""Running-in: how the roughness of a worn surface follows from its worn depth.

Wear cuts the tops of a Gaussian surface off level and leaves the valleys (King, Watson and Stout, Modelling
the micro-geometry of lubricated wear, 4th Leeds-Lyon Symposium, 1978, 333-343; the transitional topography
of Sugimura and Kimura, Wear 98 (1984) 101-116). With the level a above the old mean plane, all in units of
the old σ, the heights are min(z, a):

    mean depth     d = φ(a) − a Q(a)
    roughness²     s² = Φ(a) − a φ(a) + a² Q(a) − d²,    Q = 1 − Φ.

New asperities come up as old ones go: the roughness falls no further than to a final one.
"""

import math
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray

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
