"""Number of cycles that one simulated cycle may stand for.

A jump of N cycles repeats the sliding load of the simulated cycle N times. That is right as long as the
worn shape does not change the load. So N is limited twice:

- the load after the jump, which the next simulated cycle shows, may differ from the load before it by
  ``limit`` of its peak. Jumps grow while it differs less and shrink when it differs more;
- the deepest point may gain at most ``depth`` times the roughness σ. In rough contact pressure falls by e
  every third to every half of σ, so that jumps of about a σ would make neighbouring points overtake each
  other in turn: the extrapolation is an explicit Euler step, and stiff.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

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
