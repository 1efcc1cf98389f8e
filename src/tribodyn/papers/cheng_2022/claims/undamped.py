"""Claims on the mechanism without damping: the abstract, section 1 and conclusion (1)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial, listed
from tribodyn.papers.cheng_2022.claims.bounds import above
from tribodyn.papers.cheng_2022.claims.forces import size
from tribodyn.papers.cheng_2022.undamped import TOLERANCES, undamped

_LATE: Final = 0.2
"""The motion that is left is looked at in this time before the end, but after the reversal [s]."""
_SAMPLES: Final = 2001
_FALL: Final = {"start": "centred", "duration": "20 ms", "impact_window": "20 ms"}
"""The paper's start: everything zero, and the trunnion falls through its clearance."""


def _runs(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> list[xr.Dataset]:
    return [undamped(trial.runs, trial.formulation, friction, rtol, start) for rtol in TOLERANCES]


def diverges(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> Finding:
    """Measure the number of tolerances at which the run leaves the range of the contact law."""
    runs = _runs(trial, friction, start)
    ended = [bool(run.attrs["failure"]) for run in runs]
    text = "; ".join(_ending(run, over) for run, over in zip(runs, ended, strict=True))
    return Finding(text, float(sum(ended)))


def _ending(run: xr.Dataset, ended: bool) -> str:
    force = float(size(run, "c").max())
    if ended:
        return f"the law ends at {float(run.attrs['time_reached']):.4f} s and {force * 1e-6:.2g} MN"
    return f"runs through, up to {force:.0f} N"


def oscillates(trial: Trial, friction: str) -> Finding:
    """Measure the swing of the contact force long after the reversal, the least of all tolerances."""
    swings = [_swing(run) for run in _runs(trial, friction)]
    return Finding(f"standard deviation {listed(np.array(swings), '%')} of the mean", min(swings))


def _swing(run: xr.Dataset) -> float:
    """Return standard deviation over mean of the contact force at the end of the run [%]."""
    end = float(run["time"].values[-1])
    time = np.linspace(max(end - _LATE, float(run["reversal_time"].values[-1])), end, _SAMPLES)
    force = np.interp(time, run["time"].values, size(run, "c"))
    return float(100.0 * force.std() / force.mean())


_SENTENCES: Final = ("A1", "I1", "K1")
_MAKES_ENERGY: Final = (
    "the printed equations make energy; in equations that come from one virtual work the undamped mechanism "
    "goes through the reversal"
)
_ALL_END: Final = above(2.0, "of 3 tolerances", partly=0.0, origin=3.0)

CLAIMS: Final = (
    Claim(
        "undamped diverges, moment", _SENTENCES,
        "without damping the calculation does not converge; friction as a moment", "whole",
        _ALL_END, partial(diverges, friction="moment"), _MAKES_ENERGY,
    ),
    Claim(
        "undamped diverges, traction", _SENTENCES,
        "without damping the calculation does not converge; friction as a traction", "whole",
        _ALL_END, partial(diverges, friction="traction"), _MAKES_ENERGY,
    ),
    Claim(
        "undamped diverges at the start", _SENTENCES,
        "the same from the paper's start, all zero; friction as a moment, 20 ms", "whole",
        _ALL_END, partial(diverges, friction="moment", start=_FALL), _MAKES_ENERGY,
    ),
    Claim(
        "undamped oscillates, moment", _SENTENCES,
        "without damping the calculation oscillates; friction as a moment", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="moment"),
    ),
    Claim(
        "undamped oscillates, traction", _SENTENCES,
        "without damping the calculation oscillates; friction as a traction", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="traction"),
        "traction along the slip damps the rolling of the trunnion in its bushing",
    ),
)  # fmt: skip
"""Claims on what happens without damping."""
