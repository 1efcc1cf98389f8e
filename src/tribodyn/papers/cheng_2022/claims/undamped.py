"""Claims on the mechanism without damping: the abstract, section 1 and conclusion (1)."""

from collections.abc import Mapping
from functools import partial
from typing import Final

import xarray as xr

from tribodyn.papers.cheng_2022.claims.base import SLOW, Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import VARIED, above
from tribodyn.papers.cheng_2022.claims.forces import size
from tribodyn.papers.cheng_2022.undamped import THREE_CYCLES, TOLERANCES, undamped

#: The motion that is left is looked at in this time before the end, but after the reversal [s].
_LATE: Final = 0.2
_AT_REVERSAL: Final = 0.01  #: A run that ends this soon after the first reversal ends in its impact [s].
#: The paper's start: everything zero, and the trunnion falls through its clearance.
_FALL: Final = {"start": "centred", "duration": "20 ms", "impact_window": "20 ms"}


def _runs(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> list[xr.Dataset]:
    more = THREE_CYCLES if start is None else start
    return [undamped(trial.runs, trial.formulation, friction, rtol, more) for rtol in TOLERANCES]


def diverges(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> Finding:
    """Measure the number of tolerances at which the run leaves the range of the contact law."""
    runs = _runs(trial, friction, start)
    ends = [float(run.attrs["time_reached"]) for run in runs if run.attrs["failure"]]
    text = f"{len(ends)} of {len(runs)} tolerances leave the law"
    turn = 0.0 if start else float(runs[0].attrs["cycle_period"]) / 2.0
    if ends and max(ends) < turn + max(_AT_REVERSAL, 0.02 if start else 0.0):
        text += f", at {', '.join(f'{end:.4f}' for end in ends)} s"
    return Finding(text, float(len(ends)))


def oscillates(trial: Trial, friction: str) -> Finding:
    """Measure the swing of the contact force long after the reversal, the least of all tolerances."""
    swings = [_swing(run) for run in _runs(trial, friction)]
    return Finding(f"standard deviation at least {min(swings):.2g} % of the mean", min(swings))


def _swing(run: xr.Dataset) -> float:
    """Return standard deviation over mean of the contact force at the end of the run [%]."""
    time = run["time"].values
    turns = run["reversal_time"].values
    late = time >= max(time[-1] - _LATE, float(turns[turns < time[-1]][-1]))
    force = size(run, "c")[late]
    return float(100.0 * force.std() / force.mean())


_SENTENCES: Final = ("A1", "I1", "K1")
_MAKES_ENERGY: Final = (
    "the paper's equations make energy, printed or mended; with friction as a moment nothing takes the "
    "energy of an impact, in any equations, and where the run leaves the law is chance"
)
_ALL_END: Final = above(3.0, "of 4 tolerances", partly=0.0, by="the paper", since=VARIED)

#: Claims on what happens without damping.
CLAIMS: Final = (
    Claim(
        "undamped diverges, moment", _SENTENCES,
        "without damping the calculation does not converge, three cycles; friction as a moment", "whole",
        _ALL_END, partial(diverges, friction="moment"), _MAKES_ENERGY, formulations="all", leave=SLOW,
    ),
    Claim(
        "undamped diverges, traction", _SENTENCES,
        "without damping the calculation does not converge, three cycles; friction as a traction", "whole",
        _ALL_END, partial(diverges, friction="traction"), _MAKES_ENERGY, formulations="all", leave=SLOW,
    ),
    Claim(
        "undamped diverges at the start", _SENTENCES,
        "the same from the paper's start, all zero; friction as a moment, 20 ms", "whole",
        _ALL_END, partial(diverges, friction="moment", start=_FALL), _MAKES_ENERGY, formulations="all",
        leave=SLOW,
    ),
    Claim(
        "undamped oscillates, moment", _SENTENCES,
        "without damping the calculation oscillates; friction as a moment", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="moment"), leave=SLOW,
    ),
    Claim(
        "undamped oscillates, traction", _SENTENCES,
        "without damping the calculation oscillates; friction as a traction", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="traction"),
        "traction along the slip damps the rolling of the trunnion in its bushing", leave=SLOW,
    ),
)  # fmt: skip
